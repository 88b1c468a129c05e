use std::fmt;
use std::path::PathBuf;

use noisefloor_scenes::UnknownScene;
use thiserror::Error;

/// Why a study could not be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// A study file that is no valid TOML, or has an unknown or missing field.
    #[error("{place}: {message}")]
    Syntax {
        /// File and line.
        place: Place,
        /// The parser's message, with the offending line.
        message: String,
    },
    /// A field of a study has a value without meaning.
    #[error("{place}: {field} is {value}; allowed: {allowed}")]
    Field {
        /// File and line.
        place: Place,
        /// Field, such as `scene[1].spp`.
        field: String,
        /// Value found.
        value: String,
        /// Allowed values.
        allowed: String,
    },
    /// No built-in study has this name and no such file or folder exists.
    #[error("there is no study, file or folder `{name}`; the nearest studies are {}", nearest.join(", "))]
    UnknownStudy {
        /// Name given.
        name: String,
        /// The closest names that exist.
        nearest: Vec<String>,
    },
    /// A study names a scene that does not exist.
    #[error("{place}: {source}")]
    Scene {
        /// File and line.
        place: Place,
        /// Which name, and the nearest ones.
        source: UnknownScene,
    },
    /// The file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
}

/// File and line of a message.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Place {
    /// File, or the name of a built-in study.
    pub file: String,
    /// Line from 1, if known.
    pub line: Option<usize>,
}

impl Place {
    /// A study that is known by its name.
    #[must_use]
    pub fn of_study(name: &str, line: Option<usize>) -> Self {
        Self { file: format!("study `{name}`"), line }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}, line {line}", self.file),
            None => f.write_str(&self.file),
        }
    }
}
