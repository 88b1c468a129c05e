use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a report could not be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A folder could not be made or listed, or an old plot not removed.
    #[error("cannot prepare {}: {source}", path.display())]
    Write {
        /// The folder or file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file of the report could not be written.
    #[error(transparent)]
    Io(#[from] noisefloor_io::IoError),
    /// A marker of a README cannot be obeyed.
    #[error("README.md, line {line}: {message}")]
    Readme {
        /// Line from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A README cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The page's template failed.
    #[error("cannot fill the page's template: {0}")]
    Template(#[from] minijinja::Error),
    /// A plot could not be drawn.
    #[error("cannot draw the plot {name}: {message}")]
    Plot {
        /// File name of the plot, without extension.
        name: String,
        /// What the drawing backend said.
        message: String,
    },
    /// A plot could not be encoded as PNG.
    #[error("cannot encode {name}.png: {source}")]
    Png {
        /// File name of the plot, without extension.
        name: String,
        /// What the encoder said.
        source: png::EncodingError,
    },
    /// A table could not be written as JSON.
    #[error("cannot write {name}.json: {source}")]
    Table {
        /// File name of the table, without extension.
        name: String,
        /// What the encoder said.
        source: serde_json::Error,
    },
    /// The viewer's table of contents could not be written as JSON.
    #[error("cannot describe the viewer's images: {0}")]
    Manifest(#[from] serde_json::Error),
}

impl ReportError {
    /// Attaches a path to an input/output error.
    pub(crate) fn write(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::Write { path: path.to_owned(), source }
    }
}
