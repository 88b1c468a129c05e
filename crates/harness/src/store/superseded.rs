use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::error::HarnessError;
use crate::store::records::{Records, line_of};
use crate::store::write::append_lines;
use noisefloor_study::record::Record;

/// `results.superseded.jsonl`: records that the study, a method or the metrics of the moment have no use for. Nothing is
/// ever taken out of it, so that a study which goes back to what it was finds them.
#[derive(Debug)]
pub(crate) struct Superseded {
    path: PathBuf,
    all: Vec<Record>,
}

impl Superseded {
    /// Reads what was set aside; lines that cannot be read stay where they are.
    pub(crate) fn read(path: &Path) -> Result<Self, HarnessError> {
        Ok(Self { path: path.into(), all: Records::scan(path)?.records })
    }

    /// All of them, in the order in which they were set aside.
    pub(crate) fn all(&self) -> &[Record] {
        &self.all
    }

    /// Those of a cell, the last one set aside first.
    pub(crate) fn of_cell<'a>(&'a self, key: &'a str) -> impl Iterator<Item = &'a Record> {
        self.all.iter().rev().filter(move |record| record.cell == key)
    }

    /// Sets records aside; they are on disk when this returns. Those that are there already, because they were in use again
    /// or a process died before it had removed them from where they came from, are not written twice.
    pub(crate) fn add(&mut self, records: Vec<Record>) -> Result<(), HarnessError> {
        let mut known: BTreeMap<&str, Vec<&Record>> = BTreeMap::new();
        self.all.iter().for_each(|record| known.entry(&record.cell).or_default().push(record));
        let new: Vec<Record> = records
            .into_iter()
            .filter(|record| !known.get(record.cell.as_str()).is_some_and(|same| same.contains(&record)))
            .collect();
        if new.is_empty() {
            return Ok(());
        }
        let lines: Result<Vec<Vec<u8>>, _> = new.iter().map(|record| line_of(record, &self.path)).collect();
        append_lines(&self.path, lines?)?;
        self.all.extend(new);
        Ok(())
    }
}
