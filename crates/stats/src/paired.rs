//! Two methods on the same noisy inputs: the unit is the log error ratio, paired over replicates.

use serde::{Deserialize, Serialize};

use crate::interval::mean_and_variance;
use crate::{Interval, Level, ReferenceShare, t_two_sided_p};

/// How one method compares with another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Effect {
    /// Geometric mean of error of a over error of b, or mean of the differences a − b.
    pub interval: Interval,
    /// Whether it is a ratio.
    pub is_ratio: bool,
    /// What the reference contributes to its standard error, of a ratio on its logarithm: all replicates share it.
    pub common: f64,
    /// Two-sided p-value of "no difference" by Student's t; 1 with fewer than two pairs.
    pub p: f64,
    /// Replicates in which at least one of the two is there but not finite: left out like missing ones.
    pub not_finite: u32,
}

/// The ratio if `ratio` asks for one and all paired values are positive, else the difference; see
/// [`paired_ratio`] and [`paired_difference`]. `None` if no replicate has both.
#[must_use]
pub fn paired_effect(
    a: &[Option<f64>],
    b: &[Option<f64>],
    reference: [&ReferenceShare; 2],
    ratio: bool,
    level: Level,
) -> Option<Effect> {
    let as_ratio = if ratio { paired_ratio(a, b, reference, level) } else { None };
    as_ratio.or_else(|| paired_difference(a, b, reference, level))
}

/// Geometric mean over replicates of a/b with its interval: a t-interval of the mean log ratio,
/// exponentiated.
///
/// `reference` is what the common reference contributes to the means of a and of b. Its share in the log ratio is exact to
/// first order where the influences of its parts are known: what two methods have in common cancels, and what moves them
/// against each other adds up. Else the two count as independent, see [`ReferenceShare::combined`]. `None` if no replicate
/// has both or a value is not positive.
#[must_use]
pub fn paired_ratio(
    a: &[Option<f64>],
    b: &[Option<f64>],
    reference: [&ReferenceShare; 2],
    level: Level,
) -> Option<Effect> {
    let pairs = pairs(a, b);
    if pairs.iter().any(|&(a, b)| a <= 0.0 || b <= 0.0) {
        return None;
    }
    let logs: Vec<f64> = pairs.iter().map(|(a, b)| a.ln() - b.ln()).collect();
    let n = pairs.len() as f64; // if it is zero, `effect` returns `None`
    let (sum_a, sum_b) = pairs.iter().fold((0.0, 0.0), |(x, y), (a, b)| (x + a, y + b));
    // Sums of positive values.
    let common = ReferenceShare::combined(&[(n / sum_a, reference[0]), (-n / sum_b, reference[1])]);
    let found = effect(&logs, common.standard_error, level)?;
    Some(Effect { interval: found.interval.exp(), is_ratio: true, not_finite: not_finite(a, b), ..found })
}

/// Mean over replicates of a − b with its t-interval, what the reference contributes to a difference in quadrature; `None`
/// if no replicate has both.
#[must_use]
pub fn paired_difference(
    a: &[Option<f64>],
    b: &[Option<f64>],
    reference: [&ReferenceShare; 2],
    level: Level,
) -> Option<Effect> {
    let differences: Vec<f64> = pairs(a, b).iter().map(|(a, b)| a - b).collect();
    let common = ReferenceShare::combined(&[(1.0, reference[0]), (-1.0, reference[1])]);
    let found = effect(&differences, common.standard_error, level)?;
    Some(Effect { not_finite: not_finite(a, b), ..found })
}

fn pairs(a: &[Option<f64>], b: &[Option<f64>]) -> Vec<(f64, f64)> {
    let finite = |v: &Option<f64>| v.filter(|v| v.is_finite());
    a.iter().zip(b).filter_map(|(a, b)| Some((finite(a)?, finite(b)?))).collect()
}

/// Replicates of which a value is there and not finite.
fn not_finite(a: &[Option<f64>], b: &[Option<f64>]) -> u32 {
    let bad = |v: &Option<f64>| v.is_some_and(|v| !v.is_finite());
    a.iter().zip(b).filter(|(a, b)| bad(a) || bad(b)).count() as u32
}

