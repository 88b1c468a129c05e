use noisefloor_frame::FrameError;
use thiserror::Error;

/// Why images cannot be compared.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MetricError {
    /// Test image and reference, or parts of the reference, differ in shape, or are not of 3 channels.
    #[error(transparent)]
    Shape(#[from] FrameError),
    /// The class map does not cover the image.
    #[error("class map has {got} entries, the reference has {pixels} pixels")]
    ClassMap {
        /// Pixels of the reference.
        pixels: usize,
        /// Entries given.
        got: usize,
    },
    /// An entry of the class map has no name.
    #[error("class map has index {index} at pixel {pixel}, but only {names} class names were given")]
    ClassIndex {
        /// Row-major pixel.
        pixel: usize,
        /// Its class.
        index: u8,
        /// Names given.
        names: usize,
    },
    /// Nothing of the reference can stand for the truth.
    #[error(
        "no common pixel: none of the reference's {pixels} pixels is finite in its mean, variance, halves and parts"
    )]
    NoReferencePixel {
        /// Pixels of the reference.
        pixels: usize,
    },
    /// Image and reference have no pixel in which both are finite.
    #[error("no common pixel: none of {pixels} pixels is finite in both image and reference")]
    NoCommonPixel {
        /// Pixels of the image.
        pixels: usize,
    },
    /// The map of a metric does not cover the image.
    #[error("metric `{id}` gave {got} values for {pixels} pixels")]
    Map {
        /// Id of the metric.
        id: &'static str,
        /// Pixels of the image.
        pixels: usize,
        /// Values given.
        got: usize,
    },
    /// A metric could not be computed.
    #[error("metric `{id}`: {reason}")]
    Failed {
        /// Id of the metric.
        id: &'static str,
        /// Why.
        reason: String,
    },
    /// There is a metric of this id.
    #[error("there is a metric `{id}` already")]
    Taken {
        /// Id given.
        id: &'static str,
    },
    /// No metric of this id.
    #[error("unknown metric `{id}`; known: {known}")]
    Unknown {
        /// Id given.
        id: String,
        /// All ids.
        known: String,
    },
}
