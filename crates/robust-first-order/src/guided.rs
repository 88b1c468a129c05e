//! The colour that weights are made from, and its variance (Sec. 3.3).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Frame;
use noisefloor_kernels::guided::{self, GuidedParams};
use noisefloor_toolbox::shares;

use crate::card::ID;
use crate::features::Channel;
use crate::gaussian::gaussian;
use crate::{ColorPrefilter, Params, VarianceKind};

/// Largest variance that models take.
pub(crate) const MAX_VARIANCE: f32 = 1e30;

/// M and the variance that its distances are measured against, three channels each.
#[derive(Debug)]
pub(crate) struct Guide {
    pub value: [Vec<f32>; 3],
    pub variance: [Vec<f32>; 3],
}

/// Eq. 8: M = (1/7) Σ_m GUID(y, f̂_m).
pub(crate) fn prefilter(
    frame: &Frame,
    sampled: [&[f32]; 3],
    channels: &[Channel],
    params: &Params,
) -> Result<Guide, DenoiseError> {
    let color = &frame.color.mean;
    let planes = [0, 1, 2].map(|c| color.plane(c));
    let halves = match (params.variance, &frame.color.halves) {
        (VarianceKind::Residual, Some(halves)) => Some(halves),
        _ => None,
    };
    // Every prefilter is linear: half the difference of both prefiltered halves is the prefiltered half difference.
    let differences = halves.map(|[a, b]| {
        [0, 1, 2].map(|c| a.plane(c).iter().zip(b.plane(c)).map(|(a, b)| a - b).collect::<Vec<f32>>())
    });
    let mut targets: Vec<&[f32]> = planes.to_vec();
    targets.extend(differences.iter().flatten().map(Vec::as_slice));
    let mut filtered = linear(&targets, frame.width(), frame.height(), channels, params)?.into_iter();
    let mut three = || [(); 3].map(|()| filtered.next().unwrap_or_default());
    let value = three();
    let variance = if halves.is_some() {
        three().map(|difference| {
            let square = |(p, d): (usize, &f32)| shares(&frame.samples, p).square * f64::from(*d).powi(2);
            let squares: Vec<f64> = difference.iter().enumerate().map(square).collect();
            let smooth = gaussian(&squares, frame.width(), params.residual_blur_px);
            smooth.into_iter().map(|v| v.clamp(0.0, MAX_VARIANCE.into()) as f32).collect()
        })
    } else {
        sampled.map(<[f32]>::to_vec)
    };
    Ok(Guide { value, variance })
}

/// The prefilter of the colour, for any planes. Without features a guided one is a Gaussian.
fn linear(
    targets: &[&[f32]],
    width: usize,
    height: usize,
    channels: &[Channel],
    params: &Params,
) -> Result<Vec<Vec<f32>>, DenoiseError> {
    match params.color_prefilter {
        ColorPrefilter::None => return Ok(targets.iter().map(|plane| plane.to_vec()).collect()),
        ColorPrefilter::Guided if !channels.is_empty() => {}
        _ => {
            let smooth = |plane: &&[f32]| {
                let values: Vec<f64> = plane.iter().copied().map(f64::from).collect();
                gaussian(&values, width, params.gaussian_px).into_iter().map(|v| v as f32).collect()
            };
            return Ok(targets.iter().map(smooth).collect());
        }
    }
    let guided =
        GuidedParams { width, height, radius: params.color_guided_radius_px, epsilon: params.guided_epsilon };
    let mut sums = vec![vec![0.0f64; width * height]; targets.len()];
    for channel in channels {
        let filtered = guided::filter(&guided, &[&channel.value], targets)
            .map_err(|e| DenoiseError::of_kernel(ID, &e))?;
        for (sums, filtered) in sums.iter_mut().zip(&filtered) {
            sums.iter_mut().zip(filtered).for_each(|(sum, v)| *sum += f64::from(*v));
        }
    }
    let count = channels.len() as f64;
    Ok(sums.iter().map(|plane| plane.iter().map(|v| (v / count) as f32).collect()).collect())
}
