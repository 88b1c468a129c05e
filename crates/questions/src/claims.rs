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
}

impl Claim {
    /// By itself.
    pub(crate) fn judged(&self) -> Judged {
        let region = match self.scale {
            Scale::Ratio => self.region.and_then(Region::ln),
            Scale::Share | Scale::Number => self.region,
        };
        let evidence = self.evidence(&self.effect);
        let both = match &self.uncorrected {
            None => evidence,
            Some(raw) => evidence.zip(self.evidence(raw)).map(|(own, raw)| own.or(&raw)),
        };
        match both.zip(region) {
            Some((evidence, region)) => judge(&evidence, region),
            // A ratio that is not positive, or none at all.
            None => Judged { alone: Verdict::NotShown, p: None, needed: Needed::Reference },
        }
    }

    fn evidence(&self, effect: &Interval) -> Option<Evidence> {
        let interval = stats::Interval {
            value: effect.value,
            standard_error: effect.standard_error,
            low: effect.low,
            high: effect.high,
            level: LEVEL,
            n: effect.n,
        };
        match self.scale {
            Scale::Ratio => Evidence::of_log_ratio(&interval, self.common),
            Scale::Share | Scale::Number => {
                let out = Evidence::of(&interval, self.common);
                Some(Evidence { trials: self.trials, ..out })
            }
        }
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
    }
    summary.family = ClaimFamily {
        tested: family.tested,
        refuted_alone: family.refuted_alone,
        by_chance: family.by_chance,
    };
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
                },
            );
        }
        settle(&mut summary);
        let weak = &summary.claims[0];
        assert_eq!((weak.alone, weak.verdict), (Verdict::Refuted, Verdict::NotShown));
        assert!((weak.p_adjusted.unwrap() / weak.p.unwrap() - 3.0).abs() < 1e-9);
        assert_eq!(summary.claims[1].verdict, Verdict::Shown);
        assert_eq!((summary.family.tested, summary.family.refuted_alone), (3, 1));
    }
}
