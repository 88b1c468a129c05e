//! Where further samples help most (Sec. 8).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;

use crate::first_pass::filter_errors;
use crate::prepare::Prepared;
use crate::sure::{mean_of_channels, sum_of_channels};

/// Keeps dark pixels from taking all samples.
const DARK: f64 = 0.01;
/// Window radius of the filter of error estimates, pixels.
const RADIUS: usize = 10;
/// Patch radius of it, pixels.
const PATCH: usize = 3;

/// What a density is made of: the filtered image, its estimated error, and what the weights of its pixels add up to.
pub(crate) struct Outcome<'a> {
    pub mean: &'a Image,
    pub sure: &'a Image,
    /// Σ w.
    pub weight_sum: &'a Image,
    /// Σ w·n.
    pub contributing: &'a Image,
}

/// Relative error estimate times W(p): how much a further sample of p does for the filtered image. With W = Σ w/(1 + Σ w·n) as
/// in the text, or `plain` Σ w/Σ w·n.
pub(crate) fn density(
    method: &str,
    target: &Prepared<'_>,
    outcome: &Outcome<'_>,
    plain: bool,
) -> Result<Image, DenoiseError> {
    let errors = filter_errors(method, target, &sum_of_channels(outcome.sure), PATCH, RADIUS)?;
    let mean = mean_of_channels(outcome.mean);
    let mut out = errors.clone();
    for (p, value) in out.data_mut().iter_mut().enumerate() {
        let mean = f64::from(mean.data()[p]);
        let (weight, samples) =
            (f64::from(outcome.weight_sum.data()[p]), f64::from(outcome.contributing.data()[p]));
        // At least one sample contributes to a filtered value, or none at all.
        let others = if plain { samples.max(f64::from(f32::MIN_POSITIVE)) } else { 1.0 + samples };
        let wanted = f64::from(*value).max(0.0) / (mean * mean + DARK) * (weight / others);
        *value = wanted.min(f64::from(f32::MAX)) as f32;
    }
    Ok(out)
}
