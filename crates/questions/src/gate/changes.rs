//! Errors of the old and the new version, cell by cell.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_stats::Change;
use noisefloor_study::record::{Outcome, Record};
use serde::Serialize;

use crate::gate::version::Version;
use crate::records::{by_replicate, reference_share};

/// A cell that ran in the old version and has no number, or less of an image, in the new one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Broken {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Label of the row.
    pub label: String,
    /// Why.
    pub reason: String,
}

/// A row on a scene at a level.
pub(super) struct Cell {
    pub(super) scene: String,
    pub(super) spp: u32,
    pub(super) label: String,
    pub(super) change: Change,
}

/// All that changed or may have.
pub(super) struct Changes {
    /// Labels of the rows, by the numbers that changes name them with.
    pub(super) labels: Vec<String>,
    pub(super) cells: Vec<Cell>,
    pub(super) broken: Vec<Broken>,
    /// Cells that ran in the old version and were left out, and cells that the old version did not run and the new one does.
    pub(super) notes: Vec<String>,
}

/// The cells that ran in the old version; `new` has all of them.
pub(super) fn changes(old: Version<'_>, new: Version<'_>, metric: &str) -> Changes {
    let mut out = Changes { labels: Vec::new(), cells: Vec::new(), broken: Vec::new(), notes: Vec::new() };
    let mut truths: Vec<&str> = Vec::new();
    let mut seen = BTreeSet::new();
    for first in old.records {
        let key = (first.scene.as_str(), first.spp, first.label.as_str());
        if !seen.insert(key) {
            continue;
        }
        let [before, after] = [of(old, key), of(new, key)];
        let (pairs, broken, more) = pairs(&before, &after, metric);
        let name = || (first.scene.clone(), first.spp, first.label.clone());
        out.broken.extend(broken.map(|reason| {
            let (scene, spp, label) = name();
            Broken { scene, spp, label, reason }
        }));
        if more > 0 {
            out.notes.push(format!(
                "{} on {} at {} spp: {more} replicates that the old version did not run, or ran over fewer pixels, are not \
                 compared",
                first.label, first.scene, first.spp
            ));
        }
        if pairs.is_empty() {
            continue;
        }
        let (a, b): (Vec<&Record>, Vec<&Record>) = pairs.into_iter().unzip();
        let (scene, spp, label) = name();
        let change = Change {
            row: number(&mut out.labels, label.clone()),
            truth: number(&mut truths, first.scene.as_str()),
            old: by_replicate(&a, None, metric),
            new: by_replicate(&b, None, metric),
            reference: [reference_share(&a, None, metric), reference_share(&b, None, metric)],
        };
        out.cells.push(Cell { scene, spp, label, change });
    }
    out
}

/// The place of a thing in a list, which it is appended to if need be.
fn number<T: PartialEq>(list: &mut Vec<T>, thing: T) -> usize {
    list.iter().position(|known| *known == thing).unwrap_or_else(|| {
        list.push(thing);
        list.len() - 1
    })
}

fn of<'a>(version: Version<'a>, (scene, spp, label): (&str, u32, &str)) -> BTreeMap<u32, &'a Record> {
    let mine = |r: &&Record| r.scene == scene && r.spp == spp && r.label == label;
    version.records.iter().filter(mine).map(|r| (r.replicate, r)).collect()
}

/// Replicates that both have; why the new version is broken, if it is; and how many others there are.
fn pairs<'a>(
    old: &BTreeMap<u32, &'a Record>,
    new: &BTreeMap<u32, &'a Record>,
    metric: &str,
) -> (Vec<(&'a Record, &'a Record)>, Option<String>, usize) {
    let has = |record: &Record, metric: &str| record.metrics.get(metric).is_some_and(Option::is_some);
    let (mut pairs, mut broken, mut more) = (Vec::new(), None, 0);
    for (replicate, after) in new {
        let before = old.get(replicate).filter(|before| before.outcome == Outcome::Done);
        match (before, &after.outcome) {
            // Errors over other pixels are another number.
            (Some(before), Outcome::Done) if before.pixels > after.pixels => {
                let lost = before.pixels - after.pixels;
                broken
                    .get_or_insert_with(|| format!("output is no number at {lost} pixels where it was one"));
            }
            (Some(before), Outcome::Done) if before.pixels < after.pixels => more += 1,
            (Some(before), Outcome::Done) if has(before, metric) && !has(after, metric) => {
                broken.get_or_insert_with(|| format!("has no {metric} where it had one"));
            }
            (Some(before), Outcome::Done) => pairs.push((*before, *after)),
            (Some(_), Outcome::Skipped { reason }) => {
                broken.get_or_insert_with(|| format!("does not run any more: {reason}"));
            }
            (Some(_), Outcome::Failed { reason }) => {
                broken.get_or_insert_with(|| format!("fails: {reason}"));
            }
            (None, Outcome::Done) => more += 1,
            (None, _) => {}
        }
    }
    (pairs, broken, more)
}
