use noisefloor_stats::{self as stats, Direction, compare};

use crate::records::Index;
use crate::records::{LEVEL, told};
use crate::records::{by_replicate, reference_share};
use noisefloor_study::context::SceneContext;
use noisefloor_study::summary::{Comparison, PairResult, Source, Summary};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.comparisons = comparisons(index);
}

/// Rows against each other, per scene, level and metric, over the replicates that all of them have; none where fewer
/// than two can be ranked.
fn comparisons(index: &Index<'_>) -> Vec<Comparison> {
    let mut out = Vec::new();
    for scene in index.scenes() {
        for spp in index.levels_of(scene) {
            for metric in index.study.metrics.iter().filter(|id| noisefloor_study::metric::ranks(id)) {
                out.extend(one(index, scene, spp, metric));
            }
        }
    }
    out
}

fn one(index: &Index<'_>, scene: &SceneContext, spp: u32, metric: &str) -> Option<Comparison> {
    let mut labels = Vec::new();
    let mut values = Vec::new();
    let mut noise = Vec::new();
    for row in index.rows() {
        if index.left_out(scene, spp, &row.summary.label).is_some() {
            continue;
        }
        let records = index.records(scene, spp, &row.summary.label);
        let of_row = by_replicate(records, None, metric);
        if of_row.iter().any(Option::is_some) {
            labels.push(row.summary.label.clone());
            values.push(of_row);
            noise.push(reference_share(records, None, metric));
        }
    }
    if labels.len() < 2 {
        return None;
    }
    let rows: Vec<stats::Row<'_>> =
        values.iter().zip(&noise).map(|(values, reference)| stats::Row { values, reference }).collect();
    let direction = if noisefloor_study::metric::lower_is_better(metric) {
        Direction::LowerIsBetter
    } else {
        Direction::HigherIsBetter
    };
    let family = index.study.comparison;
    let found = compare(&rows, direction, family, LEVEL);
    let named = |indices: &[usize]| indices.iter().map(|&i| labels[i].clone()).collect();
    Some(Comparison {
        scene: scene.id.clone(),
        spp,
        metric: metric.to_owned(),
        ranking: named(&found.ranking),
        best_group: named(&found.best_group),
        family,
        pairs: found
            .pairs
            .iter()
            .map(|pair| PairResult {
                a: labels[pair.a].clone(),
                b: labels[pair.b].clone(),
                effect: told(pair.effect.interval, Source::Replicates, None),
                is_ratio: pair.effect.is_ratio,
                p_adjusted: pair.p_adjusted,
                distinguishable: pair.distinguishable,
            })
            .collect(),
    })
}
