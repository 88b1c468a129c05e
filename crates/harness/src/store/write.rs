//! Files that appear whole, and lines that are on disk when they are said to be.

use std::fs::{File, OpenOptions};
use std::io::{Read as _, Seek as _, SeekFrom, Write as _};
use std::path::Path;

use serde::{Serialize, de::DeserializeOwned};

use crate::error::HarnessError;

/// Appends whole lines; they are on disk when this returns. A torn line at the end of the file stays a line of its own.
pub(crate) fn append_lines(
    path: &Path,
    lines: impl IntoIterator<Item = Vec<u8>>,
) -> Result<(), HarnessError> {
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
