//! A new version of a program against an old one, on the same inputs: does any error change?

mod changes;
mod inputs;
mod outcome;
mod version;

use std::collections::BTreeSet;

use noisefloor_stats::{self as stats, Terms};
use noisefloor_study::metric;
use thiserror::Error;

pub use changes::Broken;
pub use inputs::Mismatch;
pub use outcome::{CellChange, GateOutcome, Overall, RowChange};
pub use version::Version;

use changes::changes;

/// Why two versions cannot be set beside each other.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GateError {
    /// The metric is no error that is compared by its ratio.
    #[error("`{metric}` is no error of which less is better; the errors of the old version are {}", known.join(", "))]
    NotAnError {
        /// The metric asked for.
        metric: String,
        /// Those that can be asked for.
        known: Vec<String>,
    },
    /// The inputs are not the same.
    #[error("{}", told(.0))]
    NotComparable(Vec<Mismatch>),
}

/// Mismatches that are named one by one.
const MOST_NAMED: usize = 12;

fn told(mismatches: &[Mismatch]) -> String {
    let mut lines: Vec<String> = mismatches.iter().take(MOST_NAMED).map(ToString::to_string).collect();
    if let Some(more) = mismatches.len().checked_sub(MOST_NAMED + 1) {
        lines.push(format!("{} more like these", more + 1));
    }
    lines.join("\n")
}

/// Compares the errors of all cells that the old version has, see [`noisefloor_stats::gate`].
///
/// # Errors
/// [`GateError`] unless the metric is an error of the old version and all inputs are known to be the same.
pub fn gate(old: Version<'_>, new: Version<'_>, id: &str, terms: Terms) -> Result<GateOutcome, GateError> {
    let measured: BTreeSet<&String> = old.records.iter().flat_map(|record| record.metrics.keys()).collect();
    let is_error = |id: &str| metric::lower_is_better(id);
    if !is_error(id) || !measured.iter().any(|known| *known == id) {
        let known = measured.into_iter().filter(|id| is_error(id)).cloned().collect();
        return Err(GateError::NotAnError { metric: id.to_owned(), known });
    }
    let mismatches = inputs::mismatches(old, new);
    if !mismatches.is_empty() {
        return Err(GateError::NotComparable(mismatches));
    }
    let found = changes(old, new, id);
    let list: Vec<stats::Change> = found.cells.iter().map(|cell| cell.change.clone()).collect();
    Ok(outcome::outcome(found, stats::gate(&list, terms), id, terms))
}
