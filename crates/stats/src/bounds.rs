//! Stochastic error bounds |D−μ| ≤ Σ factorᵢ·t(levelᵢ)·s/√n (moon2013flash, Theorem 3.1 and its
//! compositions).

use serde::{Deserialize, Serialize};

use crate::observed::{Tally, expect, rounding, tally};
use crate::{Groups, Level, Observed, ShapeError, Truth, normal_quantile};

/// Counts over pixel-channels that have a bound.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundTally {
    /// Pixel-channels.
    pub total: u64,
    /// Violations, allowing for the noise of the truth.
    pub violations: u64,
    /// Violations without that allowance.
    pub violations_uncorrected: u64,
    /// Of the violations (with allowance): where s = 0 and the interval is a point.
    pub violations_missed: u64,
    ratio_sum: f64,
    ratio_count: u64,
}

impl BoundTally {
    /// Share of violations, allowing for the noise of the truth; `None` if nothing was counted.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        (self.total > 0).then(|| self.violations as f64 / self.total as f64)
    }

    /// Mean of |D−r| over the bound, where the bound is positive; `None` if it never is.
    #[must_use]
    pub fn mean_ratio(&self) -> Option<f64> {
        (self.ratio_count > 0).then(|| self.ratio_sum / self.ratio_count as f64)
    }
}

impl Tally for BoundTally {
    fn add(&mut self, other: &Self) {
        self.total += other.total;
        self.violations += other.violations;
        self.violations_uncorrected += other.violations_uncorrected;
        self.violations_missed += other.violations_missed;
        self.ratio_sum += other.ratio_sum;
        self.ratio_count += other.ratio_count;
    }
}

/// Half-widths Σ factorᵢ·t(levelᵢ)·s/√n in the order of the means; infinite where there are fewer than 2
/// samples.
///
/// # Errors
/// [`ShapeError`] if the slices do not belong together.
pub fn half_widths(observed: &Observed<'_>, terms: &[(f64, Level)]) -> Result<Vec<f64>, ShapeError> {
    observed.check()?;
    let tables: Vec<_> =
        terms.iter().map(|&(factor, level)| (factor, observed.critical_values(level))).collect();
    let factors: Vec<f64> = (0..observed.pixels)
        .map(|pixel| {
            if observed.count_at(pixel) < 2 {
                return f64::INFINITY;
            }
            tables.iter().map(|(factor, t)| factor * t(pixel)).sum()
        })
        .collect();
    let width = |(i, &variance): (usize, &f32)| {
        let factor = factors[i % observed.pixels];
        if factor.is_finite() { factor * f64::from(variance).max(0.0).sqrt() } else { factor }
    };
    Ok(observed.variance.iter().enumerate().map(width).collect())
}

/// Counts where |D−r| exceeds its bound, for all pixels (index 0) and each group (1 + group).
///
/// Allowing for the noise of the truth, a violation is |D−r| > √(bound² + t_r²·v_r) + 4·eps·max(|D|,|r|),
/// with t_r the normal critical value of `level`, v_r the variance of the truth and eps that of f32;
/// uncorrected, v_r = 0. A D that is NaN or infinite violates its bound. Left out are pixels that do not take
/// part, infinite bounds and a truth that is not finite.
///
/// # Errors
/// [`ShapeError`] if the slices do not belong together.
pub fn bound_violations(
    denoised: &[f32],
    bound: &[f64],
    observed: &Observed<'_>,
    truth: &Truth<'_>,
    level: Level,
    groups: Option<Groups<'_>>,
) -> Result<Vec<BoundTally>, ShapeError> {
    observed.check()?;
    truth.check(observed.mean.len())?;
    expect("denoised image", denoised.len(), observed.mean.len())?;
    expect("bound", bound.len(), observed.mean.len())?;
    let t_truth = normal_quantile(level);
    tally(groups, observed.pixels, |pixel| {
        let mut tally = BoundTally::default();
        if !observed.takes_part(pixel) {
            return tally;
        }
        for i in (pixel..observed.mean.len()).step_by(observed.pixels) {
            let (d, r, noise) = (f64::from(denoised[i]), f64::from(truth.mean[i]), truth.variance_at(i));
            if !bound[i].is_finite() || !(r + noise).is_finite() {
                continue;
            }
            let error = (d - r).abs();
            let distance = if d.is_finite() { error - rounding(d, r) } else { f64::INFINITY };
            let violated = distance > bound[i].hypot(t_truth * noise.sqrt());
            tally.total += 1;
            tally.violations += u64::from(violated);
            tally.violations_uncorrected += u64::from(distance > bound[i]);
            tally.violations_missed += u64::from(violated && observed.variance[i] <= 0.0);
            if bound[i] > 0.0 && d.is_finite() {
                tally.ratio_sum += error / bound[i];
                tally.ratio_count += 1;
            }
        }
        tally
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SampleCounts;

    fn observed<'a>(mean: &'a [f32], variance: &'a [f32], counts: SampleCounts<'a>) -> Observed<'a> {
        Observed { mean, variance, counts, pixels: mean.len(), valid: None }
    }

    #[test]
    fn half_widths_add_their_terms() {
        let o = observed(&[0.0; 2], &[0.25, 4.0], SampleCounts::PerPixel(&[16, 1]));
        let widths = half_widths(&o, &[(2.0, Level::TWO_SIDED_998), (1.0, Level::TWO_SIDED_99)]).unwrap();
        // (2·3.7328 + 2.9467)·0.5
        assert!((widths[0] - 5.206_15).abs() < 1e-4, "{}", widths[0]);
        assert_eq!(widths[1], f64::INFINITY);
    }

    #[test]
    fn violations_are_counted_with_and_without_allowance() {
        let o = observed(&[0.0; 6], &[1.0, 1.0, 1.0, 0.0, 1.0, 1.0], SampleCounts::Uniform(4));
        let denoised = [0.9, 1.1, 1.5, 0.5, f32::NAN, 0.2];
        let bound = [1.0, 1.0, 1.0, 0.0, 1.0, f64::INFINITY];
        // t_r = 2.5758: the allowance for v_r = 0.1 widens a bound of 1 to 1.2899 and a bound of 0 to 0.8145.
        let noise = [0.1, 0.1, 0.1, 0.0, 0.1, 0.1];
        let truth = Truth { mean: &[0.0; 6], variance: Some(&noise) };
        let tally = bound_violations(&denoised, &bound, &o, &truth, Level::TWO_SIDED_99, None).unwrap()[0];
        assert_eq!((tally.total, tally.violations, tally.violations_uncorrected), (5, 3, 4));
        assert_eq!(tally.violations_missed, 1);
        assert!((tally.mean_ratio().unwrap() - (0.9 + 1.1 + 1.5) / 3.0).abs() < 1e-6);
    }
}
