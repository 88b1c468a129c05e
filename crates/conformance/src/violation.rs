use noisefloor_denoiser::{DenoiseError, Invariance, Need};
use noisefloor_frame::FrameError;
use thiserror::Error;

/// What a method did not keep, and on which frame.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{broken} ({case})")]
pub struct Violation {
    /// The frame, a phrase.
    pub case: String,
    /// What it did.
    pub broken: Broken,
}

/// What a method can do wrong; reads as the predicate of a sentence.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Broken {
    /// It panics.
    #[error("panics: {0}")]
    Panics(String),
    /// Its card contradicts itself.
    #[error("has a card that {0}")]
    Card(String),
    /// An image that it gives has another shape than the frame.
    #[error("gives another shape: {0}")]
    Shape(FrameError),
    /// It gives values that no such image can have.
    #[error("gives {values} values of {what} that are {how}")]
    Values {
        /// The image.
        what: String,
        /// How many.
        values: usize,
        /// What is wrong with them.
        how: &'static str,
    },
    /// It needs something that no frame here has.
    #[error("needs what a complete frame lacks: {}", list(.0))]
    Unmet(Vec<Need>),
    /// It runs where its card says that it cannot.
    #[error("runs although {0}")]
    Careless(Box<DenoiseError>),
    /// It refuses for another reason than the first one.
    #[error("refuses with \"{got}\" where the reason is \"{expected}\"")]
    Reason {
        /// What [`noisefloor_denoiser::Input::check`] says.
        expected: Box<DenoiseError>,
        /// What it said.
        got: Box<DenoiseError>,
    },
    /// It refuses a frame that has all it needs, and no caveat says that it may.
    #[error("refuses a frame that has all it needs: {0}")]
    Refuses(Box<DenoiseError>),
    /// It gives other bits where they must be equal.
    #[error("gives other bits {0}")]
    OtherBits(&'static str),
    /// It leaves an enclosure that it claims.
    #[error("leaves the enclosure \"{claim}\" {ratio}-fold at ({x}, {y}), channel {channel}")]
    Enclosure {
        /// Name of the claim.
        claim: String,
        /// Distance over half-width.
        ratio: f64,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// Channel.
        channel: usize,
    },
    /// It exceeds a bound more often than it claims.
    #[error("exceeds the bound \"{claim}\" too often: {told}")]
    Bound {
        /// Name of the claim.
        claim: String,
        /// Rates and tolerance in words.
        told: String,
    },
    /// An even image comes out at another level.
    #[error("takes an even image of a million {distance} away from there")]
    Level {
        /// Largest distance.
        distance: f64,
    },
    /// The output depends on what it should not.
    #[error("depends on the {what}: {drift} of the noise, allowed {allowed}")]
    Varies {
        /// What it should not depend on.
        what: Invariance,
        /// Root mean square of the difference over that of the input's standard error.
        drift: f64,
        /// Most that rounding explains.
        allowed: f64,
    },
}

impl Broken {
    /// On this frame.
    pub(crate) fn on(self, case: impl Into<String>) -> Violation {
        Violation { case: case.into(), broken: self }
    }
}

fn list(needs: &[Need]) -> String {
    needs.iter().map(Need::to_string).collect::<Vec<_>>().join(", ")
}
