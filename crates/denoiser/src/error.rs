use noisefloor_frame::FrameError;
use thiserror::Error;

use crate::{Need, Setting};

/// Why a method did not give an image.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum DenoiseError {
    /// Inputs that the method needs are absent; found before any work.
    #[error("{method} needs {}{}", list(missing), without(ways_out))]
    MissingInputs {
        /// Method id.
        method: String,
        /// Everything that is missing.
        missing: Vec<Need>,
        /// Settings, each sufficient, under which it does without, see [`crate::MethodCard::ways_out`].
        ways_out: Vec<Vec<Setting>>,
    },
    /// A parameter names a feature that has no fixed meaning and is not in the frame; found before any work.
    #[error("{method}: there is no feature `{feature}`; nearest: {}", nearest.join(", "))]
    UnknownFeature {
        /// Method id.
        method: String,
        /// Name given.
        feature: String,
        /// The closest names that mean something.
        nearest: Vec<String>,
    },
    /// The buffers of the input do not fit together.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// The method's own arithmetic has no answer for some pixels.
    #[error("{method}: {what} in {pixels} pixels, first at ({x}, {y})")]
    Undefined {
        /// Method id.
        method: String,
        /// What has no answer, such as `weight sum is zero`.
        what: &'static str,
        /// Pixels affected.
        pixels: usize,
        /// Column of the first.
        x: usize,
        /// Row of the first.
        y: usize,
    },
    /// A parameter that only a frame can show to be out of range, such as a probe outside the image.
    #[error("{method}: parameter {parameter} is {value}, allowed here: {allowed}")]
    Parameter {
        /// Method id.
        method: String,
        /// Parameter name.
        parameter: &'static str,
        /// Value given.
        value: String,
        /// Allowed range.
        allowed: String,
    },
}

impl DenoiseError {
    /// What kind of error it is, without its wording and numbers: a stable name.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::MissingInputs { .. } => "missing-inputs",
            Self::Frame(_) => "frame",
            Self::Undefined { .. } => "undefined",
            Self::Parameter { .. } => "parameter",
            Self::UnknownFeature { .. } => "unknown feature",
        }
    }
}

fn list(needs: &[Need]) -> String {
    needs.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

fn without(ways_out: &[Vec<Setting>]) -> String {
    let one = |way: &Vec<Setting>| way.iter().map(ToString::to_string).collect::<Vec<_>>().join(" and ");
    match ways_out {
        [] => String::new(),
        ways => {
            format!("; it does without with {}", ways.iter().map(one).collect::<Vec<_>>().join(", or with "))
        }
    }
}
