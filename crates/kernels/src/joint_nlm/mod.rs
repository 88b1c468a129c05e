//! Non-local means of features by themselves, each channel with weights from its own patches, from all channels at the pixel, and
//! from the distance (liu2018robust, Sec. 3.2).
//!
//! ```text
//! w_m(i,j) = exp(−|i−j|²/(2σ_s²)) · exp(−P_m(i,j)/(2σ_r²)) · Π_l exp(−(f_l(i)−f_l(j))²/(2σ_l²))            Eq. 3
//! P_m(i,j) = max(0, mean of d over the (2f+1)² taps of the patch)                                         Eq. 4
//! d(i,j)   = ((f_m(i)−f_m(j))² − (v_m(i) + min(v_m(i), v_m(j)))) / (k²·(v_m(i) + v_m(j)))                  Eq. 5
//! f̄_m(i)   = Σ_j w_m(i,j)·f_m(j) / Σ_j w_m(i,j)                                                           Eq. 7, first line
//! ```
//!
//! ε of Eq. 5 is 0, with 0/0 = 0 and at most 1e4, so that no result depends on the unit of a feature. The window is clipped to the
//! image, patch taps outside read the mirrored pixel. w_m(i,i) = 1, so that no sum is 0.

mod distance;
pub mod naive;
mod params;
mod tile;

use crate::engine::{TILE, for_each_tile};
use crate::{InstructionSet, KernelError};
use tile::{Layout, Work};

pub(crate) use distance::squared;
pub use params::{JointChannel, JointParams, MAX_CHANNELS, MAX_PATCH_RADIUS, MAX_VALUE, MAX_WINDOW_RADIUS};

/// Filters every channel, with the fastest instruction set of this machine.
///
/// # Errors
/// As [`JointParams::check`].
///
/// ```
/// use noisefloor_kernels::joint_nlm::{JointChannel, JointParams, filter};
///
/// // A step of a feature that varies by 1e-4 around 0.2 and 0.8.
/// let noisy: Vec<f32> = (0..8).map(|x| if x < 4 { 0.2 } else { 0.8 } + if x % 2 == 0 { 0.01 } else { -0.01 }).collect();
/// let channel = JointChannel { value: &noisy, variance: &[1e-4; 8], sigma: 0.25 };
/// let params = JointParams {
///     width: 8, height: 1, window_radius: 5, patch_radius: 0, k: 1.0, spatial_sigma: 10.0, range_sigma: 1.0,
/// };
/// let out = &filter(&params, &[channel])?[0];
/// assert!((out[3] - 0.2).abs() < 0.006 && (out[4] - 0.8).abs() < 0.006);
/// # Ok::<(), noisefloor_kernels::KernelError>(())
/// ```
pub fn filter(params: &JointParams, channels: &[JointChannel<'_>]) -> Result<Vec<Vec<f32>>, KernelError> {
    filter_at(params, channels, InstructionSet::in_use())
}

/// [`filter`] with a given instruction set. Every level gives the same bits; one that the processor does not have runs in
/// plain Rust.
///
/// # Errors
/// As [`JointParams::check`].
pub fn filter_at(
    params: &JointParams,
    channels: &[JointChannel<'_>],
    level: InstructionSet,
) -> Result<Vec<Vec<f32>>, KernelError> {
    params.check(channels)?;
    let layout = Layout::new(params, channels.len(), TILE);
    let mut out = vec![vec![0.0f32; params.width * params.height]; channels.len()];
    for_each_tile(
        params.width,
        TILE,
        out.iter_mut().map(Vec::as_mut_slice),
        || Work::new(&layout),
        |work, tile, out| level.run(tile::Filter { params, channels, layout: &layout, work, tile, out }),
    );
    Ok(out)
}
