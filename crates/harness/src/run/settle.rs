//! Which cells are finished: from this folder's records, from those that were set aside, or not at all.

use std::collections::{BTreeMap, BTreeSet};

use crate::error::HarnessError;
use crate::observer::Observer;
use crate::plan::Plan;
use crate::run::claim::file_name;
use crate::run::request::StudyRun;
use crate::store::{Layout, Records, Superseded, whole};
use noisefloor_questions::measuring;
use noisefloor_study::Key;
use noisefloor_study::record::{Outcome, Record};

/// What stands before the first cell runs.
pub(super) struct Settled {
    /// Keys of the finished cells.
    pub(super) kept: BTreeSet<Key>,
    /// Who has which file.
    pub(super) owners: Owners,
}

/// The cells whose records name a kept image, by the image's path: a cell that would have the path of another one, which
/// has been set aside, takes a path of its own.
#[derive(Debug, Default)]
pub(super) struct Owners(BTreeMap<String, BTreeSet<Key>>);

impl Owners {
    fn add(&mut self, record: &Record) {
        for path in record.paths() {
            self.0.entry(path.to_owned()).or_default().insert(record.cell.clone());
        }
    }

    /// The path for a file of a cell: as wanted unless another cell's file is there, else with the first digits of the
    /// cell's key before the extension.
    pub(super) fn path(&self, wanted: String, key: &str) -> String {
        let taken = self.0.get(&wanted).is_some_and(|keys| keys.iter().any(|other| other != key));
        match wanted.rsplit_once('.').filter(|_| taken) {
            Some((stem, extension)) => format!("{stem}-{}.{extension}", key.get(..8).unwrap_or(key)),
            None => wanted,
        }
    }
}

/// Refuses names to run again that no row has.
pub(super) fn check_again(request: &StudyRun<'_>, plan: &Plan) -> Result<(), HarnessError> {
    let known = |name: &&String| plan.rows.iter().any(|row| row.is_named(std::slice::from_ref(name)));
    match request.again.iter().find(|name| !known(name)) {
        Some(name) => Err(HarnessError::NoRow {
            name: name.clone(),
            rows: plan.rows.iter().map(|row| row.label.clone()).collect(),
        }),
        None => Ok(()),
    }
}

/// Sets aside what the plan has no use for, brings back what it has again, and tells.
pub(super) fn settle(
    request: &StudyRun<'_>,
    layout: &Layout,
    plan: &Plan,
    records: &mut Records,
) -> Result<Settled, HarnessError> {
    let mut planned = BTreeSet::new();
    let mut again = BTreeSet::new();
    for cell in &plan.cells {
        if plan.row(cell).is_named(request.again) {
            again.insert(cell.key.clone());
        }
        planned.insert(cell.key.clone());
    }
    let mut told = Told::default();
    let (mut kept, mut keep, mut aside) = (BTreeSet::new(), Vec::new(), Vec::new());
    for record in records.all() {
        if !planned.contains(&record.cell) {
            told.stale += 1;
            aside.push(record.clone());
        } else if again.contains(&record.cell) {
            told.again += 1;
            aside.push(record.clone());
        } else if !measured_now(record) {
            told.stale += 1;
            aside.push(record.clone());
        } else if let Some(path) = first_damaged(record, layout) {
            told.damaged.push(path.to_owned());
            aside.push(record.clone());
        } else if settled(record) && kept.insert(record.cell.clone()) {
            keep.push(record.clone());
        } else {
            aside.push(record.clone());
        }
    }
    let mut superseded = Superseded::read(&layout.superseded())?;
    for key in planned.iter().filter(|key| !kept.contains(*key) && !again.contains(*key)) {
        let usable = |record: &&Record| {
            settled(record) && measured_now(record) && first_damaged(record, layout).is_none()
        };
        if let Some(record) = superseded.of_cell(key).find(usable) {
            told.restored += 1;
            keep.push(record.clone());
        }
    }
    kept.extend(keep.iter().map(|record| record.cell.clone()));
    // A failure is the answer of another moment, such as too little memory: tried again, and nothing is lost with it.
    aside.retain(settled);
    superseded.add(aside)?;
    records.replace(keep)?;
    told.tell(layout, request.observer);
    let mut owners = Owners::default();
    records.all().iter().chain(superseded.all()).for_each(|record| owners.add(record));
    Ok(Settled { kept, owners })
}

fn settled(record: &Record) -> bool {
    !matches!(record.outcome, Outcome::Failed { .. })
}

/// Whether the numbers are of the measuring of this program: those of a record can have been computed again by another.
fn measured_now(record: &Record) -> bool {
    record.measuring == measuring()
}

/// The first of a record's files that is not what was written.
fn first_damaged<'a>(record: &'a Record, layout: &Layout) -> Option<&'a str> {
    record.paths().find(|path| !whole(layout.root(), path, &record.files))
}

/// Damaged files that are named one by one.
const MOST_NAMED: usize = 8;

/// What happened to the records.
#[derive(Debug, Default)]
struct Told {
    stale: usize,
    again: usize,
    restored: usize,
    damaged: Vec<String>,
}

impl Told {
    fn tell(&self, layout: &Layout, observer: &dyn Observer) {
        let aside = file_name(&layout.superseded());
        if self.stale > 0 {
            observer.warning(&format!(
                "{} records are of another version of the study, a method or the metrics, and are set aside in {aside}",
                self.stale
            ));
        }
        if self.again > 0 {
            observer
                .warning(&format!("{} records are set aside in {aside}: their cells run again", self.again));
        }
        if self.restored > 0 {
            observer.warning(&format!("{} records that were set aside are in use again", self.restored));
        }
        for path in self.damaged.iter().take(MOST_NAMED) {
            observer.warning(&format!("{path} is not what was written or is gone; its cell runs again"));
        }
        if let Some(more) = self.damaged.len().checked_sub(MOST_NAMED + 1) {
            observer.warning(&format!("{} more images are like that", more + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_that_another_cell_has_is_not_given_away() {
        let mut owners = Owners::default();
        let key = |digit: &str| digit.repeat(32);
        owners.0.insert("images/a/spp00004-r0.exr".into(), BTreeSet::from([key("1")]));
        let path = |wanted: &str, digit: &str| owners.path(wanted.to_owned(), &key(digit));
        assert_eq!(path("images/a/spp00004-r0.exr", "1"), "images/a/spp00004-r0.exr");
        assert_eq!(path("images/a/spp00004-r0.exr", "2"), "images/a/spp00004-r0-22222222.exr");
        assert_eq!(path("images/a/spp00004-r1.exr", "2"), "images/a/spp00004-r1.exr");
    }
}
