use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::error::HarnessError;
use crate::store::write::{append_lines, write_whole};
use noisefloor_study::record::{RECORD_SCHEMA, Record};

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
    /// Whole lines that are no records.
    pub(crate) damaged: Vec<Damaged>,
    /// Whole lines that a newer program wrote: line from 1, and the schema it has.
    newer: Option<(usize, u32)>,
    /// Bytes of whole lines; what follows is the torn end of a line whose process died, or is being written.
    whole: u64,
    torn: bool,
}

impl Found {
    /// The records of a file that nobody can mend: every line must be one.
    pub(crate) fn whole_or_error(self, path: &Path) -> Result<Vec<Record>, HarnessError> {
        let newer = self
            .newer
            .map(|(line, schema)| (line, format!("a newer program wrote it (record schema {schema})")));
        let first = self.damaged.first().map(|damaged| (damaged.line, damaged.why.clone())).or(newer);
        match first {
            Some((line, message)) => Err(HarnessError::Kept { path: path.into(), line: Some(line), message }),
            None => Ok(self.records),
        }
    }
}

/// A line that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Damaged {
    /// From 1.
    pub(crate) line: usize,
    bytes: Vec<u8>,
    /// The parser's message.
    pub(crate) why: String,
}

/// As much of a record as every program that writes one agrees on.
#[derive(serde::Deserialize)]
struct AnyRecord {
    schema: u32,
}

impl Records {
    /// Opens or begins a file. A torn last line is cut off; other lines that cannot be read are moved into the file
    /// `aside`, and told.
    pub(crate) fn open(path: &Path, aside: &Path) -> Result<(Self, Vec<Damaged>), HarnessError> {
        let found = Self::read(path)?;
        // Set aside before they are removed.
        if !found.damaged.is_empty() {
            append_lines(aside, found.damaged.iter().map(|damaged| damaged.bytes.clone()))?;
        }
        let file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(path)
            .map_err(HarnessError::io("write", path))?;
        if found.torn {
            file.set_len(found.whole).map_err(HarnessError::io("write", path))?;
        }
        let mut records = Self { path: path.into(), file, all: found.records };
        if !found.damaged.is_empty() {
            records.rewrite()?;
        }
        Ok((records, found.damaged))
    }

    /// Reads without changing anything, also while another process appends. A missing file has no records.
    ///
    /// # Errors
    /// [`HarnessError::Kept`] for records of a newer program.
    pub(crate) fn read(path: &Path) -> Result<Found, HarnessError> {
        let found = Self::scan(path)?;
        match found.newer {
            Some((line, schema)) => Err(HarnessError::Kept {
                path: path.into(),
                line: Some(line),
                message: format!(
                    "written by a newer program (record schema {schema}, this one knows {RECORD_SCHEMA})"
                ),
            }),
            None => Ok(found),
        }
    }

    /// Like [`Records::read`], with the records of a newer program left out.
    pub(crate) fn scan(path: &Path) -> Result<Found, HarnessError> {
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => Vec::new(),
            Err(e) => return Err(HarnessError::io("read", path)(e)),
        };
        Ok(Self::parse(&bytes))
    }

    /// Reads records from the text of a file.
    pub(crate) fn parse(bytes: &[u8]) -> Found {
        let whole = bytes.iter().rposition(|&b| b == b'\n').map_or(0, |last| last + 1);
        let mut found = Found {
            records: Vec::new(),
            damaged: Vec::new(),
            newer: None,
            whole: whole as u64,
            torn: whole < bytes.len(),
        };
        for (index, line) in bytes[..whole].split(|&b| b == b'\n').enumerate() {
            if line.iter().all(u8::is_ascii_whitespace) {
                continue;
            }
            match serde_json::from_slice::<AnyRecord>(line) {
                Ok(any) if any.schema > RECORD_SCHEMA => {
                    found.newer.get_or_insert((index + 1, any.schema));
                    continue;
                }
                _ => {}
            }
            match serde_json::from_slice(line) {
                Ok(record) => found.records.push(record),
                Err(error) => found.damaged.push(Damaged {
                    line: index + 1,
                    bytes: line.to_vec(),
                    why: error.to_string(),
                }),
            }
        }
        found
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
        self.all = records;
        self.rewrite()
    }

    fn rewrite(&mut self) -> Result<(), HarnessError> {
        let mut bytes = Vec::new();
        for record in &self.all {
            bytes.extend(line_of(record, &self.path)?);
            bytes.push(b'\n');
        }
        write_whole(&self.path, &bytes)?;
        self.file = OpenOptions::new()
            .append(true)
            .open(&self.path)
            .map_err(HarnessError::io("write", &self.path))?;
        Ok(())
    }
}

pub(super) fn line_of(record: &Record, path: &Path) -> Result<Vec<u8>, HarnessError> {
    serde_json::to_vec(record).map_err(|e| HarnessError::Kept {
        path: path.into(),
        line: None,
        message: e.to_string(),
    })
}
