//! A study's folder: records, images, and what an analysis needs to work from them alone.

mod records;

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

use serde::{Serialize, de::DeserializeOwned};

use crate::error::HarnessError;

pub(crate) use records::Records;

/// Paths inside a study's folder.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    root: PathBuf,
}

impl Layout {
    pub(crate) fn new(root: &Path) -> Self {
        Self { root: root.to_owned() }
    }

    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Finished cells, one JSON object per line.
    pub(crate) fn records(&self) -> PathBuf {
        self.root.join("results.jsonl")
    }

    /// The study as it was resolved.
    pub(crate) fn study(&self) -> PathBuf {
        self.root.join("study.json")
    }

    /// Rows and machine, as the analysis needs them.
    pub(crate) fn context(&self) -> PathBuf {
        self.root.join("context.json")
    }

    /// The analysis.
    pub(crate) fn summary(&self) -> PathBuf {
        self.root.join("summary.json")
    }

    /// The reference of a scene, relative.
    pub(crate) fn reference(scene: &str) -> String {
        format!("reference/{scene}.exr")
    }

    /// Description of a scene, relative.
    pub(crate) fn scene(scene: &str) -> String {
        format!("reference/{scene}.json")
    }

    /// Pixel classes of a scene, relative.
    pub(crate) fn classes(scene: &str) -> String {
        format!("reference/{scene}.classes.exr")
    }

    /// A denoised image, relative.
    pub(crate) fn image(scene: &str, slug: &str, spp: u32, replicate: u32) -> String {
        format!("images/{scene}/{slug}/spp{spp:05}-r{replicate}.exr")
    }

    /// A diagnostic image, relative.
    pub(crate) fn diagnostic(scene: &str, slug: &str, spp: u32, replicate: u32, name: &str) -> String {
        format!("diagnostics/{scene}/{slug}/spp{spp:05}-r{replicate}-{name}.exr")
    }

    /// Absolute path of a relative one, its folder made if need be.
    pub(crate) fn ready(&self, relative: &str) -> Result<PathBuf, HarnessError> {
        let path = self.root.join(relative);
        let folder = path.parent().unwrap_or(&self.root);
        std::fs::create_dir_all(folder).map_err(HarnessError::io("make folder", folder))?;
        Ok(path)
    }
}

/// Keeps other processes out of a study's folder until it is dropped, or the process dies.
#[derive(Debug)]
pub(crate) struct Lock {
    _file: File,
}

impl Lock {
    pub(crate) fn take(layout: &Layout) -> Result<Self, HarnessError> {
        let root = layout.root();
        std::fs::create_dir_all(root).map_err(HarnessError::io("make folder", root))?;
        let path = root.join(".lock");
        let file = File::create(&path).map_err(HarnessError::io("write", &path))?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(HarnessError::Locked { path: root.to_owned() }),
            Err(TryLockError::Error(source)) => Err(HarnessError::Io { action: "lock", path, source }),
        }
    }
}

/// Writes a file so that it appears whole or not at all, and is on disk when this returns.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), HarnessError> {
    Ok(noisefloor_io::write_atomically(path, |file| file.write_all(bytes))?)
}

/// Writes pretty JSON whole.
pub(crate) fn write_json(path: &Path, value: &impl Serialize) -> Result<(), HarnessError> {
    let mut text = serde_json::to_vec_pretty(value).map_err(|e| HarnessError::Kept {
        path: path.into(),
        line: None,
        message: e.to_string(),
    })?;
    text.push(b'\n');
    write_whole(path, &text)
}

/// Reads JSON.
pub(crate) fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, HarnessError> {
    let text = std::fs::read(path).map_err(HarnessError::io("read", path))?;
    serde_json::from_slice(&text).map_err(|e| HarnessError::Kept {
        path: path.into(),
        line: Some(e.line()),
        message: e.to_string(),
    })
}
