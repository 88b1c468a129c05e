use noisefloor_stats::replicate_interval;
use noisefloor_study::record::Record;
use noisefloor_study::summary::{Interval, Source, Summary};
use serde::{Deserialize, Serialize};

use super::ID;
use super::measure::Answer;
use crate::answers;
use crate::records::{Index, LEVEL, told};

/// Means over the replicates of a row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Finding {
    pub(super) scene: String,
    pub(super) spp: u32,
    pub(super) label: String,
    /// Share of the pixels whose squared error grew.
    pub(super) grew: Interval,
    /// Share of the pixels where that is more than the reference's noise explains; nothing where that is not known.
    pub(super) surely: Option<Interval>,
    /// What growth adds, over the squared error of the input.
    pub(super) added: Interval,
    /// What shrinking takes away, over the same.
    pub(super) removed: Interval,
}

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    let found = findings(index);
    if !found.is_empty() {
        answers::keep(&mut summary.answers, ID, &found);
    }
}

fn findings(index: &Index<'_>) -> Vec<Finding> {
    let mut out = Vec::new();
    for scene in index.scenes() {
        for spp in index.levels_of(scene) {
            for row in index.rows() {
                let label = &row.summary.label;
                let records = index.records(scene, spp, label);
                out.extend(finding(&scene.id, spp, label, records));
            }
        }
    }
    out
}

fn finding(scene: &str, spp: u32, label: &str, records: &[&Record]) -> Option<Finding> {
    let answer = |record: &&Record| answers::read::<Answer>(&record.answers, ID);
    let answers: Vec<Answer> = records.iter().filter_map(answer).filter(|a| a.pixels > 0).collect();
    let mean = |of: &dyn Fn(&Answer) -> f64| {
        let values: Vec<f64> = answers.iter().map(of).collect();
        replicate_interval(&values, 0.0, LEVEL).map(|interval| told(interval, Source::Replicates, None))
    };
    // Above 0 by the filter.
    let share = |count: u64, a: &Answer| count as f64 / a.pixels as f64;
    Some(Finding {
        scene: scene.to_owned(),
        spp,
        label: label.to_owned(),
        grew: mean(&|a| share(a.grew, a))?,
        // All replicates have the same reference: all know it or none. Means leave out what is no number.
        surely: mean(&|a| a.surely.map_or(f64::NAN, |surely| share(surely, a))),
        added: mean(&|a| a.added)?,
        removed: mean(&|a| a.removed)?,
    })
}
