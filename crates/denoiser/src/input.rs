use noisefloor_frame::{FeatureId, Frame};

use crate::{DenoiseError, MethodCard};

/// Whether a method should spend time on diagnostic images.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Diagnostics {
    /// Only the image: what is timed.
    #[default]
    Off,
    /// Everything the source work's figures show, probing this pixel `(x, y)` where a figure needs one
    /// (`None`: the middle of the image).
    On {
        /// Column and row of the pixel to look at.
        probe: Option<(usize, usize)>,
    },
}

/// What a method gets.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The frame to denoise, sanitised.
    pub target: &'a Frame,
    /// Neighbouring frames of an animation in time order, earlier ones first; usually empty.
    pub before: &'a [Frame],
    /// Neighbouring frames after the target.
    pub after: &'a [Frame],
    /// What to compute beside the image.
    pub diagnostics: Diagnostics,
}

impl<'a> Input<'a> {
    /// A single frame, which the caller has passed through [`Frame::inspect`] or [`Frame::sanitize`].
    #[must_use]
    pub fn new(target: &'a Frame) -> Self {
        Self { target, before: &[], after: &[], diagnostics: Diagnostics::Off }
    }

    /// Asks for diagnostics.
    #[must_use]
    pub fn with_diagnostics(self, diagnostics: Diagnostics) -> Self {
        Self { diagnostics, ..self }
    }

    /// Adds neighbouring frames of an animation, sanitised like the target and in time order.
    #[must_use]
    pub fn with_neighbors(self, before: &'a [Frame], after: &'a [Frame]) -> Self {
        Self { before, after, ..self }
    }

    /// Refuses before any work: every need of the card must be met, every feature that it names must mean something,
    /// and all buffers must fit together.
    ///
    /// # Errors
    /// [`DenoiseError::MissingInputs`] with all that is missing, [`DenoiseError::UnknownFeature`], or
    /// [`DenoiseError::Frame`].
    pub fn check(&self, card: &MethodCard) -> Result<(), DenoiseError> {
        let missing = card.missing(self.target);
        if !missing.is_empty() {
            let ways_out = card.ways_out(self.target);
            return Err(DenoiseError::MissingInputs { method: card.id.clone(), missing, ways_out });
        }
        if let Some((feature, nearest)) =
            card.unknown_feature(self.target.features.keys().map(FeatureId::name))
        {
            return Err(DenoiseError::UnknownFeature { method: card.id.clone(), feature, nearest });
        }
        self.target.check()?;
        let (width, height) = (self.target.width(), self.target.height());
        for neighbor in self.before.iter().chain(self.after) {
            neighbor.check()?;
            neighbor.color.mean.expect_shape("colour of a neighbouring frame", width, height, 3)?;
        }
        Ok(())
    }
}
