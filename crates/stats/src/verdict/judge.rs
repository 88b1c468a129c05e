use super::evidence::Evidence;
use super::needed::{Needed, needed};
use super::region::Region;
use super::word::Verdict;

/// A verdict with what it stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged {
    /// By its own interval, no other claim considered.
    pub alone: Verdict,
    /// Two-sided p-value of the claim: 1 where an estimate lies in the region; none without an interval.
    pub p: Option<f64>,
    /// What would decide it.
    pub needed: Needed,
}

/// Judges one claim by itself.
#[must_use]
pub fn judge(effect: &Evidence, region: Region) -> Judged {
    let finite = |ends: &[f64; 2]| ends.iter().chain(&effect.estimate).all(|v| v.is_finite());
    // One image says nothing of other random seeds, whatever its own spread.
    let Some(ends) = effect.ends.filter(|ends| effect.replicates >= 2 && finite(ends)) else {
        return Judged { alone: Verdict::NotShown, p: None, needed: Needed::Interval };
    };
    let alone = if region.holds(ends) {
        Verdict::Shown
    } else if region.misses(ends) {
        Verdict::Refuted
    } else {
        Verdict::NotShown
    };
    let needed = match alone {
        Verdict::NotShown => needed(effect, region),
        Verdict::Shown | Verdict::Refuted => Needed::Nothing,
    };
    Judged { alone, p: Some(effect.p_of(region.distance(effect.estimate))), needed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Interval, Level, proportion_interval, replicate_interval};

    fn rate(rates: &[f64], trials: u64) -> Evidence {
        Evidence::of(&proportion_interval(rates, trials, Level::TWO_SIDED_95).unwrap(), 0.0)
            .with_trials(trials)
    }

    #[test]
    fn an_interval_in_its_region_shows_outside_refutes_and_else_does_neither() {
        let region = Region::coverage(0.95);
        let of = |rates: &[f64]| judge(&rate(rates, 4000), region).alone;
        assert_eq!(of(&[0.949, 0.951, 0.950, 0.9505]), Verdict::Shown);
        assert_eq!(of(&[0.88, 0.885, 0.882, 0.881]), Verdict::Refuted);
        assert_eq!(of(&[0.999, 1.0, 0.998, 1.0]), Verdict::Refuted, "too wide an interval is none of 95 %");
        assert_eq!(of(&[0.93, 0.96, 0.95, 0.95]), Verdict::NotShown);
        assert_eq!(of(&[0.95]), Verdict::NotShown, "one number without an interval");
        let within = Interval::symmetric(0.5, 1e-6, Level::TWO_SIDED_95, None, 1);
        let judged = judge(&Evidence::of(&within, 0.0), region);
        assert_eq!(
            (judged.alone, judged.p, judged.needed),
            (Verdict::NotShown, None, Needed::Interval),
            "an interval from within one image"
        );
        assert_eq!(of(&[1.0; 4]), Verdict::Refuted);
    }

    #[test]
    fn the_p_value_agrees_with_the_interval() {
        // The interval of these ends at the region's edge when the region is put there.
        let interval = replicate_interval(&[1.0, 1.2, 0.9, 1.1], 0.0, Level::TWO_SIDED_95).unwrap();
        let effect = Evidence::of(&interval, 0.0);
        let edge = interval.high.unwrap();
        let judged = judge(&effect, Region { low: edge, high: 9.0 });
        assert!((judged.p.unwrap() - 0.05).abs() < 1e-9);
        assert_eq!(judge(&effect, Region { low: edge + 1e-9, high: 9.0 }).alone, Verdict::Refuted);
        assert_eq!(judge(&effect, Region { low: edge - 1e-9, high: 9.0 }).alone, Verdict::NotShown);
        assert_eq!(judge(&effect, Region { low: 0.0, high: 9.0 }).p, Some(1.0));
    }

    #[test]
    fn replicates_that_agree_are_judged_by_their_trials() {
        // None of 1000 where 2 % are claimed at least: 2·0.98^1000.
        let judged = judge(&rate(&[0.0; 4], 1000), Region { low: 0.02, high: 1.0 });
        let exact = 2.0 * 0.98f64.powi(1000);
        assert!((judged.p.unwrap() / exact - 1.0).abs() < 1e-9);
        assert_eq!(judged.alone, Verdict::Refuted);
        let few = judge(&rate(&[0.0; 4], 40), Region { low: 0.02, high: 1.0 });
        assert_eq!(few.alone, Verdict::NotShown, "none of 40 is no evidence against 2 %");
    }

    #[test]
    fn a_bracket_is_shown_only_if_both_of_its_ends_are() {
        let corrected = rate(&[0.951, 0.950, 0.949, 0.950], 4000);
        let raw = rate(&[0.921, 0.920, 0.919, 0.920], 4000);
        let region = Region::coverage(0.95);
        let both = judge(&corrected.or(&raw), region);
        assert_eq!((both.alone, both.p), (Verdict::NotShown, Some(1.0)));
        assert_eq!(both.needed, Needed::Reference);
        assert_eq!(judge(&raw, region).alone, Verdict::Refuted);
    }

    #[test]
    fn ratios_are_judged_on_their_logarithms() {
        let log = replicate_interval(&[0.1, -0.1, 0.05, -0.05], 0.0, Level::TWO_SIDED_95).unwrap();
        let effect = Evidence::of_log_ratio(&log.exp(), 0.0).unwrap();
        assert!((effect.standard_error - log.standard_error.unwrap()).abs() < 1e-12);
        assert_eq!(judge(&effect, Region::ESTIMATE.ln().unwrap()).alone, Verdict::Shown);
        let negative = replicate_interval(&[0.1, -0.3], 0.0, Level::TWO_SIDED_95).unwrap();
        assert_eq!(Evidence::of_log_ratio(&negative, 0.0), None);
    }

    #[test]
    fn an_estimate_of_nought_to_three_hundred_is_not_called_calibrated() {
        let interval =
            Interval { low: Some(1e-9), high: Some(310.0), ..Interval::point(0.0165, Level::TWO_SIDED_95) };
        let effect = Evidence::of_log_ratio(&Interval { n: 4, ..interval }, 0.0).unwrap();
        assert_eq!(judge(&effect, Region::ESTIMATE.ln().unwrap()).alone, Verdict::NotShown);
    }
}
