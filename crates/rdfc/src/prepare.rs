//! A frame with everything that the filters look at.

use noisefloor_denoiser::{DenoiseError, StageTimer};
use noisefloor_frame::{FeatureId, Frame, Image, UnitRange, Variance};
use noisefloor_kernels::nlm::{MAX_VALUE, MAX_VARIANCE, NlmParams, Planes};
use noisefloor_toolbox::scaled_sample_variance;

use crate::features::{Feature, prefilter, scales};
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
    /// ε of distances of the colour.
    pub epsilon: f32,
}

impl<'a> Prepared<'a> {
    /// Prepares a checked frame with those of `features` that it has. Both stages go to `timer`.
    pub fn new(
        method: &str,
        frame: &'a Frame,
        features: &[(FeatureId, UnitRange)],
        epsilon: f32,
        settings: &Settings,
        timer: &mut StageTimer,
    ) -> Result<Self, DenoiseError> {
        let sampled = frame.color.variance.as_ref().map(Variance::mean_variance);
        let (Some(halves), Some(sampled)) = (&frame.color.halves, sampled) else {
            return Err(DenoiseError::MissingInputs {
                method: method.into(),
                missing: vec![
                    noisefloor_denoiser::Need::ColorHalves,
                    noisefloor_denoiser::Need::ColorVariance,
                ],
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
        let variance = if scales(settings.scaling, frame.sampling) {
            scaled_sample_variance(sampled, halves, &frame.samples, MAX_VARIANCE)
        } else {
            sampled.map(|v| v.min(MAX_VARIANCE))
        };
        timer.finish("variance");
        let features = features
            .iter()
            .filter_map(|(id, unit)| frame.feature(id).map(|feature| (id, feature, *unit)))
            .map(|(id, feature, unit)| prefilter(method, frame, feature, id.name(), unit, settings))
            .collect::<Result<_, _>>()?;
        timer.finish("prefilter");
        Ok(Self { frame, halves, variance, features, epsilon })
    }

    /// Parameters of the engine for weights from the colour and the features.
    pub fn engine(&self, settings: &Settings, radius: usize, k: f32) -> NlmParams {
        NlmParams {
            feature_k: settings.feature_k,
            denominator: settings.denominator,
            center: settings.center,
            epsilon: self.epsilon,
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

/// Refuses values that there is no answer for: not finite ones, as brighter frames come at a lower exposure; with the
/// number of pixels that hold one.
fn check_values(method: &str, image: &Image, limit: f32) -> Result<(), DenoiseError> {
    // A NaN fails the comparison.
    DenoiseError::refuse(method, "a value is not finite", image, |v| v.abs() <= limit)
}
