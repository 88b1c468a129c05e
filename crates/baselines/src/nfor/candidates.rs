//! Step 2: two regressions of each half, and how wrong their means are.

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;

use super::kernel::{Guided, MOST_SQUARE, Sizes, filter, regress};
use super::params::{Guide, NegativeError, Params};
use super::settings::Settings;

/// The colour of a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Color<'a> {
    pub mean: &'a Image,
    pub halves: &'a [Image; 2],
    /// V, of the mean of all samples.
    pub variance: &'a Image,
    /// ε in squared units of it.
    pub epsilon: f32,
}

/// Both halves after a regression.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    /// C_A, C_B.
    pub halves: [Image; 2],
    /// Estimate of the squared error of their mean, not yet filtered.
    pub error: Image,
}

/// C_A and C_B for one k, and their error. `features` are filtered halves, A first.
pub(super) fn candidate(
    color: &Color<'_>,
    features: &[Vec<Image>; 2],
    k: f64,
    params: &Params,
    settings: &Settings,
) -> Result<Candidate, DenoiseError> {
    let [a, b] = color.halves;
    let [of_a, of_b] = features;
    let sizes = Sizes {
        patch: params.patch_radius_px,
        window: params.window_radius_px,
        k,
        scale: 2.0,
        epsilon: color.epsilon,
    };
    // Weights and features from the other half.
    let one = |image: &Image, other: &Image, features: &[Image]| {
        let of_weights = if settings.guide == Guide::SameHalf { image } else { other };
        let guide = Guided { image: of_weights, variance: color.variance };
        regress(image, guide, features, &sizes, settings)
    };
    let halves = [one(a, b, of_b)?, one(b, a, of_a)?];
    let error = squared_error(color, &halves);
    Ok(Candidate { halves, error })
}

/// ½[(B − C_A)² − 2V + (A − C_B)² − 2V] − ¼(C_B − C_A)²: each half is judged by the other, whose noise of 2V is taken off. The
/// squared error of a mean of two is the mean of both squared errors less a quarter of their squared difference.
pub(super) fn squared_error(color: &Color<'_>, halves: &[Image; 2]) -> Image {
    let ([a, b], [of_a, of_b]) = (color.halves, halves);
    let mut out = Image::new(a.width(), a.height(), a.channels());
    for c in 0..a.channels() {
        let (a, b, of_a, of_b) = (a.plane(c), b.plane(c), of_a.plane(c), of_b.plane(c));
        for (p, value) in out.plane_mut(c).iter_mut().enumerate() {
            let square = |x: f32, y: f32| (f64::from(x) - f64::from(y)).powi(2);
            // What is unknown is not taken off: the same for every candidate.
            let variance = color.variance.plane(c)[p];
            let noise = if variance.is_finite() { 2.0 * f64::from(variance) } else { 0.0 };
            let judged = 0.5 * ((square(b[p], of_a[p]) - noise) + (square(a[p], of_b[p]) - noise));
            let error = judged - 0.25 * square(of_b[p], of_a[p]);
            *value = error.clamp(-f64::from(MOST_SQUARE), f64::from(MOST_SQUARE)) as f32;
        }
    }
    out
}

/// Estimates of both candidates' errors, filtered, the narrower first.
#[derive(Debug, Clone)]
pub(super) struct Errors {
    /// As they are.
    pub estimates: [Image; 2],
    /// What is compared.
    pub compared: [Image; 2],
}

/// Filters the errors of both candidates. A clamped one is as good for a comparison, but no estimate: too large.
pub(super) fn filter_errors(
    color: &Color<'_>,
    candidates: &[Candidate; 2],
    params: &Params,
    settings: &Settings,
) -> Result<Errors, DenoiseError> {
    let [narrow, wide] = candidates.each_ref().map(|candidate| &candidate.error);
    if settings.negative_error == NegativeError::Kept {
        let estimates = filter_maps(color, [narrow, wide], params)?;
        return Ok(Errors { compared: estimates.clone(), estimates });
    }
    let [above, above_wide] = [narrow, wide].map(|error| error.map(|v| v.max(0.0)));
    let [narrow, wide, above, above_wide] = filter_maps(color, [narrow, wide, &above, &above_wide], params)?;
    Ok(Errors { estimates: [narrow, wide], compared: [above, above_wide] })
}

/// Filters maps with weights from the colour.
pub(super) fn filter_maps<const N: usize>(
    color: &Color<'_>,
    maps: [&Image; N],
    params: &Params,
) -> Result<[Image; N], DenoiseError> {
    let sizes = Sizes {
        patch: params.map_patch_radius_px,
        window: params.window_radius_px,
        k: params.map_k,
        scale: 1.0,
        epsilon: color.epsilon,
    };
    filter(maps, Guided { image: color.mean, variance: color.variance }, &sizes)
}
