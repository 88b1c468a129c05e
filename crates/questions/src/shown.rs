//! Cells of tables as several questions show them: a text for people, and the unrounded number behind it.

mod verdict;

use std::collections::BTreeSet;

use noisefloor_study::exhibit::{Column, Number, TableCell};
use noisefloor_study::format;
use noisefloor_study::summary::Interval;

pub(crate) use verdict::{changed_by, judged, number, probability, region, word};

/// A value with its uncertainty.
pub(crate) fn value(interval: &Interval) -> TableCell {
    let shown = format::interval(interval);
    TableCell::text(shown.value).aside(shown.spread).number(interval.into())
}

/// A value, or an empty cell.
pub(crate) fn value_or_empty(interval: Option<&Interval>) -> TableCell {
    interval.map(value).unwrap_or_default()
}

/// A fraction in percent with its uncertainty.
pub(crate) fn fraction(interval: &Interval) -> TableCell {
    let shown = format::percent_interval(interval);
    TableCell::text(shown.value).aside(shown.spread).number(interval.into())
}

/// A fraction in percent.
pub(crate) fn share(fraction: f64) -> TableCell {
    TableCell::text(format::percent(fraction)).number(Number::exact(fraction))
}

/// A ratio with both ends of its interval.
pub(crate) fn ratio(interval: &Interval) -> TableCell {
    let text = interval
        .below
        .map_or_else(|| format::ratio(interval.value), |limit| format!("< {}", format::ratio(limit)));
    TableCell::text(text).aside(format::bracket(interval, format::ratio)).number(interval.into())
}

/// An effect that is a ratio or, where there is none, a difference, which the cell then says.
pub(crate) fn effect(cell: TableCell, is_ratio: bool) -> TableCell {
    if is_ratio { cell } else { TableCell { text: format!("difference {}", cell.text), ..cell } }
}

/// A duration, or that there is none.
pub(crate) fn seconds(seconds: Option<f64>) -> TableCell {
    seconds.map_or_else(TableCell::none, |s| TableCell::text(format::duration(s)).number(Number::exact(s)))
}

/// A column for a level of samples per pixel.
pub(crate) fn level_column(spp: u32) -> Column {
    Column::number(format!("{spp} spp"))
}

/// The remarks below a table that explain its stars, once each.
pub(crate) fn marks<'a>(marks: impl Iterator<Item = &'a str>) -> Vec<String> {
    let set: BTreeSet<&str> = marks.collect();
    set.into_iter().map(|mark| format!("* {mark}")).collect()
}

/// `, `-joined parts of a sentence that may be empty.
pub(crate) fn joined(parts: &[&str], between: &str) -> String {
    let told: Vec<&str> = parts.iter().copied().filter(|part| !part.is_empty()).collect();
    told.join(between)
}

#[cfg(test)]
mod tests {
    use noisefloor_study::summary::Source;

    use super::*;

    fn interval(value: f64, below: Option<f64>) -> Interval {
        Interval {
            value,
            standard_error: None,
            low: Some(0.5 * value),
            high: Some(2.0 * value),
            confidence: 0.95,
            n: 4,
            source: Source::Replicates,
            below,
        }
    }

    #[test]
    fn a_cell_carries_the_unrounded_number() {
        let cell = value(&interval(0.123_456_789, None));
        let number = cell.number.unwrap();
        assert_eq!((cell.text.as_str(), number.value), ("0.123", 0.123_456_789));
        assert_eq!((number.low, number.high), (Some(0.061_728_394_5), Some(0.246_913_578)));
    }

    #[test]
    fn a_ratio_below_its_floor_is_a_limit() {
        assert_eq!(ratio(&interval(0.2, Some(0.31))).text, "< 0.310");
        assert_eq!(ratio(&interval(0.2, None)).aside, "[0.100, 0.400]");
    }
}
