//! Features in other units: depth in centimetres for metres.

use noisefloor_denoiser::Invariance;

use super::follows::{Change, ROUNDING, run as follow};
use crate::case::complete;
use crate::change::in_units;
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    let changes = [0.01, 100.0].map(|by| Change {
        name: format!("lengths times {by}"),
        frame: in_units,
        output: |image, _| image.clone(),
        by,
        allowed: ROUNDING,
    });
    follow(trial, Invariance::FeatureUnits, complete(), &changes)
}
