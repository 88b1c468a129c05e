//! Shown, refuted, or not shown: one rule for every verdict of a report.
//!
//! A claim is a region in which an effect should lie; what was measured is an interval. The claim is *shown* if the interval
//! lies in the region, *refuted* if it lies outside, and *not shown* otherwise: lack of evidence is no success. All verdicts of
//! a report are one family, whose refutations are adjusted by Holm's rule ([`Verdicts`]).

mod needed;
mod region;
mod verdicts;

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{Interval, Level, normal_quantile, normal_two_sided_p, t_quantile, t_two_sided_p};

pub use needed::Needed;
pub use region::Region;
pub use verdicts::Verdicts;

/// What the data say of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The interval of the effect lies in the claim's region.
    Shown,
    /// It lies outside.
    Refuted,
    /// Neither, or there is no interval.
    NotShown,
}

impl Verdict {
    /// The word for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Shown => "shown",
            Self::Refuted => "refuted",
            Self::NotShown => "not shown",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An effect as it was measured, on the scale of its claim's region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// The estimate; two numbers where it depends on something that the data do not decide, such as an allowance for the
    /// reference's noise, the smaller first.
    pub estimate: [f64; 2],
    /// Ends of its interval, over both estimates; none without one.
    pub ends: Option<[f64; 2]>,
    /// Standard error, common part included.
    pub standard_error: f64,
    /// Part of the standard error that more replicates do not take away, such as the reference's.
    pub common: f64,
    /// Replicates; below 2 the standard error is from within one image.
    pub replicates: u32,
    /// Independent trials, for a rate: they say something where all replicates show the same rate of 0 or 1.
    pub trials: Option<u64>,
    /// Level of the interval.
    pub level: Level,
}

impl Evidence {
    /// An effect whose interval is symmetric or of a rate. `common` as in [`Evidence::common`].
    #[must_use]
    pub fn of(interval: &Interval, common: f64) -> Self {
        Self {
            estimate: [interval.value; 2],
            ends: interval.low.zip(interval.high).map(|(low, high)| [low, high]),
            standard_error: interval.standard_error.unwrap_or(0.0),
            common,
            replicates: interval.n,
            trials: None,
            level: interval.level,
        }
    }

    /// The logarithm of a positive ratio, whose interval is symmetric on that scale; `common` is on it, too. `None` where
    /// the ratio or an end is not positive.
    #[must_use]
    pub fn of_log_ratio(interval: &Interval, common: f64) -> Option<Self> {
        let positive = |v: f64| v > 0.0 && v.is_finite();
        let ends = interval.low.zip(interval.high).map(|(low, high)| [low, high]);
        if !positive(interval.value) || ends.is_some_and(|ends| !ends.into_iter().all(positive)) {
            return None;
        }
        let ends = ends.map(|ends| ends.map(f64::ln));
        let mut out = Self {
            estimate: [interval.value.ln(); 2],
            ends,
            standard_error: 0.0,
            common,
            replicates: interval.n,
            trials: None,
            level: interval.level,
        };
        // The half-width is the critical value, which is positive, times the standard error.
        out.standard_error =
            ends.map_or(0.0, |[low, high]| 0.5 * (high - low) / out.critical(out.replicates));
        Some(out)
    }

    /// The same with the trials of a rate behind it.
    #[must_use]
    pub fn with_trials(self, trials: u64) -> Self {
        Self { trials: Some(trials), ..self }
    }

    /// This estimate or that one: everything between is possible.
    #[must_use]
    pub fn or(self, other: &Self) -> Self {
        let span = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self {
            estimate: span(self.estimate, other.estimate),
            ends: self.ends.zip(other.ends).map(|(a, b)| span(a, b)),
            standard_error: self.standard_error.max(other.standard_error),
            common: self.common.max(other.common),
            ..self
        }
    }

    /// Critical value over so many replicates; that of the normal distribution within one image.
    fn critical(&self, replicates: u32) -> f64 {
        if replicates < 2 {
            normal_quantile(self.level)
        } else {
            t_quantile(self.level, u64::from(replicates) - 1)
        }
    }

    /// Two-sided p-value of a distance from the effect, consistent with its interval.
    fn p_of(&self, distance: f64) -> f64 {
        if distance <= 0.0 {
            return 1.0;
        }
        if self.standard_error > 0.0 {
            let statistic = distance / self.standard_error;
            return match self.replicates {
                0 | 1 => normal_two_sided_p(statistic),
                n => t_two_sided_p(statistic, u64::from(n) - 1),
            };
        }
        // All replicates agree. A rate of 0 or 1 over so many independent trials has the exact limit d at the two-sided
        // level α = 2·(1−d)^trials; anything else that does not vary is what it is.
        match self.trials {
            Some(trials) if distance < 1.0 => (2.0 * ((-distance).ln_1p() * trials as f64).exp()).min(1.0),
            _ => 0.0,
        }
    }
}

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
    let Some(ends) = effect.ends.filter(|ends| ends.iter().chain(&effect.estimate).all(|v| v.is_finite()))
    else {
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
        Verdict::NotShown => needed::needed(effect, region),
        Verdict::Shown | Verdict::Refuted => Needed::Nothing,
    };
    Judged { alone, p: Some(effect.p_of(region.distance(effect.estimate))), needed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{proportion_interval, replicate_interval};

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
