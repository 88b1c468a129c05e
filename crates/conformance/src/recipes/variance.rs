//! Noise that is not there.

use std::sync::OnceLock;

use noisefloor_frame::Flash;

use crate::case::{Case, known};
use crate::change::set_variance;
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) const KNOWN: [&str; 5] = [
    "zero variance everywhere",
    "zero variance in one channel",
    "noise-free features and flash",
    "constant image",
    "black image",
];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    trial.survive(CASES.get_or_init(|| {
        let mut cases = known(&KNOWN);
        cases.push(Case::edited("smallest variances", |f| set_variance(&mut f.color, |_| f32::from_bits(1))));
        cases.push(Case::edited("no variance in the flash, of unknown covariance", |f| {
            if let Some(Flash::Parts { base, light, covariance }) = &mut f.flash {
                set_variance(base, |_| 0.0);
                set_variance(light, |_| 0.0);
                *covariance = None;
            }
        }));
        cases
    }))
}
