//! What the replicates of each level can tell.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_questions::Spread;
use noisefloor_stats::Design;
use noisefloor_study::plan::Item;
use serde::Serialize;

/// Spread over replicates of the logarithm of the ratio of two rows' relMSE in studies of this repository: the smallest and
/// the largest median over pairs of a study, and what a tenth of all pairs exceed.
const USUAL: [(&str, f64); 3] = [("calm pair", 0.007), ("usual pair", 0.025), ("one pair in ten", 0.27)];

/// What is asked of every level.
pub(super) struct Question {
    design: Design,
    ratio: f64,
    power: f64,
}

impl Question {
    pub(super) fn new(pairs: u32, ratio: f64, power: f64) -> Self {
        Self { design: Design::new(noisefloor_stats::Level::TWO_SIDED_95, pairs), ratio, power }
    }

    pub(super) fn confidence(&self) -> f64 {
        noisefloor_stats::Level::TWO_SIDED_95.confidence()
    }

    /// What `replicates` tell of pairs with a spread.
    fn answer(&self, pair: &str, spread: f64, replicates: u32) -> Told {
        let below = |log: Option<f64>| log.map(|log| (-log).exp());
        let difference = self.ratio.ln().abs();
        Told {
            pair: pair.to_owned(),
            spread,
            ratio_told_by_half: below(self.design.half_width(spread, replicates)),
            ratio_told_with_power: below(self.design.difference_told(spread, replicates, self.power)),
            replicates_for_half: self.design.replicates(spread, difference),
            replicates_with_power: self.design.replicates_for(spread, difference, self.power),
        }
    }
}

/// What is told of pairs with one spread.
#[derive(Debug, Serialize)]
pub(super) struct Told {
    /// Which pairs.
    pub(super) pair: String,
    /// Standard deviation over replicates of the logarithm of their ratio.
    pub(super) spread: f64,
    /// The ratio below 1 that half of such studies tell; absent below two replicates.
    pub(super) ratio_told_by_half: Option<f64>,
    /// The ratio below 1 that the share of studies asked for tells.
    pub(super) ratio_told_with_power: Option<f64>,
    /// Replicates with which half of such studies tell the ratio asked for; absent above 65 536.
    pub(super) replicates_for_half: Option<u32>,
    /// The same for the share asked for.
    pub(super) replicates_with_power: Option<u32>,
}

/// A level of a scene; of all scenes that have it where the spread is the usual one.
#[derive(Debug, Serialize)]
pub(super) struct Level {
    /// Scene id; absent for all.
    pub(super) scene: Option<String>,
    /// Samples per pixel; absent for all.
    pub(super) spp: Option<u32>,
    /// Replicates planned.
    pub(super) replicates: u32,
    pub(super) told: Vec<Told>,
}

/// By scene and level with the spread that was measured there, then once for each number of replicates of the levels of
/// which none was measured, with the usual one.
pub(super) fn levels(items: &[Item], spreads: &[Spread], question: &Question) -> Vec<Level> {
    let mut out = Vec::new();
    let mut unknown = BTreeSet::new();
    for (scene, spp, replicates) in planned(items) {
        match spreads.iter().find(|spread| spread.scene == scene && spread.spp == spp) {
            Some(spread) => out.push(Level {
                scene: Some(scene.to_owned()),
                spp: Some(spp),
                replicates,
                told: vec![
                    question.answer("median pair", spread.median, replicates),
                    question.answer("one pair in ten", spread.tenth, replicates),
                ],
            }),
            None => drop(unknown.insert(replicates)),
        }
    }
    out.extend(unknown.into_iter().map(|replicates| Level {
        scene: None,
        spp: None,
        replicates,
        told: USUAL.iter().map(|(pair, spread)| question.answer(pair, *spread, replicates)).collect(),
    }));
    out
}

/// Scene, level and replicates, in the order of the plan.
fn planned(items: &[Item]) -> Vec<(&str, u32, u32)> {
    let mut order: Vec<(&str, u32)> = Vec::new();
    let mut replicates: BTreeMap<(&str, u32), BTreeSet<u32>> = BTreeMap::new();
    for item in items {
        let Item::Cell(cell) = item else { continue };
        let level = (cell.scene.as_str(), cell.spp);
        let known = replicates.entry(level).or_default();
        if known.is_empty() {
            order.push(level);
        }
        known.insert(cell.replicate);
    }
    order.into_iter().map(|(scene, spp)| (scene, spp, replicates[&(scene, spp)].len() as u32)).collect()
}
