//! Guided image filter (K. He, J. Sun, X. Tang, *Guided Image Filtering*, ECCV 2010): what is filtered is, in every window, a
//! linear function of a guide.
//!
//! In each window ω of radius r, clipped to the image, with guide I of n channels:
//!
//! ```text
//! a = (Cov_ω(I, I) + ε·1)⁻¹ Cov_ω(I, y),   b = E_ω[y] − aᵀ E_ω[I]          He et al., Eq. 5 and 6; 14 and 15 for n > 1
//! out(p) = āᵀ I(p) + b̄                                                   He et al., Eq. 8 and 16
//! ```
//!
//! ā and b̄ are means of a and b over the windows that contain p. Any number of planes y is filtered with the same guide. The
//! result is linear in y, and constant planes come back.
//!
//! Sums are in `f64`, over boxes whose cost per pixel does not grow with the radius; no value is taken off a sum again.
//! Before anything else each plane's mean is taken off it, so that a bright image loses no digits in its covariances.

mod band;
pub mod naive;
mod params;
#[allow(clippy::needless_range_loop, reason = "indices are those of a matrix")]
mod solve;
mod sums;

use rayon::prelude::*;

use crate::{InstructionSet, KernelError};
use band::Band;

pub use params::{GuidedParams, MAX_GUIDE_CHANNELS, MAX_RADIUS};

/// Least number of rows that are done at a time: their sums stay in the cache.
const ROWS: usize = 32;

/// Filters every target with the same guide, with the fastest instruction set of this machine.
///
/// ```
/// use noisefloor_kernels::guided::{GuidedParams, filter};
///
/// // A noisy step, guided by the step itself.
/// let step: Vec<f32> = (0..20).map(|x| if x < 10 { 0.0 } else { 1.0 }).collect();
/// let noisy: Vec<f32> = step.iter().enumerate().map(|(x, v)| 5.0 * v + 0.1 * (x % 2) as f32).collect();
/// let params = GuidedParams { width: 20, height: 1, radius: 3, epsilon: 1e-6 };
/// let out = &filter(&params, &[&step], &[&noisy])?[0];
/// assert!((out[9] - 0.05).abs() < 0.02 && (out[10] - 5.05).abs() < 0.02);
/// # Ok::<(), noisefloor_kernels::KernelError>(())
/// ```
///
/// # Errors
/// As [`GuidedParams::check`].
pub fn filter(
    params: &GuidedParams,
    guide: &[&[f32]],
    targets: &[&[f32]],
) -> Result<Vec<Vec<f32>>, KernelError> {
    filter_at(params, guide, targets, InstructionSet::in_use())
}

/// [`filter`] with a given instruction set. Every level gives the same bits; one that the processor does not have runs in
/// plain Rust.
///
/// # Errors
/// As [`GuidedParams::check`].
pub fn filter_at(
    params: &GuidedParams,
    guide: &[&[f32]],
    targets: &[&[f32]],
    level: InstructionSet,
) -> Result<Vec<Vec<f32>>, KernelError> {
    params.check(guide, targets)?;
    let mut out = vec![vec![0.0f32; params.width * params.height]; targets.len()];
    let means = |planes: &[&[f32]]| planes.iter().map(|plane| mean(plane)).collect::<Vec<_>>();
    let (guide_means, target_means) = (means(guide), means(targets));
    // Enough rows that those above and below, of which sums are made twice, are the lesser part.
    let rows = ROWS.max(4 * params.radius);
    let mut bands: Vec<Vec<&mut [f32]>> = Vec::new();
    for plane in &mut out {
        for (band, part) in plane.chunks_mut(rows * params.width).enumerate() {
            if band == bands.len() {
                bands.push(Vec::new());
            }
            bands[band].push(part);
        }
    }
    bands.into_par_iter().enumerate().for_each(|(band, out)| {
        let (guide_means, target_means) = (&guide_means, &target_means);
        level.run(Band { params, guide, targets, guide_means, target_means, first: band * rows, out });
    });
    Ok(out)
}

/// Mean of a plane of at least one value, summed in one order.
fn mean(plane: &[f32]) -> f64 {
    plane.iter().copied().map(f64::from).sum::<f64>() / plane.len() as f64
}
