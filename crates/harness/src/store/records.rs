use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::error::HarnessError;
use crate::record::{RECORD_SCHEMA, Record};
use crate::store::write_whole;

/// `results.jsonl`: whole lines, appended and brought to disk one by one.
#[derive(Debug)]
pub(crate) struct Records {
    path: PathBuf,
    file: File,
    all: Vec<Record>,
}

/// What was found in a file of records.
#[derive(Debug)]
pub(crate) struct Found {
    pub(crate) records: Vec<Record>,
    /// Bytes of whole lines; what follows is the torn end of a line whose process died.
    whole: u64,
    torn: bool,
}

impl Records {
    /// Opens or begins a file, cutting off a torn last line.
    pub(crate) fn open(path: &Path) -> Result<Self, HarnessError> {
        let found = Self::read(path)?;
        let file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(path)
            .map_err(HarnessError::io("write", path))?;
        if found.torn {
            file.set_len(found.whole).map_err(HarnessError::io("write", path))?;
        }
        Ok(Self { path: path.into(), file, all: found.records })
    }

    /// Reads without changing anything. A missing file has no records.
    pub(crate) fn read(path: &Path) -> Result<Found, HarnessError> {
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => Vec::new(),
            Err(e) => return Err(HarnessError::io("read", path)(e)),
        };
        let whole = bytes.iter().rposition(|&b| b == b'\n').map_or(0, |last| last + 1);
        let mut records = Vec::new();
        for (index, line) in bytes[..whole].split(|&b| b == b'\n').enumerate() {
            if line.iter().all(u8::is_ascii_whitespace) {
                continue;
            }
            let broken =
                |message: String| HarnessError::Kept { path: path.into(), line: Some(index + 1), message };
            let record: Record = serde_json::from_slice(line).map_err(|e| broken(e.to_string()))?;
            if record.schema > RECORD_SCHEMA {
                return Err(broken(format!(
                    "written by a newer program (record schema {}, this one knows {RECORD_SCHEMA})",
                    record.schema
                )));
            }
            records.push(record);
        }
        Ok(Found { records, whole: whole as u64, torn: whole < bytes.len() })
    }

    /// All records in file order.
    pub(crate) fn all(&self) -> &[Record] {
        &self.all
    }

    /// Appends a record; it is on disk when this returns.
    pub(crate) fn append(&mut self, record: Record) -> Result<(), HarnessError> {
        let mut line = line_of(&record, &self.path)?;
        line.push(b'\n');
        // One call for the whole line, so that only the death of the machine or a full disk can tear it.
        self.file.write_all(&line).map_err(HarnessError::io("write", &self.path))?;
        self.file.sync_data().map_err(HarnessError::io("write", &self.path))?;
        self.all.push(record);
        Ok(())
    }

    /// Replaces the whole file, if the records differ from what is there.
    pub(crate) fn replace(&mut self, records: Vec<Record>) -> Result<(), HarnessError> {
        if records == self.all {
            return Ok(());
        }
        let mut bytes = Vec::new();
        for record in &records {
            bytes.extend(line_of(record, &self.path)?);
            bytes.push(b'\n');
        }
        write_whole(&self.path, &bytes)?;
        self.file = OpenOptions::new()
            .append(true)
            .open(&self.path)
            .map_err(HarnessError::io("write", &self.path))?;
        self.all = records;
        Ok(())
    }
}

fn line_of(record: &Record, path: &Path) -> Result<Vec<u8>, HarnessError> {
    serde_json::to_vec(record).map_err(|e| HarnessError::Kept {
        path: path.into(),
        line: None,
        message: e.to_string(),
    })
}
