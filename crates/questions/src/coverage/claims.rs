//! What is claimed of the input's intervals.

use noisefloor_stats::Region;
use noisefloor_study::context::SceneContext;
use noisefloor_study::format;
use noisefloor_study::record::CoverageCount;
use noisefloor_study::summary::{ClaimId, CoverageSummary, Interval, Scale, Summary};

use crate::cell::ALL;
use crate::claims::{Claim, push};
use crate::records::{rate, reference_ratio};

/// Samples of a reference over those of a level below which its noise and the allowance for it matter, at few samples.
const LONG: f64 = 64.0;
/// The most samples at which they do.
const FEW: u32 = 16;

/// Whether the truth lies between the numbers with and without the allowance for the reference's noise.
pub(crate) fn bracketed(scene: &SceneContext, spp: u32) -> bool {
    spp <= FEW && reference_ratio(scene, spp) < LONG
}

/// Which claim it is that intervals cover where there are any; `label` is the input's.
pub(super) fn id_of(row: &CoverageSummary, label: &str) -> ClaimId {
    id(row, Part::Varying, label)
}

fn id(row: &CoverageSummary, part: Part, label: &str) -> ClaimId {
    ClaimId {
        question: "coverage".into(),
        what: format!("{} of {}", format::percent_short(row.confidence), part.name()),
        scene: row.scene.clone(),
        spp: Some(row.spp),
        label: label.to_owned(),
    }
}

/// Pixel-channels that a claim is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// Those with s > 0.
    Varying,
    /// Those and the ones whose samples all missed the light.
    Lit,
}

impl Part {
    fn name(self) -> &'static str {
        match self {
            Self::Varying => "pixels with s > 0",
            Self::Lit => "pixels with s > 0 or missed events",
        }
    }

    /// Covered, covered without the allowance, and all of them.
    fn counts(self, c: &CoverageCount) -> [u64; 3] {
        let all = c.total + if self == Self::Lit { c.missed } else { 0 };
        [c.covered, c.covered_uncorrected, all]
    }

    /// The share covered over replicates, with and without the allowance, and the trials behind it.
    pub(crate) fn share(self, counts: &[&CoverageCount]) -> Option<([Interval; 2], u64)> {
        let of = |k: usize| -> Vec<(u64, u64)> {
            counts.iter().map(|c| self.counts(c)).map(|counts| (counts[k], counts[2])).collect()
        };
        let within = match counts {
            // That of all pixels over the share of them that take part: constant pixels are always covered.
            [only] => only.within_se.map(|se| {
                let all = only.total + only.constant + only.missed;
                se * all as f64 / self.counts(only)[2].max(1) as f64
            }),
            _ => None,
        };
        let trials = counts.iter().map(|c| self.counts(c)[2]).sum::<u64>() / 3;
        Some(([rate(&of(0), within)?, rate(&of(1), within)?], trials))
    }
}

/// Claims about all pixels of a level: coverage where there is an interval and, if samples missed light anywhere, where
/// there should be one.
pub(super) fn claims(
    summary: &mut Summary,
    scene: &SceneContext,
    label: &str,
    (row, counts): (&CoverageSummary, &[&CoverageCount]),
) {
    if row.class != ALL {
        return;
    }
    let lit = (row.missed > 0.0).then_some(Part::Lit);
    for part in std::iter::once(Part::Varying).chain(lit) {
        let Some(([effect, raw], trials)) = part.share(counts) else { continue };
        let region = Region::coverage(row.confidence);
        push(
            summary,
            Claim {
                id: id(row, part, label),
                sentence: format!(
                    "Student's {} intervals cover as often as they say among {}",
                    format::percent_short(row.confidence),
                    part.name()
                ),
                effect,
                uncorrected: bracketed(scene, row.spp).then_some(raw),
                scale: Scale::Share,
                region: Some(region),
                common: 0.0,
                trials: Some(trials),
                replicates_per_value: 1,
            },
        );
    }
}

#[cfg(test)]
mod tests;
