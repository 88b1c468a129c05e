//! Two methods on the same noisy inputs: the unit is the log error ratio, paired over replicates.

use serde::{Deserialize, Serialize};

use crate::interval::mean_and_variance;
use crate::{Interval, Level, t_two_sided_p};

/// How one method compares with another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Effect {
    /// Geometric mean of error of a over error of b, or mean of the differences a − b.
    pub interval: Interval,
    /// Whether it is a ratio.
    pub is_ratio: bool,
    /// Two-sided p-value of "no difference" by Student's t; 1 with fewer than two pairs.
    pub p: f64,
}

/// The ratio if `ratio` asks for one and all paired values are positive, else the difference; see
/// [`paired_ratio`] and [`paired_difference`]. `None` if no replicate has both.
#[must_use]
pub fn paired_effect(
    a: &[Option<f64>],
    b: &[Option<f64>],
    common_se: [f64; 2],
    ratio: bool,
    level: Level,
) -> Option<Effect> {
    let as_ratio = if ratio { paired_ratio(a, b, common_se, level) } else { None };
    as_ratio.or_else(|| paired_difference(a, b, common_se, level))
}

/// Geometric mean over replicates of a/b with its interval: a t-interval of the mean log ratio,
/// exponentiated.
///
/// `common_se` are the standard errors that all replicates of a and of b share (the reference's
/// contribution); relative to the means they are added in quadrature, as if independent of each other: two
/// methods that err alike share them, so this errs on the wide side. `None` if no replicate has both or a
/// value is not positive.
#[must_use]
pub fn paired_ratio(
    a: &[Option<f64>],
    b: &[Option<f64>],
    common_se: [f64; 2],
    level: Level,
) -> Option<Effect> {
    let pairs = pairs(a, b);
    if pairs.iter().any(|&(a, b)| a <= 0.0 || b <= 0.0) {
        return None;
    }
    let logs: Vec<f64> = pairs.iter().map(|(a, b)| a.ln() - b.ln()).collect();
    let n = pairs.len() as f64; // if it is zero, `effect` returns `None`
    let (sum_a, sum_b) = pairs.iter().fold((0.0, 0.0), |(x, y), (a, b)| (x + a, y + b));
    let common = (common_se[0] * n / sum_a).hypot(common_se[1] * n / sum_b); // sums of positive values
    effect(&logs, common, level).map(|e| Effect { interval: e.interval.exp(), is_ratio: true, ..e })
}

/// Mean over replicates of a − b with its t-interval, `common_se` in quadrature; `None` if no replicate has
/// both.
#[must_use]
pub fn paired_difference(
    a: &[Option<f64>],
    b: &[Option<f64>],
    common_se: [f64; 2],
    level: Level,
) -> Option<Effect> {
    let differences: Vec<f64> = pairs(a, b).iter().map(|(a, b)| a - b).collect();
    effect(&differences, common_se[0].hypot(common_se[1]), level)
}

fn pairs(a: &[Option<f64>], b: &[Option<f64>]) -> Vec<(f64, f64)> {
    a.iter().zip(b).filter_map(|(a, b)| Some(((*a)?, (*b)?))).collect()
}

fn effect(values: &[f64], common: f64, level: Level) -> Option<Effect> {
    let (mean, variance) = mean_and_variance(values)?;
    let n = values.len();
    if n < 2 {
        return Some(Effect { interval: Interval::point(mean, level), is_ratio: false, p: 1.0 });
    }
    let degrees = n as u64 - 1;
    let se = (variance / n as f64).sqrt().hypot(common);
    let p = match (mean == 0.0, se > 0.0) {
        (true, _) => 1.0,
        (false, true) => t_two_sided_p(mean / se, degrees),
        (false, false) => 0.0,
    };
    let interval = Interval::symmetric(mean, se, level, Some(degrees), n as u32);
    Some(Effect { interval, is_ratio: false, p })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEVEL: Level = Level::TWO_SIDED_95;

    fn some(values: &[f64]) -> Vec<Option<f64>> {
        values.iter().copied().map(Some).collect()
    }

    #[test]
    fn ratio_is_the_geometric_mean_over_pairs() {
        let e = paired_ratio(&some(&[2.0, 8.0]), &some(&[1.0, 1.0]), [0.0; 2], LEVEL).unwrap();
        assert!((e.interval.value - 4.0).abs() < 1e-12);
        // Log ratios ln 2 and ln 8: standard error ln 2, t with one degree of freedom = 1/ln 2·ln 4 = 2.
        assert!((e.p - 2.0 * (0.5 - 2f64.atan() / std::f64::consts::PI)).abs() < 1e-9, "{}", e.p);
        let with_common = paired_ratio(&some(&[2.0, 8.0]), &some(&[1.0, 1.0]), [0.5, 0.0], LEVEL).unwrap();
        let se = (2f64.ln().powi(2) + 0.01).sqrt() * 4.0;
        assert!((with_common.interval.standard_error.unwrap() - se).abs() < 1e-9);
    }

    #[test]
    fn differences_replace_ratios_where_an_error_is_not_positive() {
        let (a, b) = (some(&[-0.5, 1.0, 1.5]), some(&[1.0, 2.0, 3.0]));
        let e = paired_effect(&a, &b, [0.0; 2], true, LEVEL).unwrap();
        assert!(!e.is_ratio);
        assert!((e.interval.value + 4.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn only_replicates_with_both_are_paired() {
        let a = [Some(1.0), None, Some(4.0)];
        let b = [Some(1.0), Some(9.0), None];
        let e = paired_effect(&a, &b, [0.0; 2], true, LEVEL).unwrap();
        assert_eq!((e.interval.n, e.interval.low, e.p), (1, None, 1.0));
        assert!(paired_effect(&a[1..2], &b[1..2], [0.0; 2], true, LEVEL).is_none());
    }

    #[test]
    fn equal_inputs_cannot_be_told_apart_and_constant_offsets_can() {
        let a = some(&[1.0, 2.0, 3.0]);
        assert_eq!(paired_effect(&a, &a, [0.0; 2], true, LEVEL).unwrap().p, 1.0);
        let b = some(&[2.0, 3.0, 4.0]);
        assert_eq!(paired_difference(&a, &b, [0.0; 2], LEVEL).unwrap().p, 0.0);
    }
}
