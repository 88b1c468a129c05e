//! What a number of replicates can tell, before they are made.

use statrs::distribution::{ChiSquared, Continuous, ContinuousCDF, Normal};

use crate::interval::mean_and_variance;
use crate::{Level, t_quantile};

/// Most replicates that are looked for.
const MOST: u32 = 1 << 16;

/// Paired comparisons over replicates that are adjusted together, at the first step of Holm's rule (Holm 1979): the one
/// with the smallest p-value is told if that is at most α/m. Later steps ask for less, so that what is told here is told
/// whatever the others do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Design {
    level: Level,
    comparisons: u32,
}

impl Design {
    /// `comparisons` of one family at a two-sided level for all of them; none counts as one.
    #[must_use]
    pub fn new(level: Level, comparisons: u32) -> Self {
        Self { level, comparisons: comparisons.max(1) }
    }

    /// Comparisons in the family.
    #[must_use]
    pub fn comparisons(&self) -> u32 {
        self.comparisons
    }

    /// Critical value t_{R−1, 1−α/(2m)} of Student's t with R `replicates`; `None` below two, where nothing is told.
    #[must_use]
    pub fn critical(&self, replicates: u32) -> Option<f64> {
        let confidence = 1.0 - self.level.alpha() / f64::from(self.comparisons);
        // Only more comparisons than 2⁵⁰ round it to 1.
        let step = Level::two_sided(confidence).ok()?;
        (replicates >= 2).then(|| t_quantile(step, u64::from(replicates) - 1))
    }

    /// Half width t·s/√R of the mean of R paired values with standard deviation `sd`: what a mean must be away from zero to
    /// be told. `None` below two replicates.
    ///
    /// A true difference of that size is told by half of such studies, and by a few more with few replicates because a
    /// standard deviation of few values is more often too small than too large: 0.68 of them with R = 2, 0.61 with R = 4,
    /// 0.57 with R = 8, if m is large.
    #[must_use]
    pub fn half_width(&self, sd: f64, replicates: u32) -> Option<f64> {
        Some(self.critical(replicates)? * sd / f64::from(replicates).sqrt())
    }

    /// The true difference that a share `power` of such studies tells, with its sign; `None` below two replicates or if
    /// `power` is not inside (0, 1).
    ///
    /// Exact for normal values: (mean/sd)·√R has the noncentral t-distribution with R−1 degrees of freedom.
    #[must_use]
    pub fn difference_told(&self, sd: f64, replicates: u32, power: f64) -> Option<f64> {
        let critical = self.critical(replicates)?;
        if !(power > 0.0 && power < 1.0) {
            return None;
        }
        let degrees = replicates - 1;
        // The power grows with the noncentrality: from above by doubling, then by bisection to 2⁻⁵⁰ of it.
        let (mut low, mut high) = (0.0, critical);
        while beyond(critical, degrees, high) < power && high < 1e12 {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if beyond(critical, degrees, middle) < power { low = middle } else { high = middle }
        }
        Some(high * sd / f64::from(replicates).sqrt())
    }

    /// Fewest replicates with which a difference of `difference` is told by half of such studies; `None` if more than
    /// 65 536 would be needed, or if `difference` is not positive.
    #[must_use]
    pub fn replicates(&self, sd: f64, difference: f64) -> Option<u32> {
        fewest(|count| self.half_width(sd, count).is_some_and(|half| half <= difference))
            .filter(|_| difference > 0.0)
    }

    /// Fewest replicates with which a share `power` of such studies tells a difference of `difference`, as
    /// [`Design::replicates`].
    #[must_use]
    pub fn replicates_for(&self, sd: f64, difference: f64, power: f64) -> Option<u32> {
        let told = |count| self.difference_told(sd, count, power).is_some_and(|told| told <= difference);
        fewest(told).filter(|_| difference > 0.0)
    }
}

/// Standard deviation over replicates of the logarithm of the ratio of two errors; `None` with fewer than two replicates that
/// have both. Values that are not positive and finite are missing.
#[must_use]
pub fn log_ratio_spread(a: &[Option<f64>], b: &[Option<f64>]) -> Option<f64> {
    let positive = |v: &Option<f64>| v.filter(|v| v.is_finite() && *v > 0.0);
    let logs: Vec<f64> =
        a.iter().zip(b).filter_map(|(a, b)| Some(positive(a)?.ln() - positive(b)?.ln())).collect();
    let (_, variance) = mean_and_variance(&logs)?;
    (logs.len() >= 2).then(|| variance.sqrt())
}

/// Smallest number from 2 of which `enough` is true, which stays true for all above it.
fn fewest(enough: impl Fn(u32) -> bool) -> Option<u32> {
    let mut high = 2;
    while !enough(high) {
        high *= 2;
        if high > MOST {
            return None;
        }
    }
    let mut low = high / 2; // not enough, or 1
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if enough(middle) { high = middle } else { low = middle }
    }
    Some(high)
}

