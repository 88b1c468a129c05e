use noisefloor_stats::{Level, MembershipTest, Region, interval_rejection};
use noisefloor_study::context::SceneContext;
use noisefloor_study::format;
use noisefloor_study::summary::{ClaimId, Interval, Scale, Summary};
use serde::{Deserialize, Serialize};

use super::level::{ID, Pairs, name};
use crate::answers;
use crate::cell::ALL;
use crate::claims::{Claim, push};
use crate::records::{Index, rate};

/// A test at one level and shift, over pairs of replicates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Finding {
    pub(super) scene: String,
    pub(super) spp: u32,
    pub(super) test: String,
    pub(super) confidence: f64,
    pub(super) shift: f64,
    /// Pixel class or `all`.
    pub(super) class: String,
    /// Share told apart of channels with s > 0.
    pub(super) rejected: Interval,
    /// Share of pixels told apart in at least one channel.
    pub(super) joint: f64,
    /// What independent normal samples with equal errors would give, where that is known exactly.
    pub(super) normal: Option<f64>,
}

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    let Some(baseline) = index.baseline() else { return };
    let label = &baseline.summary.label;
    let mut out = Vec::new();
    for scene in index.scenes() {
        for level in &scene.levels {
            let pairs: Vec<Pairs> = answers::read(&level.answers, ID).unwrap_or_default();
            for pair in &pairs {
                out.extend(finding(scene, level.spp, pair));
            }
        }
    }
    out.iter()
        .filter(|found| found.class == ALL && found.shift == 0.0)
        .for_each(|found| claim(label, found, summary));
    if !out.is_empty() {
        answers::keep(&mut summary.answers, ID, &out);
    }
}

fn finding(scene: &SceneContext, spp: u32, pairs: &Pairs) -> Option<Finding> {
    let counts: Vec<(u64, u64)> = pairs.counts.iter().map(|c| (c.rejected, c.total)).collect();
    let sum = |part: fn(&noisefloor_stats::RejectionTally) -> u64| {
        pairs.counts.iter().map(part).sum::<u64>() as f64
    };
    let level = Level::two_sided(pairs.confidence).ok()?;
    let exact = pairs.test == name(MembershipTest::InInterval) && spp >= 2;
    let of_welch = pairs.test == name(MembershipTest::Welch) && pairs.shift == 0.0;
    Some(Finding {
        scene: scene.id.clone(),
        spp,
        test: pairs.test.clone(),
        confidence: pairs.confidence,
        shift: pairs.shift,
        class: pairs.class.clone(),
        rejected: rate(&counts, None)?,
        joint: sum(|c| c.pixels_rejected) / sum(|c| c.pixels).max(1.0),
        normal: match (exact, of_welch) {
            (true, _) => Some(interval_rejection(spp, pairs.shift, 1.0, level)),
            // Up to its approximation of the degrees of freedom.
            (false, true) => Some(level.alpha()),
            (false, false) => None,
        },
    })
}

/// Which claim it is.
pub(super) fn id_of(found: &Finding, label: &str) -> ClaimId {
    ClaimId {
        question: ID.into(),
        what: format!("{} at {}", found.test, format::percent_short(found.confidence)),
        scene: found.scene.clone(),
        spp: Some(found.spp),
        label: label.to_owned(),
    }
}

/// That equal pixels are told apart as often as of normal samples.
fn claim(label: &str, found: &Finding, summary: &mut Summary) {
    let Some(normal) = found.normal else { return };
    // As for coverage of one minus that rate.
    let Region { low, high } = Region::coverage(1.0 - normal);
    let claim = Claim {
        id: id_of(found, label),
        sentence: format!(
            "{} at {}: equal pixels are told apart as often as of normal samples",
            found.test,
            format::percent_short(found.confidence)
        ),
        effect: found.rejected.clone(),
        uncorrected: None,
        scale: Scale::Share,
        region: Some(Region { low: 1.0 - high, high: 1.0 - low }),
        common: 0.0,
        trials: None,
        replicates_per_value: 2, // of a pair
    };
    push(summary, claim);
}
