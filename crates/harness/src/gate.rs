//! Two result folders of the same inputs: does a new version change any error?

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use noisefloor_questions::{GateError, GateOutcome, Version};
use noisefloor_stats::Terms;
use noisefloor_study::Key;
use noisefloor_study::plan::{Item, PlannedCell};
use noisefloor_study::record::Record;
use thiserror::Error;

use crate::error::HarnessError;
use crate::recorded::KeptStudy;
use crate::store::Layout;

/// Why there is no gate.
#[derive(Debug, Error)]
pub enum GateFailure {
    /// One of the two folders cannot be read.
    #[error(transparent)]
    Folder(#[from] HarnessError),
    /// The old one was stopped before its end, or lost records.
    #[error("{}: {missing} of {planned} planned cells have no record; run the study to its end first", .folder.display())]
    Unfinished {
        /// Its folder.
        folder: PathBuf,
        /// Cells without a record.
        missing: usize,
        /// All cells of its plan.
        planned: usize,
    },
    /// They cannot be set beside each other.
    #[error(transparent)]
    Gate(#[from] GateError),
}

/// Compares two folders of studies that were run, or recordings, in the errors `metric` of the old one's cells; see
/// [`noisefloor_questions::gate`]. `metric` is the old study's primary metric unless given. Nothing is written.
///
/// # Errors
/// [`GateFailure`] if a folder cannot be read or the two had other inputs.
pub fn gate(old: &Path, new: &Path, metric: Option<&str>, terms: Terms) -> Result<GateOutcome, GateFailure> {
    let kept = read(old)?;
    finished(old, &kept.records)?;
    let (old, new) = (kept, read(new)?);
    let metric = metric.unwrap_or(&old.study.primary_metric);
    let [a, b] = [&old, &new].map(|kept| Version { context: &kept.context, records: &kept.records });
    Ok(noisefloor_questions::gate(a, b, metric, terms)?)
}

/// What a folder keeps; records of earlier programs get the keys of their frames from the plan, where that is there.
fn read(dir: &Path) -> Result<KeptStudy, HarnessError> {
    let mut kept = KeptStudy::read(dir)?;
    if kept.records.iter().all(|record| !record.frames.is_empty()) {
        return Ok(kept);
    }
    let of_cell = |cell: PlannedCell| (cell.key, std::iter::once(cell.frame).chain(cell.beside).collect());
    let frames: BTreeMap<Key, Vec<Key>> = planned(dir).map(of_cell).collect();
    for record in kept.records.iter_mut().filter(|record| record.frames.is_empty()) {
        record.frames = frames.get(&record.cell).cloned().unwrap_or_default();
    }
    Ok(kept)
}

/// Cells of the plan that a run wrote into its folder; recordings have none.
fn planned(dir: &Path) -> impl Iterator<Item = PlannedCell> {
    let text = std::fs::read_to_string(Layout::new(dir).plan()).unwrap_or_default();
    let items: Vec<Item> = text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    items.into_iter().filter_map(|item| match item {
        Item::Cell(cell) => Some(cell),
        _ => None,
    })
}

/// A part of a study says nothing of the rest: what it was to do must be there.
fn finished(dir: &Path, records: &[Record]) -> Result<(), GateFailure> {
    let keys: Vec<Key> = planned(dir).map(|cell| cell.key).collect();
    let done: BTreeSet<&Key> = records.iter().map(|record| &record.cell).collect();
    match keys.iter().filter(|key| !done.contains(key)).count() {
        0 => Ok(()),
        missing => Err(GateFailure::Unfinished { folder: dir.to_owned(), missing, planned: keys.len() }),
    }
}