/// P(T > t) of the noncentral t-distribution with noncentrality `delta` ≥ 0, for t > 0:
/// P(Z + δ > t·√(χ²/ν)) = ∫ φ(z)·P(χ² < ν·((z+δ)/t)²) dz over z > −δ, by Simpson's rule. The integrand is smooth however
/// large t is, and beyond nine standard deviations there is less than 1e-18.
fn beyond(t: f64, degrees: u32, delta: f64) -> f64 {
    const INTERVALS: u32 = 400;
    let (Ok(chi), normal) = (ChiSquared::new(f64::from(degrees)), Normal::standard()) else { return 0.0 };
    let from = (-delta).max(-9.0);
    let step = (9.0 - from) / f64::from(INTERVALS);
    let at = |k: u32| {
        let z = from + f64::from(k) * step;
        normal.pdf(z) * chi.cdf(f64::from(degrees) * ((z + delta) / t).powi(2))
    };
    let inner: f64 = (1..INTERVALS).map(|k| if k % 2 == 1 { 4.0 * at(k) } else { 2.0 * at(k) }).sum();
    (at(0) + inner + at(INTERVALS)) * step / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;

    fn of(pairs: u32) -> Design {
        Design::new(Level::TWO_SIDED_95, pairs)
    }

    #[test]
    fn half_widths_for_one_seven_and_twenty_eight_pairs_are_those_of_the_t_distribution() {
        // t/√R from a table of Student's t.
        let table = [
            (2, [8.98, 62.9, 252.0]),
            (4, [1.59, 3.29, 5.31]),
            (8, [0.84, 1.33, 1.73]),
            (16, [0.53, 0.78, 0.95]),
        ];
        for (replicates, expected) in table {
            for (pairs, expected) in [1, 7, 28].into_iter().zip(expected) {
                let half = of(pairs).half_width(1.0, replicates).unwrap();
                let digit = if expected > 10.0 { 0.003 * expected } else { 0.0051 };
                assert!((half - expected).abs() < digit, "R {replicates}, {pairs} pairs: {half}");
            }
        }
        assert_eq!(of(1).half_width(1.0, 1), None);
        assert_eq!(of(1).half_width(0.0, 2), Some(0.0));
    }

    #[test]
    fn the_fewest_replicates_are_the_first_number_whose_half_width_is_small_enough() {
        for (pairs, sd, difference) in [(1, 0.02, 0.05), (7, 0.1, 0.05), (28, 0.27, 0.05), (28, 0.01, 1.0)] {
            let design = of(pairs);
            let slow = (2..).find(|&r| design.half_width(sd, r).unwrap() <= difference).unwrap();
            assert_eq!(design.replicates(sd, difference), Some(slow), "{pairs} {sd} {difference}");
            let more = design.replicates_for(sd, difference, 0.8).unwrap();
            assert!(more >= slow, "{more} for 80 % where half need {slow}");
            assert!(design.difference_told(sd, more, 0.8).unwrap() <= difference);
        }
        assert_eq!(of(1).replicates(1.0, 1e-9), None, "too many");
        assert_eq!(of(1).replicates(1.0, 0.0), None);
        assert_eq!(of(1).replicates(1.0, f64::NAN), None);
    }

    #[test]
    fn the_spread_of_a_log_ratio_is_over_replicates_that_have_both() {
        let (a, b) = ([Some(1.0), Some(4.0), None, Some(-1.0)], [Some(1.0), Some(1.0), Some(9.0), Some(1.0)]);
        // Logarithms 0 and ln 4.
        let spread = log_ratio_spread(&a, &b).unwrap();
        assert!((spread - 4f64.ln() / 2f64.sqrt()).abs() < 1e-15);
        assert_eq!(log_ratio_spread(&a[1..], &b[1..]), None);
    }

    #[test]
    fn a_central_distribution_is_students_t() {
        for (degrees, t) in [(1u32, 12.706), (3, 3.182), (15, 2.131), (1, 300.0)] {
            let exact = 0.5 * crate::t_two_sided_p(t, degrees.into());
            let tail = beyond(t, degrees, 0.0);
            assert!((tail - exact).abs() < 1e-6 * exact.max(1e-3), "{degrees}: {tail} for {exact}");
        }
    }

    #[test]
    fn as_many_simulated_studies_tell_a_difference_as_is_said() {
        const STUDIES: u32 = 20_000;
        let mut normals = Normals::new(5);
        for (pairs, replicates) in [(1, 2), (7, 4), (28, 8)] {
            let design = of(pairs);
            let critical = design.critical(replicates).unwrap();
            for power in [0.5, 0.8] {
                let difference = design.difference_told(0.3, replicates, power).unwrap();
                let told = (0..STUDIES).filter(|_| {
                    let values: Vec<f64> =
                        (0..replicates).map(|_| difference + 0.3 * normals.next()).collect();
                    let (mean, variance) = mean_and_variance(&values).unwrap();
                    mean / (variance / f64::from(replicates)).sqrt() > critical
                });
                let share = told.count() as f64 / f64::from(STUDIES);
                let mcse = (power * (1.0 - power) / f64::from(STUDIES)).sqrt();
                assert!((share - power).abs() < 4.0 * mcse, "{pairs} {replicates}: {share} for {power}");
            }
        }
        assert_eq!(of(1).difference_told(1.0, 4, 1.0), None);
        assert_eq!(of(1).difference_told(1.0, 1, 0.8), None);
    }

    #[test]
    fn a_difference_of_the_half_width_is_told_by_half_of_the_studies_or_a_few_more() {
        for (replicates, share) in [(2, 0.68), (4, 0.61), (8, 0.57)] {
            let critical = of(1000).critical(replicates).unwrap();
            let told = beyond(critical, replicates - 1, critical);
            assert!((told - share).abs() < 0.01, "{replicates}: {told}");
        }
        for pairs in [1, 7, 28] {
            for replicates in [2, 3, 4, 8, 16, 64] {
                let critical = of(pairs).critical(replicates).unwrap();
                let told = beyond(critical, replicates - 1, critical);
                assert!((0.5..0.7).contains(&told), "{pairs} {replicates}: {told}");
            }
        }
    }
}
