use std::path::PathBuf;

use noisefloor_denoiser::BuildError;
use noisefloor_render::RenderError;
use noisefloor_study::{Place, StudyError};
use thiserror::Error;

/// Why a study could not be read, planned, run or analysed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum HarnessError {
    /// A study that is none.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A glTF file of a study cannot be loaded.
    #[error(transparent)]
    Gltf(#[from] noisefloor_gltf::GltfError),
    /// A row names a method or parameter that does not exist.
    #[error("{place}: row `{label}`: {source}")]
    Method {
        /// File and line.
        place: Place,
        /// Label of the row.
        label: String,
        /// What is wrong, with the nearest names.
        source: Box<BuildError>,
    },
    /// No row of the study has this label or method.
    #[error("no row is or runs `{name}`; the rows are {}", rows.join(", "))]
    NoRow {
        /// Name given.
        name: String,
        /// Labels of the rows.
        rows: Vec<String>,
    },
    /// The images of a scene take more memory than is allowed; found before any work.
    #[error(
        "scene `{scene}`: frame and reference of {width}×{height} pixels take about {bytes} bytes of memory, allowed are \
         {allowed}; make the images smaller (`width`, `height`, --size), or raise the limit (--max-memory)"
    )]
    Memory {
        /// Scene id.
        scene: String,
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Bytes that they take.
        bytes: u64,
        /// The most that is allowed.
        allowed: u64,
    },
    /// A folder of frames cannot be used as a scene.
    #[error("{}: {reason}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// Two files that must be independent were made from the same random numbers.
    #[error(
        "{} and {} name the same scene, renderer, sampler and random seed {seed}: they share samples, and errors against each \
         other mean nothing; render one of them with another seed",
        first.display(),
        second.display()
    )]
    SharedSeed {
        /// One file.
        first: PathBuf,
        /// The other.
        second: PathBuf,
        /// Their seed.
        seed: u64,
    },
    /// The operating system refused something: no space, no permission, no such file.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// What was tried, such as `write`.
        action: &'static str,
        /// File or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// An image file could not be read or written.
    #[error(transparent)]
    Image(#[from] noisefloor_io::IoError),
    /// A frame could not be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// An image class of a kept file has no name.
    #[error("{}: {source}", path.display())]
    Classes {
        /// The file.
        path: PathBuf,
        /// Which class.
        source: noisefloor_questions::UnknownClass,
    },
    /// Buffers do not fit together.
    #[error("scene `{scene}`: {source}")]
    Frame {
        /// Scene id.
        scene: String,
        /// Which buffer.
        source: Box<noisefloor_frame::FrameError>,
    },
    /// A frame contradicts itself or has no image in it; its cells fail, the study goes on.
    #[error("{frame}: {source}")]
    Unsound {
        /// Scene, and file or level and replicate.
        frame: String,
        /// What is wrong.
        source: Box<noisefloor_frame::FrameError>,
    },
    /// A reference or its classes cannot be measured against.
    #[error("scene `{scene}`: {source}")]
    Metric {
        /// Scene id.
        scene: String,
        /// What does not fit.
        source: noisefloor_metrics::MetricError,
    },
    /// An output does not fit the frame it was made from.
    #[error("scene `{scene}`: {source}")]
    Shape {
        /// Scene id.
        scene: String,
        /// What does not fit.
        source: noisefloor_stats::ShapeError,
    },
    /// A method could not say where samples are needed.
    #[error("row `{label}`: no sampling density: {reason}")]
    Density {
        /// Label of the row.
        label: String,
        /// Why.
        reason: String,
    },
    /// The study's folder is in use by another process.
    #[error("{} is in use by another noisefloor process", path.display())]
    Locked {
        /// The folder.
        path: PathBuf,
    },
    /// The study's folder has results of another study.
    #[error("{} holds results of study `{found}`, not of `{wanted}`; choose another output folder", path.display())]
    OtherStudy {
        /// The folder.
        path: PathBuf,
        /// Study found there.
        found: String,
        /// Study to be run.
        wanted: String,
    },
    /// A kept file of a study's folder cannot be understood.
    #[error("{}{}: {message}", path.display(), line.map(|l| format!(", line {l}")).unwrap_or_default())]
    Kept {
        /// The file.
        path: PathBuf,
        /// Line from 1, where it has lines.
        line: Option<usize>,
        /// What is wrong.
        message: String,
    },
    /// A folder is neither that of a study nor a recorded one.
    #[error("{} has no {missing}: {hint}", path.display())]
    NotAStudy {
        /// The folder.
        path: PathBuf,
        /// File that it would have.
        missing: String,
        /// What it may be instead, and what to do.
        hint: String,
    },
    /// The observer asked to stop. Everything finished is kept.
    #[error("stopped; finished cells are kept, run the same command again to continue")]
    Cancelled,
}

impl HarnessError {
    /// For `map_err`: names the action and the path.
    pub(crate) fn io(action: &'static str, path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Self::Io { action, path, source }
    }

    /// A kept file that cannot be understood or written.
    pub(crate) fn kept(path: &std::path::Path, message: impl ToString) -> Self {
        Self::Kept { path: path.into(), line: None, message: message.to_string() }
    }

    /// Whether nothing is wrong but the observer's wish to stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Self::Cancelled | Self::Render(RenderError::Cancelled))
    }
}
