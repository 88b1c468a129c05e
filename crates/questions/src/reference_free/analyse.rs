use noisefloor_stats::{Region, leave_one_out_interval, replicate_interval};
use noisefloor_study::record::Record;
use noisefloor_study::summary::{ClaimId, Interval, Scale, Source, Summary};
use noisefloor_study::{BASELINE, format};
use serde::{Deserialize, Serialize};

use super::ID;
use super::level::{Answer, Count};
use crate::answers;
use crate::cell::ALL;
use crate::claims::{Claim, push};
use crate::records::{Index, LEVEL, told};

/// Coverage of a level among pixel-channels with s > 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Finding {
    pub(super) scene: String,
    pub(super) spp: u32,
    pub(super) confidence: f64,
    pub(super) class: String,
    /// Of the mean of the other replicates.
    pub(super) covered: Interval,
    /// Share of the misses with the others' mean above the interval; nothing without a miss.
    pub(super) above: Option<f64>,
    /// Of the reference, with the allowance for its noise, mean over the same replicates.
    pub(super) against: Option<f64>,
    /// The first minus the second, replicate by replicate.
    pub(super) lost: Option<Interval>,
    /// Share of all pixel-channels with s = 0 and the mean of the others.
    pub(super) constant: f64,
    /// Share of all with s = 0 and another mean.
    pub(super) missed: f64,
}

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    let baseline = index.baseline();
    let label = baseline.map_or(BASELINE, |row| row.summary.label.as_str());
    let mut findings = Vec::new();
    for scene in index.scenes() {
        for level in &scene.levels {
            let answer = answers::read::<Answer>(&level.answers, ID);
            let Some(answer) = answer else { continue };
            let records = index.records(scene, level.spp, label);
            for count in &answer.counts {
                let against = |replicate| against(records, replicate, count);
                let found = finding((&scene.id, level.spp), &answer.replicates, count, against);
                let Some(found) = found else { continue };
                if found.class == ALL {
                    push(summary, claim(&found, label, count.spread.pixels()));
                }
                findings.push(found);
            }
        }
    }
    if !findings.is_empty() {
        answers::keep(&mut summary.answers, ID, &findings);
    }
}

/// `against` is the coverage of the reference in a replicate.
fn finding(
    (scene, spp): (&str, u32),
    replicates: &[u32],
    count: &Count,
    against: impl Fn(u32) -> Option<f64>,
) -> Option<Finding> {
    let rates: Vec<(u32, f64)> = replicates
        .iter()
        .zip(count.total.iter().zip(&count.covered))
        .filter(|(_, (total, _))| **total > 0)
        .map(|(replicate, (total, covered))| (*replicate, *covered as f64 / *total as f64))
        .collect();
    let values: Vec<f64> = rates.iter().map(|(_, rate)| *rate).collect();
    let covered = leave_one_out_interval(&values, &count.spread, LEVEL)?;
    let pairs: Vec<(f64, f64)> =
        rates.iter().filter_map(|(replicate, rate)| Some((*rate, against(*replicate)?))).collect();
    let lost: Vec<f64> = pairs.iter().map(|(own, against)| own - against).collect();
    let (above, below) = (count.truth_above, count.truth_below);
    let (constant, missed) = (count.constant, count.missed);
    let all = (count.total.iter().sum::<u64>() + constant + missed).max(1) as f64;
    Some(Finding {
        scene: scene.to_owned(),
        spp,
        confidence: count.confidence,
        class: count.class.clone(),
        covered: told(covered, Source::Replicates, None),
        above: (above + below > 0).then(|| above as f64 / (above + below) as f64),
        against: crate::records::mean(pairs.iter().map(|(_, against)| *against)),
        lost: replicate_interval(&lost, 0.0, LEVEL).map(|i| told(i, Source::Replicates, None)),
        constant: constant as f64 / all,
        missed: missed as f64 / all,
    })
}

/// Coverage of the reference in the same class of the same replicate, among pixel-channels with s > 0.
fn against(records: &[&Record], replicate: u32, count: &Count) -> Option<f64> {
    let record = records.iter().find(|record| record.replicate == replicate)?;
    let same = record.coverage.iter().find(|c| c.confidence == count.confidence && c.class == count.class)?;
    (same.total > 0).then(|| same.covered as f64 / same.total as f64)
}

/// Which claim it is that intervals cover; `label` is the input's.
pub(super) fn id_of(found: &Finding, label: &str) -> ClaimId {
    ClaimId {
        question: ID.into(),
        what: format!("{} of pixels with s > 0", format::percent_short(found.confidence)),
        scene: found.scene.clone(),
        spp: Some(found.spp),
        label: label.to_owned(),
    }
}

fn claim(found: &Finding, label: &str, pixels: u64) -> Claim {
    Claim {
        id: id_of(found, label),
        sentence: format!(
            "Student's {} intervals cover the mean of the other replicates as often",
            format::percent_short(found.confidence)
        ),
        effect: found.covered.clone(),
        uncorrected: None,
        scale: Scale::Share,
        region: Some(Region::coverage(found.confidence)),
        common: 0.0,
        trials: Some(pixels),
        replicates_per_value: 1,
    }
}

#[cfg(test)]
mod tests;
