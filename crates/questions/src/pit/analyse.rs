use std::collections::BTreeMap;

use noisefloor_stats::{EcdfBand, Region, replicate_interval};
use noisefloor_study::BASELINE;
use noisefloor_study::summary::{ClaimId, Interval, Scale, Source, Summary};
use serde::{Deserialize, Serialize};

use super::ID;
use super::answer::{Answer, POINTS};
use crate::answers;
use crate::claims::{Claim, push};
use crate::records::{Index, LEVEL, told};

/// Share of transforms beyond which nothing is claimed of them.
const MOST_DRAWN: f64 = 0.1;

/// All levels, with the bands that they are held against.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Findings {
    pub(super) levels: Vec<Finding>,
    pub(super) bands: Vec<Band>,
}

/// Limits at the points between which so many uniform values stay with 95 % probability, all points together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Band {
    pub(super) values: u64,
    pub(super) low: Vec<f64>,
    pub(super) high: Vec<f64>,
}

/// Transforms of a level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Finding {
    pub(super) scene: String,
    pub(super) spp: u32,
    /// Fewest transforms of a replicate.
    pub(super) values: u64,
    /// Largest |F̂ − u| of a replicate, mean over replicates.
    pub(super) deviation: Interval,
    /// Shares of the transforms.
    pub(super) constant: f64,
    pub(super) missed_above: f64,
    pub(super) missed_below: f64,
    /// Chosen pixels without a transform, in all replicates.
    pub(super) left_out: u64,
    /// F̂ at the points, mean over replicates.
    pub(super) ecdf: Vec<f64>,
}

impl Band {
    /// Largest distance of a limit from the diagonal: what one replicate's values may deviate.
    pub(super) fn half_width(&self) -> f64 {
        let away = |(i, (low, high)): (usize, (&f64, &f64))| {
            let z = (i + 1) as f64 / POINTS as f64;
            (high - z).max(z - low)
        };
        self.low.iter().zip(&self.high).enumerate().map(away).fold(0.0, f64::max)
    }
}

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    let label = index.baseline().map_or(BASELINE, |row| row.summary.label.as_str());
    let mut found = Findings::default();
    let mut bands: BTreeMap<u64, Band> = BTreeMap::new();
    for scene in index.scenes() {
        for level in &scene.levels {
            let answer = answers::read::<Answer>(&level.answers, ID);
            let Some(finding) = answer.and_then(|answer| finding(&scene.id, level.spp, answer)) else {
                continue;
            };
            if !bands.contains_key(&finding.values) {
                bands.extend(band(finding.values).map(|band| (finding.values, band)));
            }
            if let Some(band) = bands.get(&finding.values) {
                claim(&finding, band, label).into_iter().for_each(|claim| push(summary, claim));
                found.levels.push(finding);
            }
        }
    }
    found.bands = bands.into_values().collect();
    if !found.levels.is_empty() {
        answers::keep(&mut summary.answers, ID, &found);
    }
}

/// Nothing for a number of values that no band is made for.
fn band(values: u64) -> Option<Band> {
    let band = EcdfBand::new(values as usize, POINTS, LEVEL.confidence()).ok()?;
    Some(Band { values, low: band.low, high: band.high })
}

fn finding(scene: &str, spp: u32, answer: Answer) -> Option<Finding> {
    let deviation = replicate_interval(&answer.deviation, 0.0, LEVEL)?;
    // A distance of two distribution functions.
    let cut = |end: Option<f64>| end.map(|end| end.clamp(0.0, 1.0));
    let deviation =
        noisefloor_stats::Interval { low: cut(deviation.low), high: cut(deviation.high), ..deviation };
    let sum = |counts: &[u64]| counts.iter().sum::<u64>();
    let all = sum(&answer.values).max(1) as f64;
    Some(Finding {
        scene: scene.to_owned(),
        spp,
        values: answer.values.iter().copied().min()?,
        deviation: told(deviation, Source::Replicates, None),
        constant: sum(&answer.constant) as f64 / all,
        missed_above: sum(&answer.missed_above) as f64 / all,
        missed_below: sum(&answer.missed_below) as f64 / all,
        left_out: sum(&answer.left_out),
        ecdf: answer.ecdf,
    })
}

/// Which claim it is that a level's transforms are uniform; `label` is the input's.
pub(super) fn id_of(found: &Finding, label: &str) -> ClaimId {
    ClaimId {
        question: ID.into(),
        what: "PIT is uniform".into(),
        scene: found.scene.clone(),
        spp: Some(found.spp),
        label: label.to_owned(),
    }
}

/// Of constant pixels the transform is drawn: where those are many it is uniform for no reason, and nothing is claimed.
fn claim(found: &Finding, band: &Band, label: &str) -> Option<Claim> {
    (found.constant <= MOST_DRAWN).then(|| Claim {
        id: id_of(found, label),
        sentence: format!("PIT is uniform: it deviates no more than {} uniform values do", found.values),
        effect: found.deviation.clone(),
        uncorrected: None,
        scale: Scale::Number,
        region: Some(Region { low: 0.0, high: band.half_width() }),
        common: 0.0,
        trials: None,
        replicates_per_value: 1,
    })
}

#[cfg(test)]
mod tests;
