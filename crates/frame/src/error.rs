use thiserror::Error;

/// What can be wrong with the parts of a frame.
#[derive(Debug, Clone, PartialEq, Error)]
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
    /// No pixel of the colour is finite in all its channels: there is no image.
    #[error("none of the {pixels} pixels has a colour that is finite in all channels: there is no image")]
    NoValidPixel {
        /// Pixels of the frame.
        pixels: usize,
    },
    /// The means of two halves, or of several parts, of the samples do not make up the mean of all of them: the buffers
    /// are of different images, or one of them was scaled, cleared or edited.
    #[error(
        "`{layer}`: its {made_of} do not average to the mean: at pixel ({x}, {y}), channel {channel}, they give {average}, but the \
         mean is {mean}; so in {values} of {of} values"
    )]
    Contradiction {
        /// Layer, such as `color` or `albedo`.
        layer: String,
        /// `halves` or `parts`.
        made_of: &'static str,
        /// Column of the worst value.
        x: usize,
        /// Row of the worst value.
        y: usize,
        /// Its channel, from 0.
        channel: usize,
        /// Its mean as stated.
        mean: f64,
        /// What halves or parts give: (n_A·A + n_B·B)/n.
        average: f64,
        /// Values that disagree beyond the precision of the buffers.
        values: usize,
        /// Values that were compared.
        of: usize,
    },
    /// A reference needs independently randomised parts.
    #[error("a reference needs at least {least} independent parts, {got} were given")]
    TooFewParts {
        /// Parts given.
        got: usize,
        /// Smallest number.
        least: usize,
    },
    /// A parameter beyond its range.
    #[error("{parameter} is {value}, expected {least} to {greatest}")]
    Parameter {
        /// What it is.
        parameter: &'static str,
        /// What was given.
        value: f64,
        /// Smallest value allowed.
        least: f64,
        /// Largest value allowed.
        greatest: f64,
    },
    /// No optional statistic has such a name.
    #[error("`{text}` is no optional statistic; there are {known}")]
    UnknownStatistic {
        /// What was asked for.
        text: String,
        /// The names that there are.
        known: String,
    },
    /// Something about an optional statistic does not fit.
    #[error("optional statistic `{id}`: {problem}")]
    Optional {
        /// Its id, or `tap`.
        id: &'static str,
        /// What is wrong.
        problem: String,
    },
}
