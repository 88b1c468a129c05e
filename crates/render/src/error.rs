use noisefloor_frame::FrameError;
use thiserror::Error;

/// Why nothing was rendered.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// Neither triangles nor spheres, or all triangles are degenerate.
    #[error("scene `{scene}` has nothing to hit ({dropped} degenerate triangles were dropped)")]
    EmptyScene {
        /// Scene id.
        scene: String,
        /// Triangles of zero area.
        dropped: usize,
    },
    /// A number or an index in the scene description has no meaning.
    #[error("scene `{scene}`: {what} is {value}, expected {expected}")]
    InvalidScene {
        /// Scene id.
        scene: String,
        /// The offending part, such as `mesh 2, triangle 17, vertex index`.
        what: String,
        /// What was found.
        value: String,
        /// What is allowed.
        expected: &'static str,
    },
    /// A parameter of the request is out of range.
    #[error("{parameter} is {value}, expected {expected}")]
    InvalidRequest {
        /// Name in [`crate::RenderRequest`].
        parameter: &'static str,
        /// What was asked for.
        value: String,
        /// What is allowed.
        expected: String,
    },
    /// The scene cannot give a quantity that the request records.
    #[error("scene `{scene}` cannot give `{quantity}`; it can give: {available}")]
    Unavailable {
        /// Scene id.
        scene: String,
        /// Name of the missing quantity.
        quantity: &'static str,
        /// Comma-separated names of what it can give.
        available: String,
    },
    /// An image that takes more memory than is allowed; found before anything is allocated.
    #[error(
        "{width}×{height} pixels with {planes} values each take about {bytes} bytes of memory, allowed are {allowed}; make \
         the image smaller, record less (--record), or raise the limit (--max-memory, or `max_memory` of the library)"
    )]
    Memory {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Values of 4 bytes that are kept of every pixel.
        planes: usize,
        /// Bytes that rendering and writing it take.
        bytes: u64,
        /// The most that is allowed.
        allowed: u64,
    },
    /// Most samples were infinite or not a number: light whose arithmetic leaves the range of `f32`.
    #[error(
        "scene `{scene}`: {non_finite} of {samples} samples are not finite: nothing of the image can be believed"
    )]
    NonFinite {
        /// Scene id.
        scene: String,
        /// Samples that are not finite.
        non_finite: u64,
        /// All samples.
        samples: u64,
    },
    /// The progress callback asked to stop.
    #[error("rendering was cancelled")]
    Cancelled,
    /// The buffers do not fit together.
    #[error(transparent)]
    Frame(#[from] FrameError),
}
