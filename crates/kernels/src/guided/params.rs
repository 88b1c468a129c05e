//! Parameters, and what is refused.

/// Most channels of a guide.
pub const MAX_GUIDE_CHANNELS: usize = 8;
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

/// A parameter or plane that the filter refuses.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GuidedError {
    /// The image has no pixel.
    #[error("image of {width}x{height} pixels: both sides must be at least 1")]
    ImageSize {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
    /// A plane does not hold exactly one value per pixel.
    #[error("a plane holds {actual} values, the image has {expected} pixels")]
    PlaneLength {
        /// Number of pixels.
        expected: usize,
        /// Length of the slice handed in.
        actual: usize,
    },
    /// The radius is too large.
    #[error("radius = {radius}: allowed 0 to {MAX_RADIUS}")]
    Radius {
        /// Value handed in.
        radius: usize,
    },
    /// ε is negative or not finite.
    #[error("epsilon = {epsilon}: must be at least 0 and finite")]
    Epsilon {
        /// Value handed in.
        epsilon: f64,
    },
    /// A guide without channels, or with too many.
    #[error("a guide of {channels} channels: allowed 1 to {MAX_GUIDE_CHANNELS}")]
    GuideChannels {
        /// Number handed in.
        channels: usize,
    },
}

impl GuidedParams {
    /// Checks everything that [`super::filter`] refuses.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self, guide: &[&[f32]], targets: &[&[f32]]) -> Result<(), GuidedError> {
        let Self { width, height, radius, epsilon } = *self;
        if width == 0 || height == 0 {
            return Err(GuidedError::ImageSize { width, height });
        }
        if radius > MAX_RADIUS {
            return Err(GuidedError::Radius { radius });
        }
        if !(epsilon.is_finite() && epsilon >= 0.0) {
            return Err(GuidedError::Epsilon { epsilon });
        }
        if guide.is_empty() || guide.len() > MAX_GUIDE_CHANNELS {
            return Err(GuidedError::GuideChannels { channels: guide.len() });
        }
        match guide.iter().chain(targets).find(|plane| plane.len() != width * height) {
            Some(plane) => Err(GuidedError::PlaneLength { expected: width * height, actual: plane.len() }),
            None => Ok(()),
        }
    }
}
