//! Which rows of a level can be ranked, and over which replicates.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_study::record::{Outcome, Record};

/// The rows of one scene at one level.
#[derive(Debug, Default)]
pub(crate) struct Standing {
    /// Label to the reason why the row is not ranked.
    pub(crate) left_out: BTreeMap<String, String>,
    /// Replicates that all ranked rows have.
    pub(crate) common: BTreeSet<u32>,
}

impl Standing {
    /// From all records of the level.
    ///
    /// Frames differ, so means over different frames cannot be ranked. A row that was skipped or failed on a frame on
    /// which another ran, or whose output has values that are not finite (its errors are over fewer pixels then), is left out. Of the others a
    /// replicate counts where all of them have it: in a study that was stopped some have one more than others.
    pub(crate) fn of(records: &[&Record]) -> Self {
        let mut rows: BTreeMap<&str, Vec<&Record>> = BTreeMap::new();
        for record in records {
            rows.entry(&record.label).or_default().push(record);
        }
        // Most pixels that a row's errors are over, by replicate; invalid pixels of the input are missing in all rows alike.
        let mut most: BTreeMap<u32, u64> = BTreeMap::new();
        for record in records {
            let most = most.entry(record.replicate).or_default();
            *most = record.pixels.max(*most);
        }
        // A frame on which no row ran is missing in all rows alike.
        let used: BTreeSet<u32> = rows.values().flat_map(|records| replicates(records)).collect();
        let mut out = Self::default();
        let mut common: Option<BTreeSet<u32>> = None;
        let mut ranked = Vec::new();
        for (label, records) in rows {
            let done = replicates(&records);
            if let Some(reason) = why_left_out(&records, &most, &used) {
                out.left_out.insert(label.to_owned(), reason);
            } else if !done.is_empty() {
                common = Some(match common {
                    Some(common) => common.intersection(&done).copied().collect(),
                    None => done,
                });
                ranked.push(label);
            }
        }
        out.common = common.unwrap_or_default();
        if out.common.is_empty() {
            let reason = "no replicate has all rows, and different replicates cannot be compared";
            out.left_out.extend(ranked.into_iter().map(|label| (label.to_owned(), reason.to_owned())));
        }
        out
    }
}

fn replicates(records: &[&Record]) -> BTreeSet<u32> {
    records.iter().filter(|r| r.outcome == Outcome::Done).map(|r| r.replicate).collect()
}

fn why_left_out(records: &[&Record], most: &BTreeMap<u32, u64>, used: &BTreeSet<u32>) -> Option<String> {
    let done = replicates(records).len();
    if done == 0 {
        // It has no numbers; the list of rows that did not run says why.
        return None;
    }
    let ended = |record: &&Record| match &record.outcome {
        Outcome::Done => None,
        Outcome::Skipped { reason } => Some(("skipped", reason.clone())),
        Outcome::Failed { reason } => Some(("failed", reason.clone())),
    };
    let on_used = || records.iter().filter(|record| used.contains(&record.replicate));
    if let Some((word, reason)) = on_used().find_map(ended) {
        let all: BTreeSet<u32> = on_used().map(|r| r.replicate).collect();
        return Some(format!("ran on {done} of {} replicates, {word} on the others ({reason})", all.len()));
    }
    // Records of earlier programs do not say over how many pixels they are.
    let fewer = |record: &&&Record| match record.pixels {
        0 => record.non_finite.output_values > 0,
        pixels => pixels < most.get(&record.replicate).copied().unwrap_or(0),
    };
    let lost: usize = records.iter().filter(fewer).map(|r| r.non_finite.output_values).sum();
    records.iter().any(|record| fewer(&record)).then(|| {
        let are = if lost == 1 { "value is no number" } else { "values are no numbers" };
        format!("{lost} output {are}: its errors are over fewer pixels")
    })
}
