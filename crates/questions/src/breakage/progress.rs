//! How much of what was planned has ended.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_study::context::{Context, PlannedScene};
use noisefloor_study::record::Record;
use noisefloor_study::summary::{Completion, Missing};
use noisefloor_study::{SceneSource, Study};

/// Planned and finished cells; `None` where the plan is not known: frames of a folder whose list was not kept.
pub(super) fn progress(study: &Study, context: &Context, records: &[Record]) -> Option<Completion> {
    let plan = planned(study, context)?;
    let rows: Vec<&str> = study.methods.iter().map(|row| row.label.as_str()).collect();
    let ended: BTreeSet<(&str, u32, &str, u32)> =
        records.iter().map(|r| (r.scene.as_str(), r.spp, r.label.as_str(), r.replicate)).collect();
    let mut out = Completion::default();
    for scene in &plan {
        let levels = scene.replicates.values().map(|n| u64::from(*n) * rows.len() as u64);
        let cells: u64 = levels.sum();
        let missing = missing(scene, &rows, &ended);
        out.planned += cells;
        out.finished += cells - missing.iter().map(|m| m.cells).sum::<u64>();
        out.missing.extend(missing);
    }
    Some(out)
}

/// Levels and replicates of every scene, as they were when the run began; from the study where an earlier program kept
/// no such list.
fn planned(study: &Study, context: &Context) -> Option<Vec<PlannedScene>> {
    if !context.plan.is_empty() {
        return Some(context.plan.clone());
    }
    let of_scene = |spec: &noisefloor_study::SceneSpec| {
        let replicates = match &spec.source {
            SceneSource::Folder(_) => {
                context.scenes.iter().find(|scene| scene.id == spec.id)?.replicates.clone()
            }
            _ => study.levels(spec).iter().map(|&spp| (spp, study.replicates(spec, spp))).collect(),
        };
        Some(PlannedScene { id: spec.id.clone(), replicates })
    };
    study.scenes.iter().map(of_scene).collect()
}

/// Rows and replicates that some levels lack, both empty for "all", with these levels and how many cells they are.
type Gap = (Vec<String>, Vec<u32>, Vec<u32>, u64);

/// What a scene lacks: the whole of it, whole levels, or single rows and replicates, like ones together.
fn missing(scene: &PlannedScene, rows: &[&str], ended: &BTreeSet<(&str, u32, &str, u32)>) -> Vec<Missing> {
    let mut groups: Vec<Gap> = Vec::new();
    for (&spp, &count) in &scene.replicates {
        let mut by_lack: BTreeMap<Vec<u32>, Vec<&str>> = BTreeMap::new();
        for &row in rows {
            let lack: Vec<u32> =
                (0..count).filter(|&r| !ended.contains(&(scene.id.as_str(), spp, row, r))).collect();
            if !lack.is_empty() {
                by_lack.entry(lack).or_default().push(row);
            }
        }
        for (lack, labels) in by_lack {
            let cells = (lack.len() * labels.len()) as u64;
            let labels: Vec<String> = match labels.len() == rows.len() {
                true => Vec::new(),
                false => labels.into_iter().map(str::to_owned).collect(),
            };
            let lack = if lack.len() == count as usize { Vec::new() } else { lack };
            match groups.iter_mut().find(|(l, r, ..)| *l == labels && *r == lack) {
                Some((.., levels, sum)) => {
                    levels.push(spp);
                    *sum += cells;
                }
                None => groups.push((labels, lack, vec![spp], cells)),
            }
        }
    }
    let entry = |(rows, replicates, spp, cells): (Vec<String>, Vec<u32>, Vec<u32>, u64)| Missing {
        scene: scene.id.clone(),
        all_levels: spp.len() == scene.replicates.len(),
        spp,
        rows,
        replicates,
        cells,
    };
    groups.into_iter().map(entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn like_gaps_are_told_together() {
        let scene = PlannedScene { id: "s".into(), replicates: BTreeMap::from([(4, 2), (16, 2), (64, 1)]) };
        let rows = ["a", "b"];
        let mut ended = BTreeSet::new();
        let all = missing(&scene, &rows, &ended);
        assert_eq!((all.len(), all[0].cells, all[0].all_levels), (1, 10, true));
        for (spp, row, replicate) in
            [(4, "a", 0), (4, "a", 1), (4, "b", 0), (16, "a", 0), (16, "a", 1), (16, "b", 0)]
        {
            ended.insert(("s", spp, row, replicate));
        }
        let told: Vec<String> = missing(&scene, &rows, &ended).iter().map(ToString::to_string).collect();
        assert_eq!(told, ["s at 4 and 16 spp, b, replicate 2 (2 cells)", "s at 64 spp (2 cells)"]);
        ended.extend([("s", 4, "b", 1), ("s", 16, "b", 1), ("s", 64, "a", 0), ("s", 64, "b", 0)]);
        assert!(missing(&scene, &rows, &ended).is_empty());
    }
}
