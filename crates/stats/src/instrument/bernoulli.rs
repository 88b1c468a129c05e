//! What intervals of events that happen or do not must do, exactly.

use serde::{Deserialize, Serialize};

use crate::pmf::binomial;
use crate::{Level, TTable};

/// Exact probabilities of a t-interval of n samples that are 1 with probability q and else 0.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BernoulliCoverage {
    /// Covered, with s > 0.
    pub covered: f64,
    /// With s > 0 and the whole interval below q.
    pub truth_above: f64,
    /// With s > 0 and the whole interval above q.
    pub truth_below: f64,
    /// All samples are 0, or all are 1: s = 0, and the interval is a point beside q. (1−q)ⁿ + qⁿ.
    pub missed: f64,
}

/// Probability that all `n` samples miss an event of probability `q` in [0, 1]: (1−q)ⁿ.
#[must_use]
pub fn missed_by_all(q: f64, n: u32) -> f64 {
    (f64::from(n) * (-q.clamp(0.0, 1.0)).ln_1p()).exp()
}

/// Coverage of x̄ ± t·s/√n by enumeration of all counts of events; `None` below 2 samples, above a million (each count
/// is visited), and for a `q` that is not inside (0, 1), where nothing varies.
///
/// What pixels of a known scene show must agree with it, as independent trials do: counting s = 0 as covered turns 7.8 % at
/// q = 0.02, n = 4 into 100 %.
#[must_use]
pub fn bernoulli_coverage(q: f64, n: u32, level: Level) -> Option<BernoulliCoverage> {
    if !((2..=1_000_000).contains(&n) && q > 0.0 && q < 1.0) {
        return None;
    }
    let t = TTable::new(level, n).at(n);
    let count = f64::from(n);
    let mut out = BernoulliCoverage { covered: 0.0, truth_above: 0.0, truth_below: 0.0, missed: 0.0 };
    for k in 0..=u64::from(n) {
        let chance = binomial(k, u64::from(n), q, 1.0 - q);
        let mean = k as f64 / count;
        // s²/n = x̄(1−x̄)/(n−1).
        let half = t * (mean * (1.0 - mean) / (count - 1.0)).sqrt();
        let of = match () {
            () if k == 0 || k == u64::from(n) => &mut out.missed,
            () if q - mean > half => &mut out.truth_above,
            () if mean - q > half => &mut out.truth_below,
            () => &mut out.covered,
        };
        *of += chance;
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missed_events_are_those_of_the_power_law() {
        for (n, missed) in [(4, 0.922_368), (16, 0.723_798), (64, 0.274_454), (256, 0.005_674)] {
            assert!((missed_by_all(0.02, n) - missed).abs() < 5e-7, "{n}");
        }
        assert_eq!((missed_by_all(0.0, 9), missed_by_all(1.0, 9)), (1.0, 0.0));
    }

    #[test]
    fn coverage_is_that_of_the_enumeration_elsewhere() {
        let levels = [Level::TWO_SIDED_95, Level::TWO_SIDED_99, Level::TWO_SIDED_998];
        let pinned = [
            (0.02, 4, [0.077_632; 3]),
            (0.02, 16, [0.276_191, 0.276_202, 0.276_202]),
            (0.02, 64, [0.723_767, 0.725_541, 0.725_546]),
            (0.02, 256, [0.881_585, 0.964_443, 0.964_678]),
            (0.1, 4, [0.343_800; 3]),
            (0.1, 16, [0.811_401, 0.814_637, 0.814_698]),
            (0.1, 64, [0.951_172, 0.960_646, 0.990_427]),
        ];
        for (q, n, expected) in pinned {
            for (level, covered) in levels.into_iter().zip(expected) {
                let found = bernoulli_coverage(q, n, level).unwrap();
                assert!((found.covered - covered).abs() < 6e-7, "{q} {n} {level:?}: {found:?}");
                let all = found.covered + found.truth_above + found.truth_below + found.missed;
                assert!((all - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn what_does_not_vary_has_no_coverage() {
        for (q, n) in [(0.0, 4), (1.0, 4), (f64::NAN, 4), (0.5, 1), (0.5, 1_000_001)] {
            assert_eq!(bernoulli_coverage(q, n, Level::TWO_SIDED_95), None);
        }
    }
}