pub(crate) fn effect(values: &[f64], common: f64, level: Level) -> Option<Effect> {
    let (mean, variance) = mean_and_variance(values)?;
    let n = values.len();
    if n < 2 {
        return Some(Effect {
            interval: Interval::point(mean, level),
            is_ratio: false,
            common,
            p: 1.0,
            not_finite: 0,
        });
    }
    let degrees = n as u64 - 1;
    let se = (variance / n as f64).sqrt().hypot(common);
    let p = match (mean == 0.0 || !(mean.is_finite() && se.is_finite()), se > 0.0) {
        (true, _) => 1.0,
        (false, true) => t_two_sided_p(mean / se, degrees),
        (false, false) => 0.0,
    };
    let interval = Interval::symmetric(mean, se, level, Some(degrees), n as u32);
    Some(Effect { interval, is_ratio: false, common, p, not_finite: 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEVEL: Level = Level::TWO_SIDED_95;
    const NONE: ReferenceShare = ReferenceShare { standard_error: 0.0, parts: Vec::new(), product: 0.0 };
    const EXACT: [&ReferenceShare; 2] = [&NONE, &NONE];

    fn some(values: &[f64]) -> Vec<Option<f64>> {
        values.iter().copied().map(Some).collect()
    }

    #[test]
    fn ratio_is_the_geometric_mean_over_pairs() {
        let e = paired_ratio(&some(&[2.0, 8.0]), &some(&[1.0, 1.0]), EXACT, LEVEL).unwrap();
        assert!((e.interval.value - 4.0).abs() < 1e-12);
        // Log ratios ln 2 and ln 8: standard error ln 2, t with one degree of freedom = 1/ln 2·ln 4 = 2.
        assert!((e.p - 2.0 * (0.5 - 2f64.atan() / std::f64::consts::PI)).abs() < 1e-9, "{}", e.p);
        let with_common =
            paired_ratio(&some(&[2.0, 8.0]), &some(&[1.0, 1.0]), [&0.5.into(), &NONE], LEVEL).unwrap();
        let se = (2f64.ln().powi(2) + 0.01).sqrt() * 4.0;
        assert!((with_common.interval.standard_error.unwrap() - se).abs() < 1e-9);
    }

    #[test]
    fn differences_replace_ratios_where_an_error_is_not_positive() {
        let (a, b) = (some(&[-0.5, 1.0, 1.5]), some(&[1.0, 2.0, 3.0]));
        let e = paired_effect(&a, &b, EXACT, true, LEVEL).unwrap();
        assert!(!e.is_ratio);
        assert!((e.interval.value + 4.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn only_replicates_with_both_are_paired() {
        let a = [Some(1.0), None, Some(4.0)];
        let b = [Some(1.0), Some(9.0), None];
        let e = paired_effect(&a, &b, EXACT, true, LEVEL).unwrap();
        assert_eq!((e.interval.n, e.interval.low, e.p), (1, None, 1.0));
        assert!(paired_effect(&a[1..2], &b[1..2], EXACT, true, LEVEL).is_none());
    }

    #[test]
    fn values_that_are_not_finite_are_missing_and_counted() {
        let a = some(&[1.0, f64::NAN, 4.0, 2.0]);
        let b = [Some(1.0), Some(2.0), None, Some(f64::INFINITY)];
        let e = paired_effect(&a, &b, EXACT, true, LEVEL).unwrap();
        assert_eq!((e.interval.n, e.p, e.not_finite), (1, 1.0, 2), "one pair is left: nothing can be told");
        let clean = paired_effect(&some(&[1.0, 4.0]), &some(&[2.0, 9.0]), EXACT, true, LEVEL).unwrap();
        let holed = paired_effect(&some(&[1.0, f64::NAN, 4.0]), &some(&[2.0, 5.0, 9.0]), EXACT, true, LEVEL);
        assert_eq!(holed, Some(Effect { not_finite: 1, ..clean }));
        assert_eq!(paired_effect(&some(&[f64::NAN]), &some(&[1.0]), EXACT, true, LEVEL), None);
        // The sum overflows: no number, so no verdict.
        let huge = paired_difference(&some(&[1e308, 1e308]), &some(&[-1e308, -1e308]), EXACT, LEVEL);
        assert!(huge.is_none_or(|e| e.p == 1.0));
    }

    #[test]
    fn a_common_reference_cancels_where_methods_err_alike_and_adds_where_they_do_not() {
        let share = |l: f64| ReferenceShare { standard_error: l.abs(), parts: vec![l], product: 0.0 };
        let (a, b) = (some(&[2.0, 2.0]), some(&[1.0, 1.0]));
        let se = |x: f64, y: f64| {
            let e = paired_ratio(&a, &b, [&share(x), &share(y)], LEVEL).unwrap();
            e.interval.standard_error.unwrap() / e.interval.value
        };
        assert!(se(0.2, 0.1) < 1e-15, "the same relative influence");
        assert!((se(0.2, -0.1) - 0.2).abs() < 1e-15);
        let apart = paired_ratio(&a, &b, [&0.2.into(), &0.1.into()], LEVEL).unwrap().interval;
        assert!((apart.standard_error.unwrap() / apart.value - 0.1 * 2f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn equal_inputs_cannot_be_told_apart_and_constant_offsets_can() {
        let a = some(&[1.0, 2.0, 3.0]);
        assert_eq!(paired_effect(&a, &a, EXACT, true, LEVEL).unwrap().p, 1.0);
        let b = some(&[2.0, 3.0, 4.0]);
        assert_eq!(paired_difference(&a, &b, EXACT, LEVEL).unwrap().p, 0.0);
    }
}
