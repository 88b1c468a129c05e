//! Coverage of the t-intervals of sample means (moon2013flash, Table 1).

use serde::{Deserialize, Serialize};

use crate::observed::{Tally, rounding, tally};
use crate::{Groups, Level, Observed, ShapeError, Truth, normal_quantile};

/// Counts over pixel-channels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CoverageTally {
    /// With s > 0.
    pub total: u64,
    /// Of those: covered, allowing for the noise of the truth.
    pub covered: u64,
    /// Of those: covered without that allowance.
    pub covered_uncorrected: u64,
    /// With s = 0 and a mean that agrees with the truth within its noise.
    pub constant: u64,
    /// With s = 0 and a mean that does not: all samples missed the event.
    pub missed: u64,
}

impl CoverageTally {
    /// All pixel-channels.
    #[must_use]
    pub fn all(&self) -> u64 {
        self.total + self.constant + self.missed
    }

    /// Covered or constant over all, allowing for the noise of the truth; `None` if there is none at all.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        (self.all() > 0).then(|| (self.covered + self.constant) as f64 / self.all() as f64)
    }
}

impl Tally for CoverageTally {
    fn add(&mut self, other: &Self) {
        self.total += other.total;
        self.covered += other.covered;
        self.covered_uncorrected += other.covered_uncorrected;
        self.constant += other.constant;
        self.missed += other.missed;
    }
}

/// Counts pixel-channels whose interval at `level` covers the truth, for all pixels (index 0) and each group
/// (1 + group).
///
/// Covered means |x̄−r| ≤ √((t·s/√n)² + t_r²·v_r) + 4·eps·max(|x̄|,|r|), with t Student's critical value for
/// n−1 degrees of freedom, t_r the normal one, v_r the variance of the truth and eps that of f32. Without the
/// allowance, v_r = 0. The allowance assumes near-normal errors of both, so a noisy truth should have at
/// least 16 times the samples.
///
/// Pixels with fewer than 2 samples have no interval and are left out, like pixel-channels that are not
/// finite.
///
/// # Errors
/// [`ShapeError`] if the slices do not belong together.
pub fn coverage(
    observed: &Observed<'_>,
    truth: &Truth<'_>,
    level: Level,
    groups: Option<Groups<'_>>,
) -> Result<Vec<CoverageTally>, ShapeError> {
    observed.check()?;
    truth.check(observed.mean.len())?;
    let t = observed.critical_values(level);
    let t_truth = normal_quantile(level);
    tally(groups, observed.pixels, |pixel| {
        let mut tally = CoverageTally::default();
        if !observed.takes_part(pixel) || observed.count_at(pixel) < 2 {
            return tally;
        }
        for i in (pixel..observed.mean.len()).step_by(observed.pixels) {
            let (mean, r) = (f64::from(observed.mean[i]), f64::from(truth.mean[i]));
            let (variance, noise) = (f64::from(observed.variance[i]).max(0.0), truth.variance_at(i));
            if !(mean - r + variance + noise).is_finite() {
                continue;
            }
            let distance = (mean - r).abs() - rounding(mean, r);
            let (own, allowance) = (t(pixel) * variance.sqrt(), t_truth * noise.sqrt());
            let covered = distance <= own.hypot(allowance);
            match (variance > 0.0, covered) {
                (true, _) => {
                    tally.total += 1;
                    tally.covered += u64::from(covered);
                    tally.covered_uncorrected += u64::from(distance <= own);
                }
                (false, true) => tally.constant += 1,
                (false, false) => tally.missed += 1,
            }
        }
        tally
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SampleCounts;

    fn count(mean: &[f32], variance: &[f32], truth: &[f32], noise: Option<&[f32]>) -> CoverageTally {
        let observed =
            Observed { mean, variance, counts: SampleCounts::Uniform(16), pixels: mean.len(), valid: None };
        let truth = Truth { mean: truth, variance: noise };
        coverage(&observed, &truth, Level::TWO_SIDED_99, None).unwrap()[0]
    }

    #[test]
    fn an_interval_ends_at_its_critical_value() {
        // t(99 %, 15) = 2.9467, standard error 0.5.
        let inside = count(&[1.0], &[0.25], &[1.0 + 1.4733], None);
        assert_eq!(
            inside,
            CoverageTally { total: 1, covered: 1, covered_uncorrected: 1, ..Default::default() }
        );
        let outside = count(&[1.0], &[0.25], &[1.0 + 1.4735], None);
        assert_eq!(outside, CoverageTally { total: 1, ..Default::default() });
    }

    #[test]
    fn noise_of_the_truth_widens_in_quadrature() {
        // √((2.9467·0.5)² + (2.5758·0.5)²) = 1.95690.
        let inside = count(&[0.0], &[0.25], &[1.9568], Some(&[0.25]));
        assert_eq!((inside.covered, inside.covered_uncorrected), (1, 0));
        assert_eq!(count(&[0.0], &[0.25], &[1.9570], Some(&[0.25])).covered, 0);
    }

    #[test]
    fn zero_variance_splits_into_constant_and_missed() {
        let tally = count(&[1.0, 0.0, 0.0], &[0.0; 3], &[1.0 + 4e-7, 1.0, 1.0], Some(&[0.0, 0.01, 1.0]));
        assert_eq!(tally, CoverageTally { constant: 2, missed: 1, ..Default::default() });
        assert_eq!(tally.rate(), Some(2.0 / 3.0));
    }

    #[test]
    fn channels_share_their_pixels_group_and_count() {
        let observed = Observed {
            mean: &[0.0; 6],
            variance: &[1.0; 6],
            counts: SampleCounts::PerPixel(&[1, 16]),
            pixels: 2,
            valid: None,
        };
        let truth = Truth { mean: &[2.0, 2.0, 9.0, 9.0, 2.0, 2.0], variance: None };
        let groups = Some(Groups { of_pixel: &[0, 1], count: 2 });
        let tallies = coverage(&observed, &truth, Level::TWO_SIDED_99, groups).unwrap();
        assert_eq!(tallies[1], CoverageTally::default(), "one sample has no interval");
        assert_eq!(tallies[0], tallies[2]);
        assert_eq!((tallies[2].total, tallies[2].covered), (3, 2));
        let short = Truth { mean: &[0.0; 5], variance: None };
        let error = coverage(&observed, &short, Level::TWO_SIDED_99, None).unwrap_err();
        assert_eq!(error.to_string(), "truth has 5 entries, expected 6");
    }
}
