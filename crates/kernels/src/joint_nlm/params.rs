//! Parameters, and what is refused.

use crate::engine::first_bad;

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
    /// Checks everything that [`super::filter`] refuses.
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
            let bad = first_bad(channel.value, |v| v.abs() <= MAX_VALUE)
                .map(|p| (p, channel.value[p]))
                .or_else(|| {
                    let bad = first_bad(channel.variance, |v| (0.0..=square).contains(&v));
                    bad.map(|p| (p, channel.variance[p]))
                });
            if let Some((pixel, value)) = bad {
                return Err(JointError::Value { value, pixel });
            }
        }
        Ok(())
    }
}
