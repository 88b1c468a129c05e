//! Each replicate's intervals against the mean of the other replicates.

use noisefloor_stats::{LeaveOneOutError, LeaveOneOutTally, Level, Observed, PixelSpread, leave_one_out};
use serde::{Deserialize, Serialize};

use super::ID;
use crate::answers;
use crate::cell::{Measure, MeasureError};
use crate::level::{LevelCell, LevelFound};

/// What is kept of a level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Answer {
    /// The replicates, in the order of all counts.
    pub(super) replicates: Vec<u32>,
    pub(super) counts: Vec<Count>,
}

/// Pixel-channels of a class at a confidence, as in [`LeaveOneOutTally`]: of each replicate those with s > 0, of all together
/// the others and the sides of the misses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Count {
    pub(super) confidence: f64,
    pub(super) class: String,
    pub(super) total: Vec<u64>,
    pub(super) covered: Vec<u64>,
    pub(super) truth_above: u64,
    pub(super) truth_below: u64,
    pub(super) constant: u64,
    pub(super) missed: u64,
    /// How the misses of all replicates spread over pixels.
    pub(super) spread: PixelSpread,
}

/// Of frames whose t-intervals mean anything; nothing below two of them, or where they have different counts.
pub(super) fn measure(level: &LevelCell<'_>, found: &mut LevelFound) -> Result<(), MeasureError> {
    let measures: Vec<Measure<'_>> = level.measures().collect();
    let usable = level.frames.iter().zip(&measures).filter_map(|(f, m)| Some((f.replicate, m.intervals()?)));
    let (replicates, frames): (Vec<u32>, Vec<Observed<'_>>) = usable.unzip();
    let Some(first) = measures.first().filter(|_| frames.len() >= 2) else { return Ok(()) };
    let mut counts = Vec::new();
    // Confidences were checked with the study.
    for confidence in level.study.coverage.iter().filter_map(|&c| Level::two_sided(c).ok()) {
        let counted = match leave_one_out(&frames, confidence, Some(first.groups())) {
            Ok(counted) => counted,
            Err(LeaveOneOutError::Shape { source, .. }) => return Err(source.into()),
            Err(LeaveOneOutError::TooFewReplicates { .. } | LeaveOneOutError::Counts { .. }) => return Ok(()),
        };
        for (index, (class, spread)) in first.names().zip(&counted.spreads).enumerate() {
            let each = |part: fn(&LeaveOneOutTally) -> u64| -> Vec<u64> {
                counted.replicates.iter().map(|tallies| part(&tallies[index])).collect()
            };
            let sum = |part: fn(&LeaveOneOutTally) -> u64| each(part).iter().sum();
            if sum(LeaveOneOutTally::all) == 0u64 {
                continue;
            }
            counts.push(Count {
                confidence: confidence.confidence(),
                class: class.to_owned(),
                total: each(|t| t.total),
                covered: each(|t| t.covered),
                truth_above: sum(|t| t.truth_above),
                truth_below: sum(|t| t.truth_below),
                constant: sum(|t| t.constant),
                missed: sum(|t| t.missed),
                spread: *spread,
            });
        }
    }
    if !counts.is_empty() {
        answers::keep(&mut found.answers, ID, &Answer { replicates, counts });
    }
    Ok(())
}
