//! The pass that removes the noise which the combination leaves (Alg. 1, lines 27-29; Sec. 7).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;
use noisefloor_kernels::nlm::{Denominator, MAX_VARIANCE, NlmInputs, NlmParams, Pass, Planes, filter};
use noisefloor_toolbox::{mean_of_halves, smoothed_half_variance};

use crate::features::Feature;
use crate::kernel;
use crate::params::SecondPass;
use crate::prepare::Prepared;
use crate::settings::{LOW_FLOOR, Settings};

/// Filters the combination by itself; the mean of both filtered halves.
pub(crate) fn second_pass(
    method: &str,
    target: &Prepared<'_>,
    halves: &[Image; 2],
    mean: &Image,
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let (width, height) = (mean.width(), mean.height());
    // Alg. 1, line 28: the noise that is left, by the difference of the halves (Sec. 5).
    let variance = smoothed_half_variance(halves, &target.frame.samples, MAX_VARIANCE);
    // Alg. 1, line 27: no features, patch radius 1, window radius R. The authors' program has other numbers.
    let (radius, patch, features): (_, _, &[Feature]) = match settings.second_pass {
        SecondPass::Off => return Ok(mean.clone()),
        SecondPass::Text => (settings.radius, 1, &[]),
        SecondPass::Code => (settings.radius / 2, 3, &target.features),
    };
    let params = NlmParams {
        // The program's denominator of features is twice the centre's own; the printed pass has no features.
        feature_k: settings.feature_k * std::f32::consts::SQRT_2,
        denominator: Denominator::Center,
        guide_denominator: settings.second_denominator,
        ..target.engine(settings, radius, settings.color_k)
    };
    // Alg. 1, line 29: the combination is its own guide.
    let frame = Planes {
        guide: kernel::channels(mean, &variance),
        features: features.iter().map(Feature::channels).collect(),
        targets: kernel::half_planes(halves),
    };
    let inputs = NlmInputs { frame, neighbors: Vec::new(), perturbation: None };
    let pass = Pass { patch: Some(patch), floor: LOW_FLOOR, derivative: false };
    let mut filtered = filter(&params, &[pass], &inputs).map_err(|e| kernel::kernel_error(method, &e))?;
    let filtered = filtered.remove(0); // one for each pass
    Ok(mean_of_halves(&kernel::halves(&filtered.planes, width, height), &target.frame.samples))
}
