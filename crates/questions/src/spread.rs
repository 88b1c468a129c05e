//! How much ratios of errors differ between replicates: what decides how many of them a study needs.

use std::collections::BTreeMap;

use noisefloor_stats::log_ratio_spread;
use noisefloor_study::record::{Outcome, Record};
use serde::Serialize;

use crate::records::{by_replicate, median};

/// Standard deviations over replicates of the logarithm of the ratio of two rows' errors, on one scene at one level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Spread {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Pairs of rows with two replicates or more.
    pub pairs: usize,
    /// Most replicates of a row.
    pub replicates: u32,
    /// Median over the pairs.
    pub median: f64,
    /// Value that a tenth of the pairs exceed.
    pub tenth: f64,
}

/// Records by label.
type Rows<'a> = BTreeMap<&'a str, Vec<&'a Record>>;

/// By scene and level, in the order of the records; levels without two replicates of two rows are absent. Rows whose numbers
/// are the same are no pair.
#[must_use]
pub fn spreads(records: &[Record], metric: &str) -> Vec<Spread> {
    let mut levels: Vec<(&str, u32, Rows<'_>)> = Vec::new();
    for record in records.iter().filter(|record| record.outcome == Outcome::Done) {
        let same =
            |(scene, spp, _): &&mut (&str, u32, _)| (*scene, *spp) == (record.scene.as_str(), record.spp);
        match levels.iter_mut().find(same) {
            Some((.., rows)) => rows.entry(&record.label).or_default().push(record),
            None => {
                levels.push((&record.scene, record.spp, BTreeMap::from([(&*record.label, vec![record])])))
            }
        }
    }
    levels.into_iter().filter_map(|(scene, spp, rows)| of_level(scene, spp, &rows, metric)).collect()
}

fn of_level(scene: &str, spp: u32, rows: &Rows<'_>, metric: &str) -> Option<Spread> {
    let values: Vec<Vec<Option<f64>>> =
        rows.values().map(|records| by_replicate(records, None, metric)).collect();
    let mut found = Vec::new();
    for (place, a) in values.iter().enumerate() {
        found.extend(values[place + 1..].iter().filter_map(|b| log_ratio_spread(a, b)).filter(|s| *s > 0.0));
    }
    found.sort_by(f64::total_cmp);
    let last = found.len().checked_sub(1)?;
    Some(Spread {
        scene: scene.to_owned(),
        spp,
        pairs: found.len(),
        replicates: rows.values().map(|records| records.len() as u32).max().unwrap_or(0),
        median: median(found.iter().copied())?,
        tenth: found[(0.9 * last as f64).round() as usize],
    })
}
