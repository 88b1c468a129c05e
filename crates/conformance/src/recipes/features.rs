//! Features and flash images that tell nothing, or are not there.

use std::sync::OnceLock;

use noisefloor_frame::{FeatureId, Image};

use crate::case::{Case, known};
use crate::change::set_variance;
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) const KNOWN: [&str; 9] = [
    "constant features and flash",
    "collinear features",
    "background at depth zero without normal",
    "background at infinite depth",
    "black flash",
    "ready-made flash",
    "no flash",
    "colour only",
    "colour without variance and halves",
];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    trial.survive(CASES.get_or_init(|| {
        let mut cases = known(&KNOWN);
        for (name, value) in [("zero features", 0.0), ("features that grow without end", 1.0)] {
            cases.push(Case::edited(name, |f| {
                for feature in f.features.values_mut() {
                    let (w, h, channels) =
                        (feature.mean.width(), feature.mean.height(), feature.mean.channels());
                    feature.mean =
                        Image::from_fn(w, h, channels, |c, x, y| value * ((c + 1) * (x + y)) as f32);
                    set_variance(feature, |_| 0.0);
                }
            }));
        }
        cases.push(Case::edited("depths beyond all measure", |f| {
            if let Some(depth) = f.features.get_mut(&FeatureId::Depth) {
                let (w, h) = (depth.mean.width(), depth.mean.height());
                let value = |x: usize| if x.is_multiple_of(2) { f32::INFINITY } else { 3e38 };
                depth.mean = Image::from_fn(w, h, 1, |_, x, _| value(x));
            }
        }));
        cases.push(Case::edited("no features", |f| f.features.clear()));
        cases.push(Case::edited("no halves", |f| f.color.halves = None));
        cases
    }))
}
