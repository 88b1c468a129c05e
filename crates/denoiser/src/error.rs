use std::borrow::Cow;

use noisefloor_frame::{Frame, FrameError, Image};
use noisefloor_toolbox::{Bad, find_bad};
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
        what: Cow<'static, str>,
        /// Pixels affected.
        pixels: usize,
        /// Column of the first.
        x: usize,
        /// Row of the first.
        y: usize,
    },
    /// A program outside did not do its work.
    #[error("{method} {what}")]
    Program {
        /// Name of the program.
        method: String,
        /// What happened, and the end of what it said.
        what: String,
    },
    /// A parameter that only a frame can show to be out of range, such as a probe outside the image.
    #[error("{method}: parameter {parameter} is {value}, allowed here: {allowed}")]
    Parameter {
        /// Method id.
        method: String,
        /// Parameter name.
        parameter: Cow<'static, str>,
        /// Value given.
        value: String,
        /// Allowed range.
        allowed: String,
    },
}

impl DenoiseError {
    /// An error if values of an image are not good, with the number of pixels that hold one. Write `good` so that a NaN
    /// fails it.
    ///
    /// # Errors
    /// [`DenoiseError::Undefined`].
    pub fn refuse(
        method: &str,
        what: impl Into<Cow<'static, str>>,
        image: &Image,
        good: impl Fn(f32) -> bool + Sync,
    ) -> Result<(), Self> {
        match find_bad(image, good) {
            None => Ok(()),
            Some(Bad { pixels, x, y }) => {
                Err(Self::Undefined { method: method.into(), what: what.into(), pixels, x, y })
            }
        }
    }

    /// An error if a frame has more pixels than a method takes.
    ///
    /// # Errors
    /// [`DenoiseError::Parameter`].
    pub fn refuse_size(method: &str, frame: &Frame, most: usize) -> Result<(), Self> {
        if frame.pixels() <= most {
            return Ok(());
        }
        Err(Self::Parameter {
            method: method.into(),
            parameter: "image size".into(),
            value: format!("{} pixels", frame.pixels()),
            allowed: format!("at most {most}"),
        })
    }

    /// An error that a kernel found after all, although its input was checked before it ran; its message is kept.
    pub fn of_kernel(method: &str, error: &dyn std::error::Error) -> Self {
        Self::Parameter {
            method: method.into(),
            parameter: "kernel input".into(),
            value: error.to_string(),
            allowed: "what the kernel's documentation says".into(),
        }
    }

    /// What kind of error it is, without its wording and numbers: a stable name.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::MissingInputs { .. } => "missing-inputs",
            Self::Frame(_) => "frame",
            Self::Undefined { .. } => "undefined",
            Self::Parameter { .. } => "parameter",
            Self::Program { .. } => "program",
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
