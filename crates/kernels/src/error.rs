//! What can be wrong with a call of a kernel.

use crate::InstructionSet;

/// A parameter or input plane that a kernel refuses. Found before any work is done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KernelError {
    /// The image has no pixel, or more than fit in memory.
    #[error("image of {width}x{height} pixels: both sides must be at least 1 and the area at most {max}")]
    ImageSize {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
        /// Largest allowed number of pixels.
        max: usize,
    },
    /// A plane does not hold exactly one value per pixel.
    #[error("plane `{plane}` holds {actual} values, the image has {expected} pixels")]
    PlaneLength {
        /// Name of the plane.
        plane: String,
        /// Number of pixels.
        expected: usize,
        /// Length of the slice handed in.
        actual: usize,
    },
    /// A radius or count is out of range.
    #[error("{parameter} = {value}: allowed {least} to {most}")]
    Count {
        /// Name of the parameter.
        parameter: &'static str,
        /// Value handed in.
        value: usize,
        /// Smallest allowed value.
        least: usize,
        /// Largest allowed value.
        most: usize,
    },
    /// A real-valued parameter is out of range.
    #[error("{parameter} = {value}: allowed {least} to {most}")]
    Real {
        /// Name of the parameter.
        parameter: &'static str,
        /// Value handed in.
        value: f32,
        /// Smallest allowed value.
        least: f32,
        /// Largest allowed value.
        most: f32,
    },
    /// A value of a plane lies outside its allowed range.
    #[error("plane `{plane}` holds {value} at pixel ({x}, {y}): allowed is {allowed}")]
    Value {
        /// Name of the plane.
        plane: String,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// The value found.
        value: f32,
        /// Allowed range, in words.
        allowed: &'static str,
    },
    /// Inputs that do not go together.
    #[error("{what}")]
    Mismatch {
        /// What is missing, or differs from what.
        what: String,
    },
    /// The processor lacks the instruction set asked for.
    #[error("instruction set `{level}` is not available on this machine")]
    LevelUnavailable {
        /// The level asked for.
        level: InstructionSet,
    },
}
