use std::path::{Path, PathBuf};

use noisefloor_scenes::SceneError;
use thiserror::Error;

/// Why a file cannot be loaded as a scene. Every message names the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GltfError {
    /// A file cannot be read.
    #[error("cannot read {}", path.display())]
    Io {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Not glTF 2.0, or not valid.
    #[error("{} is not valid glTF 2.0", path.display())]
    Syntax {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: gltf::Error,
    },
    /// A part of the file refers to something that is not there, or a number in it is wrong.
    #[error("{}: {what}: {problem}", path.display())]
    Data {
        /// Which file.
        path: PathBuf,
        /// Which part of the file.
        what: String,
        /// What is wrong and what is allowed.
        problem: String,
    },
    /// An image cannot be decoded.
    #[error("{}: image {image}: {problem}", path.display())]
    Image {
        /// Which file.
        path: PathBuf,
        /// Index of the image.
        image: usize,
        /// What is wrong.
        problem: String,
    },
    /// Nothing to see.
    #[error("{} has no triangle with an area", path.display())]
    NoTriangles {
        /// Which file.
        path: PathBuf,
    },
    /// More triangles or vertices than are accepted once instances are expanded.
    #[error("{}: more than {most} triangles or vertices", path.display())]
    TooManyTriangles {
        /// Which file.
        path: PathBuf,
        /// The most that is accepted.
        most: usize,
    },
    /// The scene is read, but cannot be rendered.
    #[error("{} cannot be rendered", path.display())]
    Scene {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: SceneError,
    },
}

impl GltfError {
    /// About a part of the file, whose name [`GltfError::of`] adds.
    pub(crate) fn data(what: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Data { path: PathBuf::new(), what: what.into(), problem: problem.into() }
    }

    pub(crate) fn image(image: usize, problem: impl Into<String>) -> Self {
        Self::Image { path: PathBuf::new(), image, problem: problem.into() }
    }

    /// Adds the file's name where the place of the fault did not know it.
    pub(crate) fn of(mut self, file: &Path) -> Self {
        match &mut self {
            Self::Data { path, .. }
            | Self::Image { path, .. }
            | Self::TooManyTriangles { path, .. }
            | Self::Scene { path, .. }
                if path.as_os_str().is_empty() =>
            {
                *path = file.to_owned();
            }
            _ => {}
        }
        self
    }
}
