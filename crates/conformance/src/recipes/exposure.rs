//! All radiances times a factor.

use noisefloor_denoiser::Invariance;

use super::follows::{Change, ROUNDING, run as follow};
use crate::case::complete;
use crate::change::exposed;
use crate::trial::Trial;
use crate::{Outcome, Violation};

/// Factors with the drift allowed. A power of two changes no digit of any product or quotient, so nothing may change.
const FACTORS: [(f32, f64); 4] = [(1.0 / 8192.0, 0.0), (8192.0, 0.0), (0.3, ROUNDING), (3.0, ROUNDING)];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    let changes = FACTORS.map(|(by, allowed)| Change {
        name: format!("exposure times {by}"),
        frame: exposed,
        output: |image, by| image.map(|v| v * by),
        by,
        allowed,
    });
    follow(trial, Invariance::Exposure, complete(), &changes)
}
