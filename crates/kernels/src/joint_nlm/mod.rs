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
mod tile;

use crate::InstructionSet;
use crate::engine::{TILE, for_each_tile};
use tile::{Layout, Work};

pub(crate) use distance::squared;

/// Largest window radius in pixels.
pub const MAX_WINDOW_RADIUS: usize = 16;
/// Largest patch radius in pixels.
pub const MAX_PATCH_RADIUS: usize = 3;
/// Most channels.
pub const MAX_CHANNELS: usize = 16;
/// Largest magnitude of a value; of a variance its square.
pub const MAX_VALUE: f32 = 1e15;

/// What all channels share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointParams {
    /// Image width in pixels, at least 1.
    pub width: usize,
    /// Image height in pixels, at least 1.
    pub height: usize,
    /// Window radius in pixels, at most [`MAX_WINDOW_RADIUS`].
    pub window_radius: usize,
    /// Patch radius f in pixels, at most [`MAX_PATCH_RADIUS`].
    pub patch_radius: usize,
    /// k of Eq. 5, above 0.
    pub k: f32,
    /// σ_s in pixels, above 0.
    pub spatial_sigma: f32,
    /// σ_r, above 0.
    pub range_sigma: f32,
}

/// One channel.
#[derive(Clone, Copy, Debug)]
pub struct JointChannel<'a> {
    /// f_m.
    pub value: &'a [f32],
    /// Variance v_m of it, at least 0.
    pub variance: &'a [f32],
    /// σ_m, above 0.
    pub sigma: f32,
}

/// What the filter refuses.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JointError {
    /// A number is out of range.
    #[error("{name} = {value}: allowed {allowed}")]
    Number {
        /// What it is.
        name: &'static str,
        /// Value handed in.
        value: f64,
        /// Allowed values.
        allowed: &'static str,
    },
    /// A plane does not hold exactly one value per pixel.
    #[error("a plane holds {actual} values, the image has {expected} pixels")]
    PlaneLength {
        /// Number of pixels.
        expected: usize,
        /// Length of the slice handed in.
        actual: usize,
    },
    /// A value that is no number or too large.
    #[error("value {value} at pixel {pixel}: values are at most 1e15 in magnitude, variances from 0 to 1e30")]
    Value {
        /// Value handed in.
        value: f32,
        /// Index of the pixel.
        pixel: usize,
    },
}

impl JointParams {
    /// Checks everything that [`filter`] refuses.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self, channels: &[JointChannel<'_>]) -> Result<(), JointError> {
        let count = |name, value: usize, least: usize, most: usize, allowed| {
            if (least..=most).contains(&value) {
                Ok(())
            } else {
                Err(JointError::Number { name, value: value as f64, allowed })
            }
        };
        let positive = |name, value: f32| {
            if value > 1e-6 && value < 1e6 {
                Ok(())
            } else {
                Err(JointError::Number { name, value: value.into(), allowed: "1e-6 to 1e6" })
            }
        };
        count("width", self.width, 1, usize::MAX, "1 or more")?;
        count("height", self.height, 1, usize::MAX, "1 or more")?;
        count("window radius", self.window_radius, 0, MAX_WINDOW_RADIUS, "0 to 16")?;
        count("patch radius", self.patch_radius, 0, MAX_PATCH_RADIUS, "0 to 3")?;
        count("channels", channels.len(), 0, MAX_CHANNELS, "0 to 16")?;
        positive("k", self.k)?;
        positive("spatial sigma", self.spatial_sigma)?;
        positive("range sigma", self.range_sigma)?;
        let expected = self.width * self.height;
        for channel in channels {
            positive("sigma of a channel", channel.sigma)?;
            for plane in [channel.value, channel.variance] {
                if plane.len() != expected {
                    return Err(JointError::PlaneLength { expected, actual: plane.len() });
                }
            }
            let square = MAX_VALUE * MAX_VALUE;
            let bad = crate::engine::first_bad(channel.value, |v| v.abs() <= MAX_VALUE)
                .map(|p| (p, channel.value[p]))
                .or_else(|| {
                    let bad = crate::engine::first_bad(channel.variance, |v| (0.0..=square).contains(&v));
                    bad.map(|p| (p, channel.variance[p]))
                });
            if let Some((pixel, value)) = bad {
                return Err(JointError::Value { value, pixel });
            }
        }
        Ok(())
    }
}

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
///     width: 8, height: 1, window_radius: 5, patch_radius: 3, k: 1.0, spatial_sigma: 2.0, range_sigma: 1.0,
/// };
/// let out = &filter(&params, &[channel])?[0];
/// assert!((out[3] - 0.2).abs() < 0.006 && (out[4] - 0.8).abs() < 0.006);
/// # Ok::<(), noisefloor_kernels::joint_nlm::JointError>(())
/// ```
pub fn filter(params: &JointParams, channels: &[JointChannel<'_>]) -> Result<Vec<Vec<f32>>, JointError> {
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
) -> Result<Vec<Vec<f32>>, JointError> {
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
