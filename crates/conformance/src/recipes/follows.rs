//! Two frames that differ in what should not matter, or whose outputs should differ in one way.

use noisefloor_denoiser::{Input, Invariance};
use noisefloor_frame::{Frame, Image, Variance};

use crate::trial::{Trial, completed};
use crate::{Broken, Outcome, Violation};

/// Most drift that rounding explains where a change takes it elsewhere: a ten-thousandth of the noise. What rounds differently
/// has millionths; what depends on the change, and was found by this, half a thousandth and more.
pub(super) const ROUNDING: f64 = 1e-4;

/// A change of frames, and what it should do to the output.
pub(super) struct Change {
    pub name: String,
    pub frame: fn(&Frame, f32) -> Frame,
    pub output: fn(&Image, f32) -> Image,
    pub by: f32,
    /// Most drift that rounding explains.
    pub allowed: f64,
}

/// Runs the method on a frame and its changes; what the card declares is looked at all the same.
pub(super) fn run(
    trial: &mut Trial<'_>,
    what: Invariance,
    frame: &Frame,
    changes: &[Change],
) -> Result<Outcome, Violation> {
    let declared = trial.varies_with(what).map(str::to_owned);
    let frame = completed(frame, &trial.card);
    let here = trial.judge("as it is", &Input::new(&frame), false)?;
    let mut seen = false;
    for change in changes {
        let changed = (change.frame)(&frame, change.by);
        let there = trial.judge(&change.name, &Input::new(&changed), false)?;
        let drift = match (&here, &there) {
            (Some(here), Some(there)) => {
                drift(&(change.output)(&here.image, change.by), &there.image, &changed)
            }
            (None, None) => 0.0,
            // An answer here and none there: as far apart as can be.
            _ => f64::INFINITY,
        };
        if drift > change.allowed && declared.is_none() {
            let allowed = change.allowed;
            return Err(Broken::Varies { what, drift, allowed }.on(change.name.as_str()));
        }
        seen |= drift > change.allowed;
    }
    Ok(declared.map_or_else(|| trial.kept(), |reason| Outcome::Declared { reason, seen }))
}

/// Root mean square of the difference over that of the frame's standard error: what cannot be seen under the noise is
/// nothing, whatever the values. 0 only if every value is the same.
fn drift(expected: &Image, got: &Image, frame: &Frame) -> f64 {
    let square = |(a, b): (&f32, &f32)| (f64::from(*a) - f64::from(*b)).powi(2);
    let total: f64 = expected.data().iter().zip(got.data()).map(square).sum();
    let variance = frame.color.variance.as_ref().map(Variance::mean_variance);
    let noise: f64 = variance.map_or(0.0, |v| v.data().iter().map(|v| f64::from(*v)).sum());
    if total == 0.0 { 0.0 } else { (total / noise).sqrt() }
}
