use noisefloor_study::exhibit::{RowState, TableCell, TableRow, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::CellSummary;

use super::forest::forest;
use crate::shown;
use crate::view::View;

/// How a row stands among those of its level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Standing {
    /// Not on the same frames or pixels as the others.
    LeftOut,
    /// Told apart from the best.
    Behind,
    /// The best.
    Best,
    /// Not told apart from the best.
    Tied,
    /// The first of a level whose cells did not all end.
    FirstSoFar,
    /// Not told apart from that.
    TiedSoFar,
}

impl Standing {
    /// The word beside the row, and what it means.
    fn word(self) -> Option<(&'static str, &'static str)> {
        match self {
            Self::LeftOut => Some(("not ranked", "Not on the same frames and pixels as the others")),
            Self::Behind => None,
            Self::Best => Some(("best", "The best")),
            Self::Tied => Some(("tied", "Not distinguishable from the best")),
            Self::FirstSoFar => Some(("first so far", "The level is unfinished")),
            Self::TiedSoFar => {
                Some(("tied so far", "Not distinguishable from the first; the level is unfinished"))
            }
        }
    }

    fn state(self) -> RowState {
        match self {
            Self::LeftOut | Self::Behind => RowState::Plain,
            Self::Best | Self::Tied | Self::FirstSoFar | Self::TiedSoFar => RowState::Best,
        }
    }
}

/// What the table of a level shows of each row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shown<'a> {
    pub(super) metric: &'a str,
    /// Whether there is a column of samples for an equal error.
    pub(super) equal: bool,
    /// Axis of the small intervals.
    pub(super) range: Option<(f64, f64)>,
}

/// A row with numbers.
pub(super) fn row(view: &View<'_>, cell: &CellSummary, shown: Shown<'_>, standing: Standing) -> TableRow {
    let is_baseline = Some(cell.label.as_str()) == view.baseline();
    let mut name = view.row_cell(&cell.label);
    if let Some((word, about)) = standing.word() {
        name = name.tag(word, Tone::Plain, about);
    }
    let mut cells = vec![name, value(cell, shown.metric)];
    let ratio = cell.ratio_to_mc.get(shown.metric).filter(|_| !is_baseline);
    cells.push(ratio.map_or_else(TableCell::default, |ratio| TableCell {
        forest: shown.range.and_then(|range| forest(ratio, range)),
        ..shown::ratio(ratio)
    }));
    cells.extend(
        shown.equal.then(|| if is_baseline { TableCell::default() } else { equal(cell, shown.metric) }),
    );
    cells.push(if is_baseline { TableCell::none() } else { denoise(cell) });
    let total = cell.render_seconds.map(|r| r + cell.denoise_seconds.unwrap_or(0.0));
    cells.push(shown::seconds(total));
    TableRow { cells, state: standing.state() }
}

fn value(cell: &CellSummary, metric: &str) -> TableCell {
    let value = shown::value_or_empty(cell.metrics.get(metric));
    match (cell.pixels, cell.pixels_of) {
        (pixels, all) if pixels < all && pixels > 0 => {
            let pixels = format!("over {pixels} of {all} pixels");
            let aside = shown::joined(&[&value.aside, &pixels], ", ");
            value.aside(aside)
        }
        _ => value,
    }
}

fn equal(cell: &CellSummary, metric: &str) -> TableCell {
    let Some(equal) = cell.equal_error.get(metric) else { return TableCell::default() };
    let shown = shown::ratio(equal);
    match cell.equal_error_extrapolated.get(metric) {
        Some(true) => shown.tag("ext.", Tone::Plain, "Extrapolated beyond the rendered levels"),
        _ => shown,
    }
}

fn denoise(cell: &CellSummary) -> TableCell {
    let range = cell.denoise_seconds_range.filter(|[low, high]| high > low);
    let about = range.map_or_else(String::new, |[low, high]| {
        format!("all runs: {} to {}", format::duration(low), format::duration(high))
    });
    shown::seconds(cell.denoise_seconds).about(about)
}
