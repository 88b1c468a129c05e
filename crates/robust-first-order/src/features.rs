//! Features at their scale, and their collaborative prefilter (Sec. 3.2).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::{Far, FeatureId, Frame, Image, UnitRange};
use noisefloor_kernels::guided::{self, GuidedParams};
use noisefloor_kernels::joint_nlm::{self, JointChannel, JointParams};
use noisefloor_toolbox::half_variance;

use crate::card::{FEATURES, ID};
use crate::{FeaturePrefilter, Params};

/// Depth of background over the largest; it is not known, and one value for all of it.
const BACKGROUND: f32 = 1.1;
/// Above this a feature that should have unit length has another unit.
const UNIT: f32 = 1.001;

/// One channel of a feature.
#[derive(Debug, Clone)]
pub(crate) struct Channel {
    /// Feature and channel.
    pub name: String,
    /// Raw, then prefiltered.
    pub value: Vec<f32>,
    /// Variance of the raw mean.
    variance: Vec<f32>,
    /// σ_m.
    sigma: f32,
}

/// The channels of the features that the frame has: depth over its largest, normal in [−1, 1], albedo in [0, 1] (Sec. 3.1).
pub(crate) fn raw(frame: &Frame, params: &Params) -> Result<Vec<Channel>, DenoiseError> {
    let mut out = Vec::new();
    for id in FEATURES {
        let Some(feature) = frame.feature(&id) else { continue };
        DenoiseError::refuse(ID, "a value is not finite", &feature.mean, f32::is_finite)?;
        let variance = match (&feature.variance, &feature.halves) {
            (Some(variance), _) => variance.mean_variance().clone(),
            (None, Some(halves)) => {
                let mut out = Image::new(frame.width(), frame.height(), feature.mean.channels());
                for c in 0..out.channels() {
                    let plane = half_variance(halves, &frame.samples, c);
                    out.plane_mut(c).iter_mut().zip(plane).for_each(|(out, v)| *out = v as f32);
                }
                out
            }
            // Nothing is known of its noise: taken as it is.
            (None, None) => feature.mean.map(|_| 0.0),
        };
        let mut feature = noisefloor_frame::Estimate {
            mean: feature.mean.clone(),
            variance: Some(noisefloor_frame::Variance::of_mean(variance)),
            halves: None,
        };
        let sigma = match id {
            FeatureId::Depth => {
                feature = depth(&feature);
                params.depth_sigma
            }
            FeatureId::Normal => {
                let largest = feature.mean.data().iter().fold(0.0f32, |most, v| most.max(v.abs()));
                if largest > UNIT {
                    feature = divided(&feature, largest);
                }
                params.normal_sigma
            }
            _ => {
                feature = UnitRange::of(&id, &feature.mean, Far::Largest).apply(&feature);
                params.albedo_sigma
            }
        };
        let variance = feature.variance.map_or_else(|| feature.mean.map(|_| 0.0), |v| v.into_mean_variance());
        for (c, (value, variance)) in feature.mean.planes().zip(variance.planes()).enumerate() {
            out.push(Channel {
                name: format!("{} {c}", id.name()),
                value: value.to_vec(),
                // Values are of order 1.
                variance: variance.iter().map(|v| v.clamp(0.0, 1.0)).collect(),
                sigma: sigma as f32,
            });
        }
    }
    Ok(out)
}

/// Depth over its largest value. A depth that is not above 0 is background, which counts as a little farther than everything.
fn depth(feature: &noisefloor_frame::Estimate) -> noisefloor_frame::Estimate {
    let largest = feature.mean.data().iter().copied().fold(0.0f32, f32::max);
    if largest == 0.0 {
        return noisefloor_frame::Estimate::from_mean(feature.mean.map(|_| 0.0));
    }
    let mut out = divided(feature, largest);
    let background: Vec<bool> = feature.mean.data().iter().map(|v| *v <= 0.0).collect();
    let far = |image: &mut Image, value: f32| {
        image.data_mut().iter_mut().zip(&background).filter(|(_, far)| **far).for_each(|(v, _)| *v = value);
    };
    far(&mut out.mean, BACKGROUND);
    if let Some(variance) = out.variance.take() {
        let mut variance = variance.into_mean_variance();
        far(&mut variance, 0.0);
        out.variance = Some(noisefloor_frame::Variance::of_mean(variance));
    }
    out
}

fn divided(feature: &noisefloor_frame::Estimate, by: f32) -> noisefloor_frame::Estimate {
    let factor = 1.0 / f64::from(by);
    let variance = feature.variance.as_ref().map(|v| {
        let scaled = |v: f32| (f64::from(v) * factor * factor).min(f64::from(f32::MAX)) as f32;
        noisefloor_frame::Variance::of_mean(v.mean_variance().map(scaled))
    });
    noisefloor_frame::Estimate {
        mean: feature.mean.map(|v| (f64::from(v) * factor) as f32),
        variance,
        halves: None,
    }
}

/// Eq. 7: f̄ by joint non-local means, Eq. 3, Eq. 4 and Eq. 5, with the weights of the raw features; f̂ by a guided filter with f̄ as its own
/// guide, Eq. 6.
pub(crate) fn prefilter(
    channels: &mut [Channel],
    (width, height): (usize, usize),
    params: &Params,
) -> Result<(), DenoiseError> {
    if params.feature_prefilter == FeaturePrefilter::None {
        return Ok(());
    }
    let joint = JointParams {
        width,
        height,
        window_radius: params.prefilter_window_radius_px,
        patch_radius: params.patch_radius_px,
        k: params.prefilter_k as f32,
        spatial_sigma: params.spatial_sigma_px as f32,
        range_sigma: params.range_sigma as f32,
    };
    let inputs: Vec<JointChannel<'_>> = channels
        .iter()
        .map(|c| JointChannel { value: &c.value, variance: &c.variance, sigma: c.sigma })
        .collect();
    let filtered = joint_nlm::filter(&joint, &inputs).map_err(|e| DenoiseError::of_kernel(ID, &e))?;
    for (channel, filtered) in channels.iter_mut().zip(filtered) {
        channel.value = filtered;
    }
    if params.feature_prefilter == FeaturePrefilter::Both {
        let radius = params.feature_guided_radius_px;
        let guided = GuidedParams { width, height, radius, epsilon: params.guided_epsilon };
        for channel in channels {
            let own: &[f32] = &channel.value;
            let filtered =
                guided::filter(&guided, &[own], &[own]).map_err(|e| DenoiseError::of_kernel(ID, &e))?;
            channel.value = filtered.concat();
        }
    }
    Ok(())
}
