use noisefloor_frame::Image;
use serde::{Deserialize, Serialize};

/// Seconds of one named stage of a method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StageSeconds {
    /// Stage, such as `step 1`.
    pub name: String,
    /// Wall-clock seconds.
    pub seconds: f64,
}

/// A bound that a method states for this very image.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// Which of the card's claims, by name.
    pub claim: String,
    /// Half-width per pixel and channel: |D−μ| ≤ half_width at the claim's level.
    pub half_width: Image,
}

/// What a method gives back.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Denoised radiance, 3 channels, shape of the target.
    pub image: Image,
    /// Own estimate of the squared error per pixel and channel, if the method has one.
    pub error_estimate: Option<Image>,
    /// The image that the estimate is about, with a name for people, where that is not `image`: an intermediate one. Shape
    /// of the target.
    pub estimate_of: Option<(String, Image)>,
    /// Stated bounds.
    pub bounds: Vec<Bound>,
    /// Named images that the source work's figures show: flash image, homogeneous set, kernel radius.
    pub diagnostics: Vec<(String, Image)>,
    /// Named numbers worth keeping, such as the flash intensity.
    pub figures: Vec<(String, f64)>,
    /// Seconds per stage in order.
    pub stages: Vec<StageSeconds>,
}

impl Output {
    /// An image and nothing else.
    #[must_use]
    pub fn from_image(image: Image) -> Self {
        Self {
            image,
            error_estimate: None,
            estimate_of: None,
            bounds: Vec::new(),
            diagnostics: Vec::new(),
            figures: Vec::new(),
            stages: Vec::new(),
        }
    }
}
