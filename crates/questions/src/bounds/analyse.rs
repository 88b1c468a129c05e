use noisefloor_stats::{BoundVerdict, Interval, bound_verdict};

use crate::coverage::mark;
use crate::records::Index;
use crate::records::{LEVEL, mean, rate};
use noisefloor_study::context::SceneContext;
use noisefloor_study::record::{BoundCount, Record};
use noisefloor_study::summary::{BoundState, BoundSummary, Summary};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.bounds = bounds(index);
}

/// Violations per scene, level, row, claim and class, over replicates.
fn bounds(index: &Index<'_>) -> Vec<BoundSummary> {
    let mut out = Vec::new();
    for scene in index.scenes() {
        for spp in index.levels_of(scene) {
            for row in index.rows() {
                let label = &row.summary.label;
                let records = index.records(scene, spp, label);
                let mut kinds: Vec<(&str, &str)> = Vec::new();
                for count in records.iter().flat_map(|record| &record.bounds) {
                    if !kinds.iter().any(|(claim, class)| *claim == count.claim && *class == count.class) {
                        kinds.push((&count.claim, &count.class));
                    }
                }
                for (claim, class) in kinds {
                    out.extend(one(scene, spp, label, claim, class, records));
                }
            }
        }
    }
    out
}

fn one(
    scene: &SceneContext,
    spp: u32,
    label: &str,
    claim: &str,
    class: &str,
    records: &[&Record],
) -> Option<BoundSummary> {
    let counts: Vec<&BoundCount> = records
        .iter()
        .flat_map(|record| &record.bounds)
        .filter(|count| count.claim == claim && count.class == class)
        .collect();
    let first = counts.first()?;
    let rates: Vec<(u64, u64)> = counts.iter().map(|c| (c.violations, c.total)).collect();
    let violations = rate(&rates, first.within_se)?;
    let total: u64 = counts.iter().map(|c| c.total).sum();
    let share = |part: fn(&BoundCount) -> u64| {
        counts.iter().map(|c| part(c)).sum::<u64>() as f64 / total.max(1) as f64
    };
    let judged = Interval {
        value: violations.value,
        standard_error: violations.standard_error,
        low: violations.low,
        high: violations.high,
        level: LEVEL,
        n: violations.n,
    };
    let verdict = match bound_verdict(&judged, first.alpha) {
        // A single number without an interval may lie anywhere by chance.
        _ if judged.low.is_none() => BoundState::Undecided,
        BoundVerdict::Holds => BoundState::Holds,
        BoundVerdict::Fails => BoundState::Fails,
    };
    Some(BoundSummary {
        scene: scene.id.clone(),
        spp,
        label: label.to_owned(),
        claim: claim.to_owned(),
        proven: first.proven,
        alpha: first.alpha,
        class: class.to_owned(),
        violations,
        violations_uncorrected: share(|c| c.violations_uncorrected),
        missed: share(|c| c.violations_missed),
        mean_ratio: mean(counts.iter().filter_map(|c| c.mean_ratio)),
        verdict,
        mark: mark(scene, spp),
    })
}
