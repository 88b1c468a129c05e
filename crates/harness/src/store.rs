//! A study's folder: records, images, and what an analysis needs to work from them alone.

mod kept;
mod records;
mod superseded;
mod sweep;

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Serialize, de::DeserializeOwned};

use crate::error::HarnessError;

pub(crate) use kept::{FolderImages, damaged, hash_of, whole};
pub(crate) use records::Records;
pub(crate) use superseded::Superseded;
pub(crate) use sweep::sweep;

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

    /// Records that an earlier version of the study, a method or the metrics made, one JSON object per line.
    pub(crate) fn superseded(&self) -> PathBuf {
        self.root.join("results.superseded.jsonl")
    }

    /// Lines of the records that could not be read.
    pub(crate) fn damaged(&self) -> PathBuf {
        self.root.join("results.damaged.jsonl")
    }

    /// The same in a recorded study, compressed.
    pub(crate) fn packed_records(&self) -> PathBuf {
        self.root.join("results.jsonl.gz")
    }

    /// The study as it was resolved.
    pub(crate) fn study(&self) -> PathBuf {
        self.root.join("study.json")
    }

    /// Rows and machine, as the analysis needs them.
    pub(crate) fn context(&self) -> PathBuf {
        self.root.join("context.json")
    }

    /// Everything that a run means to do, one JSON object per line.
    pub(crate) fn plan(&self) -> PathBuf {
        self.root.join("plan.jsonl")
    }

    /// The analysis.
    pub(crate) fn summary(&self) -> PathBuf {
        self.root.join("summary.json")
    }

    /// Removes what killed processes left half written in the folders of a study, and nothing in others that stand beside
    /// them; for whoever holds the lock.
    pub(crate) fn sweep(&self) {
        let folders =
            [("", 0), ("reference", 0), ("images", 2), ("diagnostics", 2), ("logs", 2), ("report", 1)];
        for (folder, depth) in folders {
            sweep(&self.root.join(folder), depth, Duration::ZERO);
        }
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
        // Not emptied: the name may be a link to a file that is none of ours.
        let file = OpenOptions::new().create(true).write(true).truncate(false).open(&path);
        let file = file.map_err(HarnessError::io("write", &path))?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(HarnessError::Locked { path: root.to_owned() }),
            Err(TryLockError::Error(source)) => Err(HarnessError::Io { action: "lock", path, source }),
        }
    }
}

/// Appends whole lines; they are on disk when this returns. A torn line at the end of the file stays a line of its own.
fn append_lines(path: &Path, lines: impl IntoIterator<Item = Vec<u8>>) -> Result<(), HarnessError> {
    let wrong = || HarnessError::io("write", path);
    let mut file = OpenOptions::new()
        .create(true)
        .read(true)
        .append(true)
        .open(path)
        .map_err(HarnessError::io("write", path))?;
    let mut bytes = Vec::new();
    if file.seek(SeekFrom::End(0)).map_err(wrong())? > 0 {
        let mut last = [0];
        file.seek(SeekFrom::End(-1)).map_err(wrong())?;
        file.read_exact(&mut last).map_err(wrong())?;
        if last != *b"\n" {
            bytes.push(b'\n');
        }
    }
    for line in lines {
        bytes.extend(line);
        bytes.push(b'\n');
    }
    file.write_all(&bytes).map_err(wrong())?;
    file.sync_all().map_err(wrong())?;
    // The folder's entry, too, where the platform can: what comes next removes the only other copy.
    if let Some(folder) = path.parent().and_then(|folder| File::open(folder).ok()) {
        let _ = folder.sync_all();
    }
    Ok(())
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

/// Writes one JSON object per line, whole.
pub(crate) fn write_json_lines(path: &Path, values: &[impl Serialize]) -> Result<(), HarnessError> {
    let mut text = Vec::new();
    for value in values {
        serde_json::to_writer(&mut text, value).map_err(|e| HarnessError::kept(path, e))?;
        text.push(b'\n');
    }
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
