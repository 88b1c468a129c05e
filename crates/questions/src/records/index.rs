use std::collections::{BTreeMap, BTreeSet};

use super::standing::Standing;
use noisefloor_study::context::{Context, RowContext, SceneContext};
use noisefloor_study::record::{Outcome, Record};
use noisefloor_study::summary::{Skipped, Status};
use noisefloor_study::{Flicker, RowFrames, Study};

/// Finished cells by scene, level and row, in the order of the study.
#[derive(Debug)]
pub struct Index<'a> {
    pub(crate) study: &'a Study,
    pub(crate) context: &'a Context,
    done: BTreeMap<(String, u32, String), Vec<&'a Record>>,
    /// The same, of ranked rows only the replicates that all of them have.
    comparable: BTreeMap<(String, u32, String), Vec<&'a Record>>,
    standings: BTreeMap<(String, u32), Standing>,
    ended: Vec<&'a Record>,
    /// All, in the order of the plan.
    pub(crate) all: &'a [Record],
    /// What was measured over the frames of sequences.
    pub(crate) flicker: &'a [Flicker],
    /// Whether they are of a recorded study, which keeps no images.
    pub(crate) recorded: bool,
}

impl<'a> Index<'a> {
    pub(crate) fn new(
        (study, context): (&'a Study, &'a Context),
        records: &'a [Record],
        flicker: &'a [Flicker],
        recorded: bool,
    ) -> Self {
        let mut done: BTreeMap<_, Vec<&Record>> = BTreeMap::new();
        let mut ended = Vec::new();
        for record in records {
            match record.outcome {
                Outcome::Done => {
                    let key = (record.scene.clone(), record.spp, record.label.clone());
                    done.entry(key).or_default().push(record);
                }
                _ => ended.push(record),
            }
        }
        for replicates in done.values_mut() {
            replicates.sort_by_key(|record| record.replicate);
        }
        let mut levels: BTreeMap<(String, u32), Vec<&Record>> = BTreeMap::new();
        for record in records {
            levels.entry((record.scene.clone(), record.spp)).or_default().push(record);
        }
        let standings: BTreeMap<(String, u32), Standing> =
            levels.into_iter().map(|(level, records)| (level, Standing::of(&records))).collect();
        let mut comparable = done.clone();
        for ((scene, spp, label), records) in &mut comparable {
            let standing = standings.get(&(scene.clone(), *spp));
            if let Some(standing) = standing.filter(|s| !s.left_out.contains_key(label)) {
                records.retain(|record| standing.common.contains(&record.replicate));
            }
        }
        Self { study, context, done, comparable, standings, ended, all: records, flicker, recorded }
    }

    pub(crate) fn scenes(&self) -> &'a [SceneContext] {
        &self.context.scenes
    }

    pub(crate) fn rows(&self) -> &'a [RowContext] {
        &self.context.methods
    }

    /// The row that stands for plain Monte Carlo, if the study has one.
    pub(crate) fn baseline(&self) -> Option<&'a RowContext> {
        let plain = |row: &&RowContext| {
            row.summary.method == noisefloor_study::BASELINE && row.summary.frames == RowFrames::Uniform
        };
        self.rows().iter().find(plain)
    }

    /// All levels of all scenes, ascending.
    pub(crate) fn levels(&self) -> Vec<u32> {
        let all: BTreeSet<u32> =
            self.scenes().iter().flat_map(|scene| scene.replicates.keys().copied()).collect();
        all.into_iter().collect()
    }

    /// Levels of a scene, ascending.
    pub(crate) fn levels_of(&self, scene: &'a SceneContext) -> impl Iterator<Item = u32> + use<'a> {
        scene.replicates.keys().copied()
    }

    /// Replicates whose numbers can be set beside those of other rows: of a ranked row those that all ranked rows of
    /// the level have, of another all that ran. By number; empty if none did.
    pub(crate) fn records(&self, scene: &SceneContext, spp: u32, label: &str) -> &[&'a Record] {
        self.comparable.get(&(scene.id.clone(), spp, label.to_owned())).map_or(&[], Vec::as_slice)
    }

    /// All replicates that ran, by number: for what must hold in every one of them.
    pub(crate) fn every_record(&self, scene: &SceneContext, spp: u32, label: &str) -> &[&'a Record] {
        self.done.get(&(scene.id.clone(), spp, label.to_owned())).map_or(&[], Vec::as_slice)
    }

    /// Why a row takes no part in the ranking of a level, if so.
    pub(crate) fn left_out(&self, scene: &SceneContext, spp: u32, label: &str) -> Option<&str> {
        let standing = self.standings.get(&(scene.id.clone(), spp))?;
        standing.left_out.get(label).map(String::as_str)
    }

    /// Cells that did not run, merged over levels and replicates where the reason is the same.
    pub(crate) fn skipped(&self) -> Vec<Skipped> {
        let mut out: Vec<Skipped> = Vec::new();
        for record in &self.ended {
            let (status, reason) = match &record.outcome {
                Outcome::Done => continue,
                Outcome::Skipped { reason } => (Status::Skipped, reason),
                Outcome::Failed { reason } => (Status::Failed, reason),
            };
            let same = |s: &&mut Skipped| {
                s.scene == record.scene
                    && s.label == record.label
                    && s.status == status
                    && s.reason == *reason
            };
            match out.iter_mut().find(same) {
                Some(entry) if entry.spp.contains(&record.spp) => {}
                Some(entry) => entry.spp.push(record.spp),
                None => out.push(Skipped {
                    scene: record.scene.clone(),
                    spp: vec![record.spp],
                    label: record.label.clone(),
                    status,
                    reason: reason.clone(),
                }),
            }
        }
        out
    }
}
