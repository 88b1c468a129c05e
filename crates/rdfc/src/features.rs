//! Features: normalised to unit range, filtered by themselves, and measured against variance and slope (Sec. 5): what
//! Φ² and with it Eq. 3 compares.

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::{Estimate, Far, FeatureId, Frame, Image, Sampling, UnitRange};
use noisefloor_kernels::nlm::{FeatureChannel, MAX_VARIANCE, NlmParams};
use noisefloor_toolbox::{SlopeRule, mean_of_halves, scaled_sample_variance, smoothed_half_variance};

use crate::VarianceScaling;
use crate::kernel::{self, within_range};
use crate::params::Gradient;
use crate::settings::Settings;

/// A feature ready to make weights from.
#[derive(Debug, Clone)]
pub(crate) struct Feature {
    pub name: String,
    /// Prefiltered mean.
    pub mean: Image,
    /// Residual variance of it: Var_j.
    pub variance: Image,
    /// The larger of residual variance and squared slope: max(Var_j, |Grad_j|²), what Φ² is divided by beside τ.
    pub spread: Image,
}

impl Feature {
    pub fn channels(&self) -> Vec<FeatureChannel<'_>> {
        let planes = self.mean.planes().zip(self.variance.planes()).zip(self.spread.planes());
        planes.map(|((value, variance), spread)| FeatureChannel { value, variance, spread }).collect()
    }
}

/// The features of `names` that the frame has, in that order, with what brings them to unit range.
pub(crate) fn usable(frame: &Frame, names: &[String], far: Far) -> Vec<(FeatureId, UnitRange)> {
    let mut out: Vec<(FeatureId, UnitRange)> = Vec::new();
    for name in names {
        let id = FeatureId::from_name(name);
        let Some(feature) = frame.feature(&id).filter(|f| f.mean.channels() > 0) else { continue };
        if out.iter().all(|(known, _)| *known != id) {
            let unit = UnitRange::of(&id, &feature.mean, far);
            out.push((id, unit));
        }
    }
    out
}

/// A feature in its unit range, before its filter.
#[derive(Debug)]
pub(crate) struct Noisy<'a> {
    name: &'a str,
    mean: Image,
    variance: Image,
    halves: Option<[Image; 2]>,
}

/// Alg. 1, line 3: one feature of `frame` after another. Alg. 1, line 4: its sample variance scaled as the colour's is
/// (Sec. 4). What a feature without one gets is ours.
pub(crate) fn noisy<'a>(
    frame: &Frame,
    feature: &Estimate,
    name: &'a str,
    unit: UnitRange,
    scaling: VarianceScaling,
) -> Noisy<'a> {
    let Estimate { mean, variance, halves } = unit.apply(feature);
    // Halves may go beyond the mean's range, but not beyond the engine's.
    let (mean, halves) = (within_range(mean), halves.map(|halves| halves.map(within_range)));
    let sampled = variance.map(|v| v.into_mean_variance().map(|v| v.min(MAX_VARIANCE)));
    let variance = match (&sampled, &halves) {
        (Some(variance), Some(halves)) if scales(scaling, frame.sampling) => {
            scaled_sample_variance(variance, halves, &frame.samples, MAX_VARIANCE)
        }
        (Some(variance), _) => variance.clone(),
        (None, Some(halves)) => smoothed_half_variance(halves, &frame.samples, MAX_VARIANCE),
        // Nothing is known of its noise: taken as it is.
        (None, None) => Image::new(mean.width(), mean.height(), mean.channels()),
    };
    Noisy { name, mean, variance, halves }
}

/// Alg. 1, line 6: one feature of `frame` after another. Its weights come from its own patches (Sec. 5).
pub(crate) fn prefilter(
    method: &str,
    frame: &Frame,
    noisy: Noisy<'_>,
    settings: &Settings,
) -> Result<Feature, DenoiseError> {
    let Noisy { name, mean, variance, halves } = noisy;
    let (mean, variance) = match (settings.prefilter, &halves) {
        (Some(own), Some(halves)) => {
            let (width, height) = (mean.width(), mean.height());
            let params = NlmParams {
                center: settings.center,
                rules: settings.rules,
                ..NlmParams::new(width, height, own.radius, own.k)
            };
            // Alg. 1, line 7: both halves with weights from the whole.
            let guide = kernel::channels(&mean, &variance);
            let targets = kernel::half_planes(halves);
            let filtered = kernel::filter_guided(method, &params, own.patch, guide, targets)?;
            let halves = kernel::halves(&filtered.planes, width, height);
            // Alg. 1, line 8: what their difference says of the noise that is left.
            (
                mean_of_halves(&halves, &frame.samples),
                smoothed_half_variance(&halves, &frame.samples, MAX_VARIANCE),
            )
        }
        _ => (mean, variance),
    };
    // Sec. 5: edges of the feature itself count like noise, else weights along them are too strict (Fig. 4).
    let slope = squared_slope(&mean, settings.gradient);
    let spread = variance.zip_map(&slope, f32::max);
    Ok(Feature { name: name.to_owned(), mean, variance, spread })
}

/// Whether the sample variance of such a frame is scaled: independent samples need none of it (Sec. 4).
pub(crate) fn scales(scaling: VarianceScaling, sampling: Sampling) -> bool {
    match scaling {
        VarianceScaling::Auto => sampling != Sampling::Independent,
        VarianceScaling::Always => true,
        VarianceScaling::Never => false,
    }
}

/// |Grad_j|², the squared gradient magnitude, per channel (Sec. 5).
pub(crate) fn squared_slope(image: &Image, rule: Gradient) -> Image {
    let rule = match rule {
        Gradient::Off => return Image::new(image.width(), image.height(), image.channels()),
        Gradient::MinHalf => SlopeRule::MinHalf,
        Gradient::Central => SlopeRule::Central,
    };
    noisefloor_toolbox::squared_slope(image, rule, MAX_VARIANCE)
}
