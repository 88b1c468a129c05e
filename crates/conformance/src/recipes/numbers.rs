//! Values that are no numbers, as hygiene leaves them.

use std::sync::OnceLock;

use noisefloor_frame::{Flash, Frame};

use crate::case::{Case, known};
use crate::change::set_variance;
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) const KNOWN: [&str; 7] = [
    "NaN in colour, variance, features and flash",
    "infinity in colour, variance, features and flash",
    "negative infinity in colour, variance, features and flash",
    "a single pixel with a colour",
    "every fourth pixel NaN",
    "negative radiance",
    "negative variances",
];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    trial.survive(CASES.get_or_init(|| {
        let mut cases = known(&KNOWN);
        cases.push(Case::edited("no known variance of features and flash", |f| guides(f, f32::NAN)));
        cases.push(Case::edited("negative colour, halves, features and flash", |f| {
            f.color.mean.data_mut().iter_mut().step_by(29).for_each(|v| *v = -3.0);
            f.color.halves.iter_mut().flatten().for_each(|half| half.set(1, 3, 3, -3.0));
            guides(f, -3.0);
        }));
        cases
    }))
}

/// Some means and all variances of features and flash become `bad`.
fn guides(frame: &mut Frame, bad: f32) {
    for feature in frame.features.values_mut() {
        feature.mean.data_mut().iter_mut().step_by(13).for_each(|v| *v = bad);
        set_variance(feature, |_| bad);
    }
    if let Some(Flash::Parts { base, light, covariance }) = &mut frame.flash {
        base.mean.data_mut().iter_mut().step_by(11).for_each(|v| *v = bad);
        set_variance(light, |_| bad);
        covariance.iter_mut().for_each(|c| c.set(0, 1, 1, bad));
    }
}
