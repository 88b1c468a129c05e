//! A frame with everything that the filters look at.

use noisefloor_denoiser::{DenoiseError, Need};
use noisefloor_frame::{FeatureId, Frame, Image, UnitRange, Variance};
use noisefloor_kernels::nlm::{MAX_VALUE, MAX_VARIANCE, NlmParams, Planes};
use noisefloor_toolbox::scaled_sample_variance;

use crate::VarianceScaling;
use crate::features::{Feature, scales};
use crate::kernel;
use crate::settings::Settings;

/// A frame with variances at the right level and its features prefiltered.
#[derive(Debug)]
pub(crate) struct Prepared<'a> {
    pub frame: &'a Frame,
    /// Both halves of the colour.
    pub halves: &'a [Image; 2],
    /// Variance of the colour's mean.
    pub variance: Image,
    pub features: Vec<Feature>,
    /// ε of distances of the colour (Sec. 4).
    pub epsilon: f32,
}

impl Prepared<'_> {
    /// Parameters of the engine for weights from the colour and the features.
    pub fn engine(&self, settings: &Settings, radius: usize, k: f32) -> NlmParams {
        NlmParams {
            feature_k: settings.feature_k,
            denominator: settings.denominator,
            center: settings.center,
            epsilon: self.epsilon,
            rules: settings.rules,
            ..NlmParams::new(self.frame.width(), self.frame.height(), radius, k)
        }
    }

    /// Guide and features of the engine, for `targets` to filter.
    pub fn planes<'b>(&'b self, targets: Vec<&'b [f32]>) -> Planes<'b> {
        Planes {
            guide: kernel::channels(&self.frame.color.mean, &self.variance),
            features: self.features.iter().map(Feature::channels).collect(),
            targets,
        }
    }
}

/// Half buffers and sample variance of the mean of the colour: c and svar_c of Alg. 1, from a frame whose values and
/// `features` are finite.
pub(crate) fn noisy_color<'a>(
    method: &str,
    frame: &'a Frame,
    features: &[(FeatureId, UnitRange)],
) -> Result<(&'a [Image; 2], &'a Image), DenoiseError> {
    let sampled = frame.color.variance.as_ref().map(Variance::mean_variance);
    let (Some(halves), Some(sampled)) = (&frame.color.halves, sampled) else {
        return Err(DenoiseError::MissingInputs {
            method: method.into(),
            missing: vec![Need::ColorHalves, Need::ColorVariance],
            ways_out: Vec::new(),
        });
    };
    check_values(method, &frame.color.mean, MAX_VALUE)?;
    for half in halves {
        check_values(method, half, MAX_VALUE)?;
    }
    for feature in features.iter().filter_map(|(id, _)| frame.feature(id)) {
        check_values(method, &feature.mean, f32::MAX)?;
        for half in feature.halves.iter().flatten() {
            check_values(method, half, f32::MAX)?;
        }
    }
    Ok((halves, sampled))
}

/// Alg. 1, line 2: the sample variance scaled to the level of the two-buffer variance (Sec. 4), which low-discrepancy
/// samples need; of independent ones it is right as it is.
pub(crate) fn color_variance(
    frame: &Frame,
    halves: &[Image; 2],
    sampled: &Image,
    scaling: VarianceScaling,
) -> Image {
    if scales(scaling, frame.sampling) {
        scaled_sample_variance(sampled, halves, &frame.samples, MAX_VARIANCE)
    } else {
        sampled.map(|v| v.min(MAX_VARIANCE))
    }
}

/// Whether both frames have the same features with the same channels.
pub(crate) fn alike(a: &Prepared<'_>, b: &Prepared<'_>) -> bool {
    let shape = |p: &Prepared<'_>| -> Vec<(String, usize)> {
        p.features.iter().map(|f| (f.name.clone(), f.mean.channels())).collect()
    };
    shape(a) == shape(b)
}

/// Refuses values that there is no answer for: not finite ones, as brighter frames come at a lower exposure; with the
/// number of pixels that hold one.
fn check_values(method: &str, image: &Image, limit: f32) -> Result<(), DenoiseError> {
    // A NaN fails the comparison.
    DenoiseError::refuse(method, "a value is not finite", image, |v| v.abs() <= limit)
}
