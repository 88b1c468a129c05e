use noisefloor_frame::Image;

use crate::{DenoiseError, Input};

/// A method that can say where further samples help it most.
///
/// Rendering goes in rounds: after each, the frame so far is handed in and the answer shared out over the next round's
/// budget. Data-dependent sample numbers bias means and void intervals; whoever runs the rounds says so.
pub trait Adaptive: Send + Sync {
    /// How many of the next samples each pixel should get, up to a common factor: one channel, finite, at least 0.
    /// All zero stands for no preference.
    ///
    /// # Errors
    /// As [`crate::Denoiser::denoise`].
    fn density(&self, input: &Input<'_>) -> Result<Image, DenoiseError>;
}
