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
    /// The progress callback asked to stop.
    #[error("rendering was cancelled")]
    Cancelled,
    /// The buffers do not fit together.
    #[error(transparent)]
    Frame(#[from] FrameError),
}
