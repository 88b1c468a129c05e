use serde::{Deserialize, Serialize};

use super::evidence::Evidence;
use super::region::Region;
use crate::{Level, normal_quantile};

/// What would decide a claim that is not shown, if the estimate stays where it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "what", content = "count")]
pub enum Needed {
    /// It is decided.
    Nothing,
    /// An interval over replicates: a second one.
    Interval,
    /// So many replicates.
    Replicates(u32),
    /// A longer reference: its noise alone is more than the distance to a decision.
    Reference,
    /// More replicates than anybody renders: the estimate lies at the edge of the region.
    TooMany,
    /// Another estimate: this one is no positive ratio, which is what is claimed of it.
    Ratio,
}

/// Beyond this nobody goes.
const MOST: u32 = 10_000;

/// What would let a refutation stand beside other claims that multiply its p-value by `multiplier` (Holm 1979), which is at
/// least 1.
#[must_use]
pub fn needed_beside(effect: &Evidence, region: Region, multiplier: f64) -> Needed {
    // α is in (0, 1), and so is a part of it.
    let level = Level::two_sided(1.0 - effect.level.alpha() / multiplier.max(1.0)).unwrap_or(effect.level);
    needed(&Evidence { level, ..*effect }, region)
}

/// The replicates at which the interval is as wide as the margin: t·√(s²/R + common²), s² what replicates add.
pub(super) fn needed(effect: &Evidence, region: Region) -> Needed {
    let Some(margin) = region.margin(effect.estimate) else { return Needed::Reference };
    if effect.replicates < 2 {
        return Needed::Interval;
    }
    if normal_quantile(effect.level) * effect.common > margin {
        return Needed::Reference;
    }
    if let Some(trials) = effect.trials.filter(|trials| *trials > 0 && effect.standard_error == 0.0) {
        return needed_trials(effect, margin, trials);
    }
    // At least 0: the common part is one of the two whose squares make the standard error.
    let own = (effect.standard_error.powi(2) - effect.common.powi(2)).max(0.0) * f64::from(effect.replicates);
    let wide = |replicates: u32| {
        let se = (own / f64::from(replicates)).sqrt().hypot(effect.common);
        effect.critical(replicates) * se > margin
    };
    if wide(MOST) {
        return Needed::TooMany;
    }
    // The width falls with the replicates: the first that is enough lies between these.
    let (mut few, mut enough) = (effect.replicates, MOST);
    while enough - few > 1 {
        let middle = few + (enough - few) / 2;
        if wide(middle) { few = middle } else { enough = middle }
    }
    Needed::Replicates(enough)
}

/// Of a rate that is 0 or 1 in all replicates: as many as have the trials whose exact limit is the margin,
/// (1−margin)^trials = α/2.
fn needed_trials(effect: &Evidence, margin: f64, trials: u64) -> Needed {
    if margin <= 0.0 {
        return Needed::TooMany;
    }
    if margin >= 1.0 {
        return Needed::Replicates(effect.replicates + 1);
    }
    let enough = (0.5 * effect.level.alpha()).ln() / (-margin).ln_1p();
    let replicates = (enough * f64::from(effect.replicates) / trials as f64).ceil();
    if replicates > f64::from(MOST) {
        return Needed::TooMany;
    }
    Needed::Replicates((replicates as u32).max(effect.replicates + 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{proportion_interval, replicate_interval, t_quantile};

    #[test]
    fn rates_that_agree_need_as_many_trials_as_their_exact_limit_says() {
        let interval = proportion_interval(&[1.0; 4], 20, Level::TWO_SIDED_95).unwrap();
        let effect = Evidence::of(&interval, 0.0).with_trials(20);
        // 0.955^n ≤ 0.025 from 81 on: at 5 a replicate, 17 replicates.
        let region = Region { low: 0.945, high: 0.955 };
        assert_eq!(needed(&effect, region), Needed::Replicates(17));
        assert_eq!(needed(&effect, Region { low: 0.5, high: 1.0 }), Needed::TooMany, "at the very edge");
    }

    #[test]
    fn a_refutation_needs_more_replicates_the_more_claims_stand_beside_it() {
        let interval = replicate_interval(&[0.9, 1.1, 1.05, 0.95], 0.0, Level::TWO_SIDED_95).unwrap();
        let (effect, region) = (Evidence::of(&interval, 0.0), Region { low: 1.2, high: 2.0 });
        let count = |multiplier: f64| match needed_beside(&effect, region, multiplier) {
            Needed::Replicates(count) => count,
            other => panic!("{other:?}"),
        };
        let spread = interval.standard_error.unwrap() * 2.0;
        let p = |n: u32| crate::t_two_sided_p(0.2 / (spread / f64::from(n).sqrt()), u64::from(n) - 1);
        for multiplier in [10.0, 200.0] {
            let n = count(multiplier);
            assert!(p(n) * multiplier <= 0.05 && p(n - 1) * multiplier > 0.05, "{multiplier}: {n}");
        }
        assert!(count(200.0) > count(10.0));
    }

    #[test]
    fn as_many_replicates_are_needed_as_make_the_interval_as_wide_as_the_margin() {
        let level = Level::TWO_SIDED_95;
        let interval = replicate_interval(&[0.9, 1.1, 1.05, 0.95], 0.0, level).unwrap();
        let effect = Evidence::of(&interval, 0.0);
        let Needed::Replicates(count) = needed(&effect, Region { low: 0.95, high: 2.0 }) else { panic!() };
        let spread = interval.standard_error.unwrap() * 2.0;
        let half = |n: u32| t_quantile(level, u64::from(n) - 1) * spread / f64::from(n).sqrt();
        assert!(half(count) <= 0.05 && half(count - 1) > 0.05, "{count}");
    }

    #[test]
    fn no_replicates_help_against_the_noise_of_the_reference() {
        let interval = replicate_interval(&[0.9, 1.1, 1.05, 0.95], 0.2, Level::TWO_SIDED_95).unwrap();
        let region = Region { low: 0.95, high: 2.0 };
        assert_eq!(needed(&Evidence::of(&interval, 0.2), region), Needed::Reference);
        let one = replicate_interval(&[1.0], 0.0, Level::TWO_SIDED_95).unwrap();
        assert_eq!(needed(&Evidence::of(&one, 0.0), region), Needed::Interval);
        let edge = Region { low: 1.0 - 1e-9, high: 2.0 };
        let interval = replicate_interval(&[0.9, 1.1, 1.05, 0.95], 0.0, Level::TWO_SIDED_95).unwrap();
        assert_eq!(needed(&Evidence::of(&interval, 0.0), edge), Needed::TooMany);
    }

    #[test]
    fn a_noise_that_replicates_share_asks_for_more_of_them() {
        let values = [0.9, 1.1, 1.05, 0.95];
        let count = |common: f64| {
            let interval = replicate_interval(&values, common, Level::TWO_SIDED_95).unwrap();
            match needed(&Evidence::of(&interval, common), Region { low: 0.95, high: 2.0 }) {
                Needed::Replicates(count) => count,
                other => panic!("{other:?}"),
            }
        };
        // t·√(s²/R + c²) ≤ 0.05, with the spread s² of the four values.
        let own = 0.05f64 / 6.0;
        let wide = |n: u32, c: f64| {
            t_quantile(Level::TWO_SIDED_95, u64::from(n) - 1) * (own / f64::from(n) + c * c).sqrt() > 0.05
        };
        for common in [0.0, 0.02] {
            let enough = count(common);
            assert!(!wide(enough, common) && wide(enough - 1, common), "{common}: {enough}");
        }
        assert!(count(0.02) > count(0.0));
    }
}
