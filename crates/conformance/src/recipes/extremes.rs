//! Values at the end of the number range, whose squares are beyond it.

use std::sync::OnceLock;

use noisefloor_frame::{Estimate, Flash};

use crate::case::{Case, complete};
use crate::change::{exposed, set_variance};
use crate::trial::Trial;
use crate::{Outcome, Violation};

/// Factors; from the third on a method may say that it has no answer.
const FACTORS: [(f32, bool); 4] = [(1e15, false), (1e25, false), (1e30, true), (1e37, true)];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    trial.survive(CASES.get_or_init(|| {
        FACTORS
            .map(|(factor, extreme)| Case { extreme, ..Case::new(format!("times {factor:e}"), ends(factor)) })
            .into()
    }))
}

fn ends(factor: f32) -> noisefloor_frame::Frame {
    // Variances end where the type does, else the frame would have no variance.
    let cap = |estimate: &mut Estimate| set_variance(estimate, |v| v.min(f32::MAX));
    let mut frame = exposed(complete(), factor);
    cap(&mut frame.color);
    if let Some(Flash::Parts { base, light, covariance }) = &mut frame.flash {
        cap(base);
        cap(light);
        *covariance = None;
    }
    frame
}
