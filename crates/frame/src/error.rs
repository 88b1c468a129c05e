use thiserror::Error;

/// What can be wrong with the parts of a frame.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FrameError {
    /// The number of values does not fill the stated shape.
    #[error("{width}×{height}×{channels} needs {} values, {got} were given", width * height * channels)]
    Length {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Planes.
        channels: usize,
        /// Values given.
        got: usize,
    },
    /// Width, height or channels is zero, or their product overflows.
    #[error("an image of {width}×{height}×{channels} is empty or too large to address")]
    Shape {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Planes.
        channels: usize,
    },
    /// Two buffers that must agree in shape do not.
    #[error("{what} is {got_width}×{got_height}×{got_channels}, expected {width}×{height}×{channels}")]
    Mismatch {
        /// Name of the offending buffer, such as `albedo.variance`.
        what: String,
        /// Expected columns.
        width: usize,
        /// Expected rows.
        height: usize,
        /// Expected planes.
        channels: usize,
        /// Columns found.
        got_width: usize,
        /// Rows found.
        got_height: usize,
        /// Planes found.
        got_channels: usize,
    },
    /// A per-pixel sample count map does not cover the frame.
    #[error("{what} has {got} entries, the frame has {pixels} pixels")]
    CountMap {
        /// Name of the map.
        what: String,
        /// Pixels of the frame.
        pixels: usize,
        /// Entries found.
        got: usize,
    },
    /// A sample count that gives no meaning to the buffer.
    #[error("{what}: sample count is {got}, at least {least} is needed")]
    TooFewSamples {
        /// Name of the buffer.
        what: String,
        /// Count found.
        got: u32,
        /// Smallest count that works.
        least: u32,
    },
    /// A reference needs independently randomised parts.
    #[error("a reference needs at least {least} independent parts, {got} were given")]
    TooFewParts {
        /// Parts given.
        got: usize,
        /// Smallest number.
        least: usize,
    },
}
