//! What can be wrong with a call of the flash filter.

use crate::InstructionSet;

/// A parameter or input plane that the flash filter refuses. Found before any work is done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlashFilterError {
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
        plane: &'static str,
        /// Number of pixels.
        expected: usize,
        /// Length of the slice handed in.
        actual: usize,
    },
    /// The window radius is too large.
    #[error("window radius {value}: allowed 0 to {max} pixels")]
    WindowRadius {
        /// Radius asked for, in pixels.
        value: usize,
        /// Largest allowed radius, in pixels.
        max: usize,
    },
    /// The patch radius is too large.
    #[error("patch radius {value}: allowed 0 to {max} pixels")]
    PatchRadius {
        /// Radius asked for, in pixels.
        value: usize,
        /// Largest allowed radius, in pixels.
        max: usize,
    },
    /// A standard deviation in pixels is not a positive number.
    #[error("{parameter} = {value}: must be greater than 0 (infinity is allowed)")]
    Sigma {
        /// Name of the parameter.
        parameter: &'static str,
        /// Value handed in.
        value: f32,
    },
    /// A value of a plane lies outside its allowed range.
    #[error("plane `{plane}` holds {value} at pixel ({x}, {y}): allowed is {allowed}")]
    Value {
        /// Name of the plane.
        plane: &'static str,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// The value found.
        value: f32,
        /// Allowed range, in words.
        allowed: &'static str,
    },
    /// Too many frames on one side of the target.
    #[error("{value} frames {side} the target: allowed 0 to {max}")]
    Neighbors {
        /// `before` or `after`.
        side: &'static str,
        /// Number of frames handed in.
        value: usize,
        /// Largest allowed number.
        max: usize,
    },
    /// A frame beside the target has planes where the target has none, or the reverse.
    #[error("planes `{planes}` must be there in all frames or in none")]
    Unlike {
        /// Name of the planes.
        planes: &'static str,
    },
    /// Something is wrong with a frame beside the target.
    #[error("frame {time:+} from the target: {error}")]
    Neighbor {
        /// Place in time: -1 is the frame before the target, 1 the one after it.
        time: isize,
        /// What is wrong.
        #[source]
        error: Box<FlashFilterError>,
    },
    /// The processor lacks the instruction set asked for.
    #[error("instruction set `{level}` is not available on this machine")]
    LevelUnavailable {
        /// The level asked for.
        level: InstructionSet,
    },
    /// A pixel outside the image was asked for.
    #[error("pixel ({x}, {y}) lies outside the image of {width}x{height} pixels")]
    PixelOutside {
        /// Column asked for.
        x: usize,
        /// Row asked for.
        y: usize,
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
    },
    /// A colour channel other than 0, 1, 2 was asked for.
    #[error("colour channel {channel}: allowed 0 to 2")]
    Channel {
        /// Channel asked for.
        channel: usize,
    },
}
