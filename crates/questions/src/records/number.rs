//! Numbers in the form that a summary has.

use noisefloor_stats::{self as stats, Level};

use noisefloor_study::record::Record;
use noisefloor_study::summary::{Interval, Source};

/// Level of every interval in a summary.
pub(crate) const LEVEL: Level = Level::TWO_SIDED_95;

/// Puts an interval into the summary's form; one without ends has no known uncertainty.
pub(crate) fn told(interval: stats::Interval, source: Source, below: Option<f64>) -> Interval {
    Interval {
        value: interval.value,
        standard_error: interval.standard_error,
        low: interval.low,
        high: interval.high,
        confidence: interval.level.confidence(),
        n: interval.n,
        source: if interval.low.is_some() { source } else { Source::None },
        below,
    }
}

/// Value of a metric in a record, over all pixels or in a class.
pub(crate) fn value(record: &Record, class: Option<&str>, metric: &str) -> Option<f64> {
    let values = match class {
        None => &record.metrics,
        Some(class) => record.classes.get(class)?,
    };
    values.get(metric).copied().flatten()
}

/// Bias by the reference that was taken out of a metric, mean over replicates; `None` where none is stated.
pub(crate) fn bias(records: &[&Record], class: Option<&str>, metric: &str) -> Option<f64> {
    mean(records.iter().filter_map(|record| Some(record.contribution(class, metric)?.bias)))
}

/// Mean of some numbers, if there are any.
pub(crate) fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0u32), |(sum, count), v| (sum + v, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}

/// Median of some numbers, if there are any.
pub fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n % 2 == 1 => Some(sorted[middle]),
        _ => Some(0.5 * (sorted[middle - 1] + sorted[middle])),
    }
}
