//! Where further samples help most (Sec. 8).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;
use noisefloor_kernels::nlm::MAX_VARIANCE;

use crate::first_pass::filter_errors;
use crate::prepare::Prepared;
use crate::settings::Settings;
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

/// Relative error estimate times W(p): how much a further sample of p does for the filtered image. With W = Σ w/(1 + Σ
/// w·n) as in the text, or as programmed Σ w/Σ w·n. The product is filtered, because it is as noisy as the estimate is.
pub(crate) fn density(
    method: &str,
    target: &Prepared<'_>,
    outcome: &Outcome<'_>,
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let mut weighted = sum_of_channels(outcome.sure);
    let mean = mean_of_channels(outcome.mean);
    for (p, value) in weighted.data_mut().iter_mut().enumerate() {
        let mean = f64::from(mean.data()[p]);
        let (weight, samples) =
            (f64::from(outcome.weight_sum.data()[p]), f64::from(outcome.contributing.data()[p]));
        // Positive even for a pixel without samples.
        let others =
            if settings.plain_density { samples.max(f64::from(f32::MIN_POSITIVE)) } else { 1.0 + samples };
        let relative = f64::from(*value) / (mean * mean + DARK);
        *value =
            (relative * (weight / others)).clamp(f64::from(-MAX_VARIANCE), f64::from(MAX_VARIANCE)) as f32;
    }
    // An estimate that is negative after all is no reason to take samples away.
    Ok(filter_errors(method, target, &weighted, (PATCH, RADIUS), settings.center)?.map(|v| v.max(0.0)))
}
