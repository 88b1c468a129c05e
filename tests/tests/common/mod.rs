//! Edits of frames that several tests make.

use noisefloor_frame::{Estimate, Flash, Frame, Variance};

/// Edits the variance of the mean, if there is one.
pub fn set_variance(estimate: &mut Estimate, value: impl FnMut(f32) -> f32) {
    estimate.variance =
        estimate.variance.take().map(|v| Variance::of_mean(v.into_mean_variance().map(value)));
}

/// Multiplies radiance by `k` in every buffer that has its unit.
pub fn scaled(f: &Frame, k: f32) -> Frame {
    let estimate = |e: &Estimate| {
        let mut out = Estimate {
            mean: e.mean.map(|v| v * k),
            variance: e.variance.clone(),
            halves: e.halves.clone().map(|halves| halves.map(|half| half.map(|v| v * k))),
        };
        set_variance(&mut out, |v| v * k * k);
        out
    };
    let mut out = f.clone();
    out.color = estimate(&f.color);
    out.flash = f.flash.as_ref().map(|flash| match flash {
        Flash::Parts { base, light, covariance } => Flash::Parts {
            base: estimate(base),
            light: estimate(light),
            covariance: covariance.as_ref().map(|c| c.map(|v| v * k * k)),
        },
        Flash::Ready(flash) => Flash::Ready(estimate(flash)),
    });
    out
}
