//! Claims, judged by one rule for the whole report.

use noisefloor_stats::{self as stats, Evidence, Judged, Needed, Region, Verdict, Verdicts, judge};
use noisefloor_study::summary::{ClaimFamily, ClaimId, ClaimSummary, Interval, Scale, Summary};

use crate::records::LEVEL;

/// A claim with what was measured.
#[derive(Debug)]
pub(crate) struct Claim {
    pub(crate) id: ClaimId,
    /// As in [`ClaimSummary::sentence`].
    pub(crate) sentence: String,
    pub(crate) effect: Interval,
    /// The effect without the allowance for the reference's noise, where the truth may as well lie there.
    pub(crate) uncorrected: Option<Interval>,
    pub(crate) scale: Scale,
    /// None where nothing can be judged, because what the effect is relative to is below what the reference shows.
    pub(crate) region: Option<Region>,
    /// Part of the standard error that all replicates share, on the logarithm of a ratio.
    pub(crate) common: f64,
    /// Trials behind a share: pixels, whose channels are one.
    pub(crate) trials: Option<u64>,
    /// As in [`ClaimSummary::replicates_per_value`].
    pub(crate) replicates_per_value: u32,
}

impl Claim {
    /// By itself.
    pub(crate) fn judged(&self) -> Judged {
        let open = |needed| Judged { alone: Verdict::NotShown, p: None, needed };
        let Some(region) = region_of(self.scale, self.region) else {
            // What the effect is relative to is not sure to be above 0.
            return open(Needed::Reference);
        };
        let Some(evidence) = evidence(self.scale, &self.effect, self.uncorrected.as_ref(), self.common)
        else {
            return open(Needed::Ratio);
        };
        let judged = judge(&Evidence { trials: self.trials, ..evidence }, region);
        Judged { needed: in_replicates(judged.needed, self.replicates_per_value), ..judged }
    }
}

/// A region on the scale that effects are judged on.
fn region_of(scale: Scale, region: Option<Region>) -> Option<Region> {
    match scale {
        Scale::Ratio => region.and_then(Region::ln),
        Scale::Share | Scale::Number => region,
    }
}

/// An effect on the scale that it is judged on, with the other end of its bracket if there is one; none for a ratio that is
/// not positive.
fn evidence(
    scale: Scale,
    effect: &Interval,
    uncorrected: Option<&Interval>,
    common: f64,
) -> Option<Evidence> {
    let of = |effect: &Interval| {
        let interval = stats::Interval {
            value: effect.value,
            standard_error: effect.standard_error,
            low: effect.low,
            high: effect.high,
            level: LEVEL,
            n: effect.n,
        };
        match scale {
            Scale::Ratio => Evidence::of_log_ratio(&interval, common),
            Scale::Share | Scale::Number => Some(Evidence::of(&interval, common)),
        }
    };
    match uncorrected {
        None => of(effect),
        Some(raw) => of(effect).zip(of(raw)).map(|(own, raw)| own.or(&raw)),
    }
}

/// Values that are needed, in replicates.
fn in_replicates(needed: Needed, per_value: u32) -> Needed {
    match needed {
        Needed::Replicates(count) => Needed::Replicates(count.saturating_mul(per_value)),
        Needed::Interval if per_value > 1 => Needed::Replicates(2 * per_value),
        other => other,
    }
}

/// Judges a claim by itself and keeps it for [`settle`].
pub(crate) fn push(summary: &mut Summary, claim: Claim) {
    let Judged { alone, p, needed } = claim.judged();
    summary.claims.push(ClaimSummary {
        id: claim.id,
        sentence: claim.sentence,
        effect: claim.effect,
        uncorrected: claim.uncorrected,
        scale: claim.scale,
        region: claim.region,
        common: claim.common,
        trials: claim.trials,
        replicates_per_value: claim.replicates_per_value,
        alone,
        verdict: alone,
        p,
        p_adjusted: None,
        needed,
    });
}

/// Judges all claims of the report as one family.
pub(crate) fn settle(summary: &mut Summary) {
    let judged = |claim: &ClaimSummary| Judged { alone: claim.alone, p: claim.p, needed: claim.needed };
    let judged: Vec<Judged> = summary.claims.iter().map(judged).collect();
    let family = Verdicts::of(&judged);
    for ((claim, verdict), p) in summary.claims.iter_mut().zip(family.verdicts).zip(family.adjusted) {
        (claim.verdict, claim.p_adjusted) = (verdict, p);
        if (claim.alone, claim.verdict) == (Verdict::Refuted, Verdict::NotShown) {
            claim.needed = needed_beside_others(claim);
        }
    }
    summary.family = ClaimFamily {
        tested: family.tested,
        refuted_alone: family.refuted_alone,
        by_chance: family.by_chance,
    };
}

/// What would make a refutation stand beside the other claims, if they stay what they are.
fn needed_beside_others(claim: &ClaimSummary) -> Needed {
    let region = region_of(claim.scale, claim.region);
    let found = evidence(claim.scale, &claim.effect, claim.uncorrected.as_ref(), claim.common);
    let (Some(region), Some(found), Some(p), Some(adjusted)) = (region, found, claim.p, claim.p_adjusted)
    else {
        return claim.needed;
    };
    let multiplier = if p > 0.0 { adjusted / p } else { 1.0 };
    let found = Evidence { trials: claim.trials, ..found };
    in_replicates(stats::needed_beside(&found, region, multiplier), claim.replicates_per_value)
}

#[cfg(test)]
mod tests {
    use noisefloor_study::summary::Source;

    use super::*;

    #[test]
    fn a_refutation_that_does_not_stand_beside_the_others_is_taken_back() {
        let interval = |value: f64, half: f64| Interval {
            value,
            standard_error: Some(half / 3.182_446),
            low: Some(value - half),
            high: Some(value + half),
            confidence: 0.95,
            n: 4,
            source: Source::Replicates,
            below: None,
        };
        let mut summary = Summary::default();
        for (what, value) in [("weak", 1.4), ("held", 0.5), ("held too", 0.5)] {
            let id = ClaimId {
                question: "q".into(),
                what: what.into(),
                scene: "s".into(),
                spp: None,
                label: "mc".into(),
            };
            push(
                &mut summary,
                Claim {
                    id,
                    sentence: String::new(),
                    effect: interval(value, 0.39),
                    uncorrected: None,
                    scale: Scale::Number,
                    region: Some(Region { low: 0.0, high: 1.0 }),
                    common: 0.0,
                    trials: None,
                    replicates_per_value: 1,
                },
            );
        }
        settle(&mut summary);
        let weak = &summary.claims[0];
        assert_eq!((weak.alone, weak.verdict), (Verdict::Refuted, Verdict::NotShown));
        assert!((weak.p_adjusted.unwrap() / weak.p.unwrap() - 3.0).abs() < 1e-9);
        // At a third of 5 % four replicates of this spread are too few, and not by many.
        assert!(matches!(weak.needed, Needed::Replicates(5..=8)), "{:?}", weak.needed);
        assert_eq!(summary.claims[1].verdict, Verdict::Shown);
        assert_eq!((summary.family.tested, summary.family.refuted_alone), (3, 1));
    }
}
