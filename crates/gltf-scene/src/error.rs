use std::path::PathBuf;

use noisefloor_scenes::SceneError;
use thiserror::Error;

/// Why a file cannot be loaded as a scene.
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
    /// A buffer, an accessor or a number in one is wrong.
    #[error("{what}: {problem}")]
    Data {
        /// Which part of the file.
        what: String,
        /// What is wrong and what is allowed.
        problem: String,
    },
    /// An image cannot be decoded.
    #[error("image {image}: {problem}")]
    Image {
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
    #[error("more than {most} triangles or vertices")]
    TooManyTriangles {
        /// The most that is accepted.
        most: usize,
    },
    /// The scene is read, but cannot be rendered.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl GltfError {
    pub(crate) fn data(what: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Data { what: what.into(), problem: problem.into() }
    }
}
