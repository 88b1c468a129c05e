//! Features: as the frame has them, and filtered by themselves.

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::{Estimate, FeatureId, Frame, Image};
use noisefloor_toolbox::{scaled_sample_variance, smoothed_half_variance};

use super::card::ID;
use super::half;
use super::kernel::{EPSILON, Guided, MOST, MOST_SQUARE, Sizes, filter, within};
use super::params::{Depth, Guide, Params};
use super::settings::Settings;

/// A feature before it is filtered.
#[derive(Debug, Clone)]
pub(super) struct Noisy {
    pub halves: [Image; 2],
    /// Of the mean of both halves; absent where nothing is known of its noise: both halves are the mean, and stay.
    pub variance: Option<Image>,
}

/// Where a depth that has none lies, in units of the largest.
const BACKGROUND: f32 = 1.1;

/// The features of a frame that are asked for.
pub(super) fn noisy(frame: &Frame, params: &Params, settings: &Settings) -> Result<Vec<Noisy>, DenoiseError> {
    let mut ids: Vec<FeatureId> = Vec::new();
    let mut out = Vec::new();
    for id in params.features.iter().map(|name| FeatureId::from_name(name)) {
        let Some(feature) = frame.feature(&id).filter(|f| f.mean.channels() > 0 && !ids.contains(&id)) else {
            continue;
        };
        for image in feature.halves.iter().flatten().chain([&feature.mean]) {
            DenoiseError::refuse(ID, "a feature is not finite", image, f32::is_finite)?;
        }
        out.push(if id == FeatureId::Depth && settings.depth == Depth::Scaled {
            of(frame, &scaled(feature), settings)
        } else {
            of(frame, feature, settings)
        });
        ids.push(id);
    }
    Ok(out)
}

fn of(frame: &Frame, feature: &Estimate, settings: &Settings) -> Noisy {
    let Some(halves) = &feature.halves else {
        let mean = within(&feature.mean, MOST);
        return Noisy { halves: [mean.clone(), mean], variance: None };
    };
    let halves = halves.each_ref().map(|half| within(half, MOST));
    let variance = match &feature.variance {
        Some(v) if settings.scales(frame.sampling) => {
            scaled_sample_variance(&known(v.mean_variance()), &halves, &frame.samples, MOST_SQUARE)
        }
        Some(v) => known(v.mean_variance()),
        None => smoothed_half_variance(&halves, &frame.samples, MOST_SQUARE),
    };
    Noisy { halves, variance: Some(variance) }
}

/// Variances in range, and NaN for what no variance can be: pixels that touch one are unlike all others.
pub(super) fn known(variance: &Image) -> Image {
    variance.map(|v| if v >= 0.0 { v.min(MOST_SQUARE) } else { f32::NAN })
}

/// Depth over its largest value, and beyond that where a pixel has none.
fn scaled(depth: &Estimate) -> Estimate {
    let largest = depth.mean.data().iter().fold(0.0f32, |most, v| most.max(*v));
    let unit = if largest > 0.0 { f64::from(largest) } else { 1.0 };
    let nowhere: Vec<bool> = depth.mean.data().iter().map(|v| *v <= 0.0).collect();
    let each = |image: &Image, power: i32, background: f32| {
        let mut out = image.map(|v| (f64::from(v) / unit.powi(power)) as f32);
        let values = out.data_mut().iter_mut().zip(&nowhere).filter(|(_, nowhere)| **nowhere);
        values.for_each(|(value, _)| *value = background);
        out
    };
    Estimate {
        mean: each(&depth.mean, 1, BACKGROUND),
        variance: depth.variance.as_ref().map(|v| noisefloor_frame::Variance::of_mean(each(v.mean_variance(), 2, 0.0))),
        halves: depth.halves.as_ref().map(|halves| halves.each_ref().map(|half| each(half, 1, BACKGROUND))),
    }
}

/// Step 1: both halves of a feature, each with weights from the other.
pub(super) fn prefilter(noisy: &Noisy, params: &Params, settings: &Settings) -> Result<[Image; 2], DenoiseError> {
    let Noisy { halves: [a, b], variance } = noisy;
    let Some(variance) = variance else { return Ok([a.clone(), b.clone()]) };
    let sizes = Sizes {
        patch: params.feature_patch_radius_px,
        window: params.feature_window_radius_px,
        k: params.feature_k,
        scale: 2.0,
        epsilon: EPSILON,
    };
    let one = |image: &Image, other: &Image| -> Result<Image, DenoiseError> {
        let image_of_weights = if settings.feature_guide == Guide::SameHalf { image } else { other };
        let [filtered] = filter([image], Guided { image: image_of_weights, variance }, &sizes)?;
        Ok(filtered)
    };
    Ok([one(a, b)?, one(b, a)?])
}

/// Step 4: the mean of both filtered halves, filtered by itself; what is left of its noise is seen in their difference.
pub(super) fn combine([a, b]: &[Image; 2], params: &Params, settings: &Settings) -> Result<Image, DenoiseError> {
    let mean = half::mean(a, b);
    let variance = half::variance(a, b);
    let sizes = Sizes {
        patch: settings.last_feature_patch,
        window: settings.last_feature_window,
        k: params.feature_k,
        scale: 1.0,
        epsilon: EPSILON,
    };
    let [filtered] = filter([&mean], Guided { image: &mean, variance: &variance }, &sizes)?;
    Ok(filtered)
}
