//! Features: normalised to unit range, filtered by themselves, and measured against variance and slope (Sec. 5).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::{Estimate, Far, FeatureId, Frame, Image, Sampling, UnitRange};
use noisefloor_kernels::nlm::{FeatureChannel, MAX_VARIANCE, NlmParams};
use noisefloor_toolbox::{Slope, mean_of_halves, scaled_sample_variance, smoothed_half_variance};

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
    /// Residual variance of it.
    pub variance: Image,
    /// The larger of residual variance and squared slope.
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

/// Prefilters one feature of `frame`, which has it.
pub(crate) fn prefilter(
    method: &str,
    frame: &Frame,
    feature: &Estimate,
    name: &str,
    unit: UnitRange,
    settings: &Settings,
) -> Result<Feature, DenoiseError> {
    let Estimate { mean, variance, halves } = unit.apply(feature);
    // Halves may go beyond the mean's range, but not beyond the engine's.
    let (mean, halves) = (within_range(mean), halves.map(|halves| halves.map(within_range)));
    let sampled = variance.map(|v| v.into_mean_variance().map(|v| v.min(MAX_VARIANCE)));
    let variance = match (&sampled, &halves) {
        (Some(variance), Some(halves)) if scales(settings.scaling, frame.sampling) => {
            scaled_sample_variance(variance, halves, &frame.samples, MAX_VARIANCE)
        }
        (Some(variance), _) => variance.clone(),
        (None, Some(halves)) => smoothed_half_variance(halves, &frame.samples, MAX_VARIANCE),
        // Nothing is known of its noise: taken as it is.
        (None, None) => Image::new(mean.width(), mean.height(), mean.channels()),
    };
    let (mean, variance) = match (settings.prefilter, &halves) {
        (Some(own), Some(halves)) => {
            let (width, height) = (mean.width(), mean.height());
            let params =
                NlmParams { center: settings.center, ..NlmParams::new(width, height, own.radius, own.k) };
            let guide = kernel::channels(&mean, &variance);
            let targets = kernel::half_planes(halves);
            let filtered = kernel::filter_guided(method, &params, own.patch, guide, targets)?;
            let halves = kernel::halves(&filtered.planes, width, height);
            (
                mean_of_halves(&halves, &frame.samples),
                smoothed_half_variance(&halves, &frame.samples, MAX_VARIANCE),
            )
        }
        _ => (mean, variance),
    };
    let slope = squared_slope(&mean, settings.gradient);
    let spread = variance.zip_map(&slope, f32::max);
    Ok(Feature { name: name.to_owned(), mean, variance, spread })
}

/// Whether the sample variance of such a frame is scaled.
pub(crate) fn scales(scaling: VarianceScaling, sampling: Sampling) -> bool {
    match scaling {
        VarianceScaling::Auto => sampling != Sampling::Independent,
        VarianceScaling::Always => true,
        VarianceScaling::Never => false,
    }
}

/// Squared gradient magnitude per channel.
pub(crate) fn squared_slope(image: &Image, rule: Gradient) -> Image {
    let rule = match rule {
        Gradient::Off => return Image::new(image.width(), image.height(), image.channels()),
        Gradient::MinHalf => Slope::MinHalf,
        Gradient::Central => Slope::Central,
    };
    noisefloor_toolbox::squared_slope(image, rule, MAX_VARIANCE)
}
