use noisefloor_stats::Region;

use crate::cell::ALL;
use crate::claims::{Claim, push};
use crate::coverage::{bracketed, mark};
use crate::records::Index;
use crate::records::{mean, rate};
use noisefloor_study::context::SceneContext;
use noisefloor_study::format;
use noisefloor_study::record::{BoundCount, Record};
use noisefloor_study::summary::{BoundSummary, ClaimId, Scale, Summary};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    for scene in index.scenes() {
        for spp in index.levels_of(scene) {
            for row in index.rows() {
                let label = &row.summary.label;
                of_row(scene, spp, label, index.records(scene, spp, label), summary);
            }
        }
    }
}

/// Violations per claim and class over the replicates of a row at a level.
fn of_row(scene: &SceneContext, spp: u32, label: &str, records: &[&Record], summary: &mut Summary) {
    let mut kinds: Vec<(&str, &str)> = Vec::new();
    for count in records.iter().flat_map(|record| &record.bounds) {
        if !kinds.iter().any(|(claim, class)| *claim == count.claim && *class == count.class) {
            kinds.push((&count.claim, &count.class));
        }
    }
    for (claim, class) in kinds {
        let of_kind = |count: &&BoundCount| count.claim == claim && count.class == class;
        let counts: Vec<&BoundCount> =
            records.iter().flat_map(|record| &record.bounds).filter(of_kind).collect();
        if let Some(bound) = one(scene, spp, label, &counts) {
            if class == ALL {
                claim_of(scene, &bound, &counts, summary);
            }
            summary.bounds.push(bound);
        }
    }
}

/// The promise of a bound over all pixels.
fn claim_of(scene: &SceneContext, bound: &BoundSummary, counts: &[&BoundCount], summary: &mut Summary) {
    let raw: Vec<(u64, u64)> = counts.iter().map(|c| (c.violations_uncorrected, c.total)).collect();
    let raw = bracketed(scene, bound.spp).then(|| rate(&raw, counts.first()?.within_se)).flatten();
    let alpha = format::percent_short(bound.alpha);
    let id = id_of(bound);
    let claim = Claim {
        sentence: format!("{}: broken by at most {alpha} of the pixel-channels", id.what),
        id,
        effect: bound.violations.clone(),
        uncorrected: raw,
        scale: Scale::Share,
        region: Some(Region::bound(bound.alpha)),
        common: 0.0,
        trials: Some(counts.iter().map(|c| c.total).sum::<u64>() / 3),
        replicates_per_value: 1,
    };
    push(summary, claim);
}

/// Which claim a bound of a row is.
pub(crate) fn id_of(bound: &BoundSummary) -> ClaimId {
    ClaimId {
        question: "bounds".into(),
        what: format!("{} ({})", bound.claim, if bound.proven { "proven" } else { "unproven" }),
        scene: bound.scene.clone(),
        spp: Some(bound.spp),
        label: bound.label.clone(),
    }
}

fn one(scene: &SceneContext, spp: u32, label: &str, counts: &[&BoundCount]) -> Option<BoundSummary> {
    let first = counts.first()?;
    let rates: Vec<(u64, u64)> = counts.iter().map(|c| (c.violations, c.total)).collect();
    let violations = rate(&rates, first.within_se)?;
    let total: u64 = counts.iter().map(|c| c.total).sum();
    let share = |part: fn(&BoundCount) -> u64| {
        counts.iter().map(|c| part(c)).sum::<u64>() as f64 / total.max(1) as f64
    };
    Some(BoundSummary {
        scene: scene.id.clone(),
        spp,
        label: label.to_owned(),
        claim: first.claim.clone(),
        proven: first.proven,
        alpha: first.alpha,
        class: first.class.clone(),
        violations,
        violations_uncorrected: share(|c| c.violations_uncorrected),
        missed: share(|c| c.violations_missed),
        mean_ratio: mean(counts.iter().filter_map(|c| c.mean_ratio)),
        mark: mark(scene, spp),
    })
}
