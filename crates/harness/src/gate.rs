//! Two result folders of the same inputs: does a new version change any error?

use std::collections::BTreeMap;
use std::path::Path;

use noisefloor_questions::{GateError, GateOutcome, Version};
use noisefloor_stats::Terms;
use noisefloor_study::Key;
use noisefloor_study::plan::Item;
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
    let [old, new] = [read(old)?, read(new)?];
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
    let text = std::fs::read_to_string(Layout::new(dir).plan()).unwrap_or_default();
    let items = text.lines().filter_map(|line| serde_json::from_str(line).ok());
    let frames: BTreeMap<Key, Vec<Key>> = items
        .filter_map(|item| match item {
            Item::Cell(cell) => Some((cell.key, std::iter::once(cell.frame).chain(cell.beside).collect())),
            _ => None,
        })
        .collect();
    for record in kept.records.iter_mut().filter(|record| record.frames.is_empty()) {
        record.frames = frames.get(&record.cell).cloned().unwrap_or_default();
    }
    Ok(kept)
}
