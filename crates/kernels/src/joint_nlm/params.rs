//! Parameters, and what is refused.

use crate::KernelError;
use crate::check::{self, count, real};

/// Largest window radius in pixels.
pub const MAX_WINDOW_RADIUS: usize = 16;
/// Largest patch radius in pixels.
pub const MAX_PATCH_RADIUS: usize = 3;
/// Most pixels that an image may have.
pub const MAX_PIXELS: usize = 1 << 31;
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

impl JointParams {
    /// Checks everything that [`super::filter`] refuses.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self, channels: &[JointChannel<'_>]) -> Result<(), KernelError> {
        check::size(self.width, self.height, MAX_PIXELS)?;
        count("window radius", self.window_radius, 0, MAX_WINDOW_RADIUS)?;
        count("patch radius", self.patch_radius, 0, MAX_PATCH_RADIUS)?;
        count("channels", channels.len(), 0, MAX_CHANNELS)?;
        let positive = |name, value: f32| real(name, value, 1e-6, 1e6);
        positive("k", self.k)?;
        positive("spatial sigma", self.spatial_sigma)?;
        positive("range sigma", self.range_sigma)?;
        let size = (self.width, self.height);
        for (i, channel) in channels.iter().enumerate() {
            positive("sigma of a channel", channel.sigma)?;
            let (value, variance) = (|| format!("channel {i}"), || format!("variance of channel {i}"));
            check::plane(value, channel.value, size, "a magnitude of at most 1e15", |v| {
                v.abs() <= MAX_VALUE
            })?;
            let square = MAX_VALUE * MAX_VALUE;
            check::plane(variance, channel.variance, size, "0 to 1e30", |v| (0.0..=square).contains(&v))?;
        }
        Ok(())
    }
}
