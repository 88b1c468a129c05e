use super::claims::{Part, claims};
use crate::records::Index;
use crate::records::rate;
use crate::records::{LONG_ENOUGH, reference_ratio, times};
use noisefloor_study::context::SceneContext;
use noisefloor_study::record::{CoverageCount, Record};
use noisefloor_study::summary::{CoverageSummary, Summary};

/// Why a count against the truth must be read with care, if so.
pub(crate) fn mark(scene: &SceneContext, spp: u32) -> Option<String> {
    let ratio = reference_ratio(scene, spp);
    if ratio >= LONG_ENOUGH {
        return None;
    }
    Some(if ratio > 0.0 {
        format!("the reference has only {} times the samples; {LONG_ENOUGH:.0} are assumed", times(ratio))
    } else {
        "how many samples the reference has is unknown".into()
    })
}

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    let Some(baseline) = index.baseline() else { return };
    let label = &baseline.summary.label;
    for scene in index.scenes() {
        for spp in index.levels_of(scene) {
            of_level(scene, spp, label, index.records(scene, spp, label), summary);
        }
    }
}

/// Coverage per confidence and class over the replicates of a level, and what is claimed of it.
fn of_level(scene: &SceneContext, spp: u32, label: &str, records: &[&Record], summary: &mut Summary) {
    // Some replicates may lack a class that has no statistics there; the union over them is shown.
    let mut kinds: Vec<(f64, &str)> = Vec::new();
    for count in records.iter().flat_map(|record| &record.coverage) {
        if !kinds.iter().any(|(c, class)| *c == count.confidence && *class == count.class) {
            kinds.push((count.confidence, &count.class));
        }
    }
    for (confidence, class) in kinds {
        let counts: Vec<&CoverageCount> = records
            .iter()
            .flat_map(|record| &record.coverage)
            .filter(|count| count.confidence == confidence && count.class == class)
            .collect();
        if let Some(row) = one(scene, spp, confidence, class, &counts) {
            claims(summary, scene, label, (&row, &counts));
            summary.coverage.push(row);
        }
    }
}

fn one(
    scene: &SceneContext,
    spp: u32,
    confidence: f64,
    class: &str,
    counts: &[&CoverageCount],
) -> Option<CoverageSummary> {
    let all = |c: &CoverageCount| c.total + c.constant + c.missed;
    let covered: Vec<(u64, u64)> = counts.iter().map(|c| (c.covered + c.constant, all(c))).collect();
    let uncorrected: Vec<(u64, u64)> =
        counts.iter().map(|c| (c.covered_uncorrected + c.constant, all(c))).collect();
    let within = counts.first().and_then(|count| count.within_se);
    let total: u64 = counts.iter().map(|c| all(c)).sum();
    let share = |part: fn(&CoverageCount) -> u64| {
        counts.iter().map(|c| part(c)).sum::<u64>() as f64 / total.max(1) as f64
    };
    Some(CoverageSummary {
        scene: scene.id.clone(),
        spp,
        confidence,
        class: class.to_owned(),
        covered: rate(&covered, within)?,
        covered_uncorrected: rate(&uncorrected, within)?,
        varying: Part::Varying.share(counts).map(|([share, _], _)| share),
        lit: Part::Lit.share(counts).map(|([share, _], _)| share),
        sides: sides(counts),
        constant: share(|c| c.constant),
        missed: share(|c| c.missed),
        mark: mark(scene, spp),
    })
}

/// On which side the truth lies where it is missed; nothing where misses were counted without.
fn sides(counts: &[&CoverageCount]) -> Option<[f64; 2]> {
    let sum = |part: fn(&CoverageCount) -> u64| counts.iter().map(|c| part(c)).sum::<u64>();
    let (total, missed) = (sum(|c| c.total), sum(|c| c.total - c.covered));
    let (above, below) = (sum(|c| c.truth_above), sum(|c| c.truth_below));
    (above + below == missed && total > 0).then(|| [above, below].map(|n| n as f64 / total as f64))
}
