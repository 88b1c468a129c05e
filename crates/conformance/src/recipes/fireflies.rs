use std::sync::OnceLock;

use noisefloor_frame::Flash;

use crate::case::{Case, known};
use crate::change::set_variance;
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) const KNOWN: [&str; 2] = ["fireflies a million times brighter", "rare bright samples"];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    trial.survive(CASES.get_or_init(|| {
        let mut cases = known(&KNOWN);
        cases.push(Case::edited("a firefly without variance", |f| {
            (0..3).for_each(|c| f.color.mean.set(c, 7, 7, 1e6));
            set_variance(&mut f.color, |_| 0.0);
        }));
        cases.push(Case::edited("fireflies in the flash", |f| {
            if let Some(Flash::Parts { base, light, .. }) = &mut f.flash {
                base.mean.set(0, 3, 3, 1e6);
                light.mean.set(1, 4, 4, 1e30);
            }
        }));
        cases
    }))
}
