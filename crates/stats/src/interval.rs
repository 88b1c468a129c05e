use serde::{Deserialize, Serialize};

use crate::{Level, normal_quantile, t_quantile};

/// A number with its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Point estimate.
    pub value: f64,
    /// Standard error in the unit of the value; absent if it could not be estimated.
    pub standard_error: Option<f64>,
    /// Lower end.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
    /// Level of the ends.
    pub level: Level,
    /// Observations (replicates) behind it.
    pub n: u32,
}

impl Interval {
    /// A number of which no uncertainty is known.
    #[must_use]
    pub fn point(value: f64, level: Level) -> Self {
        Self { value, standard_error: None, low: None, high: None, level, n: 1 }
    }

    /// value ± critical value · standard error, with Student's t for `degrees` degrees of freedom or the
    /// normal quantile if `None`.
    #[must_use]
    pub fn symmetric(value: f64, standard_error: f64, level: Level, degrees: Option<u64>, n: u32) -> Self {
        let critical = degrees.map_or_else(|| normal_quantile(level), |d| t_quantile(level, d));
        let half = critical * standard_error;
        Self {
            value,
            standard_error: Some(standard_error),
            low: Some(value - half),
            high: Some(value + half),
            level,
            n,
        }
    }

    /// The interval of exp(x) if this is that of x; the standard error by the delta method.
    #[must_use]
    pub fn exp(self) -> Self {
        let value = self.value.exp();
        Self {
            value,
            standard_error: self.standard_error.map(|se| se * value),
            low: self.low.map(f64::exp),
            high: self.high.map(f64::exp),
            ..self
        }
    }

    /// Whether the interval is known and does not contain `x`.
    #[must_use]
    pub fn excludes(&self, x: f64) -> bool {
        self.low.is_some_and(|low| low > x) || self.high.is_some_and(|high| high < x)
    }

    /// For an error that is not above what the reference can show (`reference_se` is the standard error that
    /// the reference contributes) or not positive: the upper limit to print instead, as "< limit". `None` if
    /// the value stands for itself, or if nothing positive limits it.
    ///
    /// The limit is the upper end of the interval; without one, max(value, 0) plus the critical value times
    /// `reference_se`; in both cases at least `reference_se`.
    #[must_use]
    pub fn below(&self, reference_se: f64) -> Option<f64> {
        if self.value > 0.0 && self.value >= reference_se {
            return None;
        }
        let limit = self
            .high
            .unwrap_or_else(|| self.value.max(0.0) + normal_quantile(self.level) * reference_se)
            .max(reference_se);
        (limit > 0.0).then_some(limit)
    }
}

/// Mean and unbiased variance, two passes; `None` if empty, variance 0 for one value.
pub(crate) fn mean_and_variance(values: &[f64]) -> Option<(f64, f64)> {
    if values.is_empty() {
        return None;
    }
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let m2: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    Some((mean, if values.len() > 1 { m2 / (n - 1.0) } else { 0.0 }))
}

/// Mean over replicates with its t-interval; `None` if there are no values. Values that are not finite are missing.
///
/// `common_se` is a standard error that all replicates share, such as the reference's contribution: no
/// average removes it, so it is added in quadrature to that over replicates. The critical value stays that of n−1 degrees
/// of freedom: too large where the reference dominates and is better known than a spread of n values, a little too small
/// where it is known from fewer parts than there are replicates. One replicate gives a number without an interval.
#[must_use]
pub fn replicate_interval(values: &[f64], common_se: f64, level: Level) -> Option<Interval> {
    let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    let (mean, variance) = mean_and_variance(&finite)?;
    let n = finite.len();
    let common_se = common_se.max(0.0); // none if it is no number
    if n < 2 {
        return Some(Interval::point(mean, level));
    }
    let se = (variance / n as f64).sqrt().hypot(common_se);
    Some(Interval::symmetric(mean, se, level, Some(n as u64 - 1), n as u32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interval_of_four_numbers_matches_hand_calculation() {
        // Mean 2.5, s² = 5/3, standard error √(5/12) = 0.645497; t(95 %, 3) = 3.182446.
        let i = replicate_interval(&[1.0, 2.0, 3.0, 4.0], 0.0, Level::TWO_SIDED_95).unwrap();
        assert!((i.standard_error.unwrap() - 0.645_497).abs() < 1e-6);
        assert!((i.low.unwrap() - 0.445_739).abs() < 1e-5 && (i.high.unwrap() - 4.554_261).abs() < 1e-5);
        let wider = replicate_interval(&[1.0, 2.0, 3.0, 4.0], 0.645_497, Level::TWO_SIDED_95).unwrap();
        assert!((wider.standard_error.unwrap() - 0.645_497 * 2f64.sqrt()).abs() < 1e-6);
    }

    #[test]
    fn one_replicate_has_no_interval() {
        let i = replicate_interval(&[7.0], 0.3, Level::TWO_SIDED_95).unwrap();
        assert_eq!((i.value, i.standard_error, i.low, i.n), (7.0, None, None, 1));
        assert!(replicate_interval(&[], 0.0, Level::TWO_SIDED_95).is_none());
    }

    #[test]
    fn values_that_are_not_finite_are_missing() {
        let level = Level::TWO_SIDED_95;
        let holed = replicate_interval(&[1.0, f64::NAN, 3.0, f64::INFINITY], f64::NAN, level);
        assert_eq!(holed, replicate_interval(&[1.0, 3.0], 0.0, level));
        assert_eq!(replicate_interval(&[f64::NAN], 0.0, level), None);
    }

    #[test]
    fn values_below_the_floor_become_upper_limits() {
        let level = Level::TWO_SIDED_95;
        let with = |value, high| Interval { high, ..Interval::point(value, level) };
        assert_eq!(with(1.0, Some(2.0)).below(0.5), None);
        assert_eq!(with(0.3, Some(2.0)).below(0.5), Some(2.0));
        assert_eq!(with(-0.1, Some(0.2)).below(0.05), Some(0.2));
        assert_eq!(with(-3.0, Some(-1.0)).below(0.5), Some(0.5), "the limit is never below the floor");
        let limit = with(-1.0, None).below(0.5).unwrap();
        assert!((limit - 0.5 * 1.959_964).abs() < 1e-5);
        assert_eq!(with(0.0, Some(0.0)).below(0.0), None, "an exact zero is a value");
    }
}
