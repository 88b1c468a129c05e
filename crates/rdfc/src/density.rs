//! Where further samples help most (Sec. 8).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;
use noisefloor_kernels::nlm::{MAX_VARIANCE, NlmInputs, Pass, filter};

use crate::candidates::Candidate;
use crate::first_pass::{FirstPass, combined, filter_errors, unit_scale};
use crate::kernel;
use crate::params::Density;
use crate::prepare::Prepared;
use crate::settings::{FLOOR, Settings};
use crate::sure::{mean_of_channels, sum_of_channels};

/// Keeps dark pixels from taking all samples. Sec. 8 says relative and prints no number; the authors' program's.
const DARK: f64 = 0.01;
/// Window radius of the filter of error estimates, pixels (Sec. 8).
const RADIUS: usize = 10;
/// Patch radius of it, pixels (Sec. 8).
const PATCH: usize = 3;
/// k_c of it (Sec. 8).
const K: f32 = 1.0;

/// As printed in Sec. 8: the relative error estimate of the combination, or of the candidate alone, times W(p) = Σ w/(1 + Σ w·n),
/// which says how much a further sample of p does for the filtered image. The product is filtered by the colour,
/// because it is as noisy as the estimate is.
pub(crate) fn text(
    method: &str,
    target: &Prepared<'_>,
    candidates: &[Candidate],
    first: Option<&FirstPass>,
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let alone = &candidates[0]; // there is one at least
    let (weights, samples) = match first {
        Some(first) => (
            combined(candidates, &first.weights, |c| &c.weight_sum),
            combined(candidates, &first.weights, Candidate::contributing),
        ),
        None => (alone.weight_sum.clone(), alone.contributing().clone()),
    };
    let (sure, mean) = first.map_or((&alone.sure, &alone.mean), |first| (&first.sure, &first.mean));
    let mut density = relative(sure, mean);
    let support = weights.data().iter().zip(samples.data());
    for (value, (weight, samples)) in density.data_mut().iter_mut().zip(support) {
        *value *= (f64::from(*weight) / (1.0 + f64::from(*samples))) as f32;
    }
    // An estimate that is negative after all is no reason to take samples away.
    Ok(filter_errors(method, target, &density, (PATCH, RADIUS), settings)?.map(|v| v.max(0.0)))
}

/// As programmed: the relative error estimate of FIRST, clamped at 0, filtered by colour and features, over the samples
/// that contribute to FIRST there, Σ w·n, or over those that count as much as the pixel's own. `candidate` is FIRST, or
/// the one that runs alone.
pub(crate) fn code(
    method: &str,
    target: &Prepared<'_>,
    candidate: &Candidate,
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let estimate = relative(&candidate.sure, &candidate.mean).map(|v| v.max(0.0));
    let (width, height) = (estimate.width(), estimate.height());
    let params = target.engine(settings, RADIUS, K);
    let scale = unit_scale(&estimate);
    let scaled = estimate.map(|v| v * scale);
    let frame = target.planes(vec![scaled.plane(0)]);
    let inputs = NlmInputs { frame, neighbors: Vec::new(), perturbation: None };
    let pass = Pass { patch: Some(PATCH), floor: FLOOR, derivative: false };
    let mut filtered = filter(&params, &[pass], &inputs).map_err(|e| kernel::kernel_error(method, &e))?;
    let mut density = kernel::image(&filtered.remove(0).planes, width, height); // one for each pass
    let support = candidate
        .contributing()
        .data()
        .iter()
        .zip(candidate.weight_sum.data())
        .zip(candidate.center_share.data());
    for (value, ((samples, weights), share)) in density.data_mut().iter_mut().zip(support) {
        let own = if settings.density == Density::Effective { weights * share } else { 1.0 };
        // At least the pixel's own, unless it has none; its weight is above 0. Only ratios between pixels count.
        *value /= (samples / own).max(f32::MIN_POSITIVE);
    }
    Ok(density.map(|v| v.min(MAX_VARIANCE)))
}

/// Estimated squared error, summed over the channels, over the squared brightness and a little.
fn relative(sure: &Image, mean: &Image) -> Image {
    let mut out = sum_of_channels(sure);
    let mean = mean_of_channels(mean);
    for (value, mean) in out.data_mut().iter_mut().zip(mean.data()) {
        let relative = f64::from(*value) / (f64::from(*mean).powi(2) + DARK);
        *value = relative.clamp(f64::from(-MAX_VARIANCE), f64::from(MAX_VARIANCE)) as f32;
    }
    out
}
