//! Parameters, and what is refused.

use crate::KernelError;
use crate::check::{self, count, real};

/// Most channels of a guide.
pub const MAX_GUIDE_CHANNELS: usize = 8;
/// Most pixels that an image may have.
pub const MAX_PIXELS: usize = 1 << 31;
/// Largest window radius in pixels.
pub const MAX_RADIUS: usize = 4096;

/// Size of the image and of the filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuidedParams {
    /// Image width in pixels, at least 1.
    pub width: usize,
    /// Image height in pixels, at least 1.
    pub height: usize,
    /// Window radius r in pixels, at most [`MAX_RADIUS`].
    pub radius: usize,
    /// ε, squared units of the guide, at least 0. At 0 a guide that is constant in a window takes no part there.
    pub epsilon: f64,
}

impl GuidedParams {
    /// Checks everything that [`super::filter`] refuses.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self, guide: &[&[f32]], targets: &[&[f32]]) -> Result<(), KernelError> {
        check::size(self.width, self.height, MAX_PIXELS)?;
        count("radius", self.radius, 0, MAX_RADIUS)?;
        real("epsilon", self.epsilon as f32, 0.0, f32::MAX)?;
        count("guide channels", guide.len(), 1, MAX_GUIDE_CHANNELS)?;
        let size = (self.width, self.height);
        for (name, planes) in [("guide channel", guide), ("target", targets)] {
            for (i, plane) in planes.iter().enumerate() {
                check::length(|| format!("{name} {i}"), plane, size)?;
            }
        }
        Ok(())
    }
}
