use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::Level;

/// Critical value of Student's t at `level` with `degrees` ≥ 1 degrees of freedom.
///
/// Newton steps on the distribution function refine the library's inverse, whose bisection stops early. Above a
/// million degrees of freedom it is the normal quantile, within 4e-6 relative at 99.8 %: the library's inverse does not
/// end there.
#[must_use]
pub fn t_quantile(level: Level, degrees: u64) -> f64 {
    t_beyond(level.upper_tail(), degrees)
}

/// Value that Student's t exceeds with probability `tail` in (0, 1), as [`t_quantile`].
pub(crate) fn t_beyond(tail: f64, degrees: u64) -> f64 {
    if degrees > 1_000_000 {
        return normal_beyond(tail);
    }
    let degrees = degrees.max(1) as f64;
    let t = StudentsT::new(0.0, 1.0, degrees).expect("location 0, scale 1, at least one degree of freedom");
    let start = t.inverse_cdf(1.0 - tail);
    // 1 − tail is 1 in floating point for the smallest tails.
    let start = if start.is_finite() { start } else { -t.inverse_cdf(tail) };
    refine(start, tail, |x| t.sf(x), |x| statrs::distribution::Continuous::pdf(&t, x))
}

/// Critical value of the standard normal distribution at `level`.
#[must_use]
pub fn normal_quantile(level: Level) -> f64 {
    normal_beyond(level.upper_tail())
}

/// Value that a standard normal variable exceeds with probability `tail` in (0, 1).
pub(crate) fn normal_beyond(tail: f64) -> f64 {
    let normal = Normal::standard();
    let start = normal.inverse_cdf(1.0 - tail);
    let start = if start.is_finite() { start } else { -normal.inverse_cdf(tail) };
    refine(start, tail, |x| normal.sf(x), |x| statrs::distribution::Continuous::pdf(&normal, x))
}

/// Probability that Student's t with `degrees` ≥ 1 degrees of freedom exceeds `statistic` in absolute value;
/// 0 for an infinite one, 1 for one that is not a number, which says nothing. Above a million degrees of freedom as the
/// normal distribution.
#[must_use]
pub fn t_two_sided_p(statistic: f64, degrees: u64) -> f64 {
    if statistic.is_nan() {
        return 1.0;
    }
    (2.0 * t_tail(statistic.abs(), degrees as f64)).min(1.0)
}

/// Probability that Student's t with `degrees` ≥ 1 degrees of freedom, which need not be whole, exceeds a statistic that is a
/// number. Above a million as the normal distribution.
pub(crate) fn t_tail(statistic: f64, degrees: f64) -> f64 {
    if statistic.is_infinite() {
        return if statistic > 0.0 { 0.0 } else { 1.0 };
    }
    if degrees > 1e6 {
        return normal_tail(statistic);
    }
    let t = StudentsT::new(0.0, 1.0, degrees.max(1.0))
        .expect("location 0, scale 1, at least one degree of freedom");
    t.sf(statistic)
}

/// Probability that a standard normal variable exceeds a statistic that is a number.
pub(crate) fn normal_tail(statistic: f64) -> f64 {
    Normal::standard().sf(statistic)
}

/// Probability that a standard normal number exceeds `statistic` in absolute value; 1 for one that is not a number.
#[must_use]
pub fn normal_two_sided_p(statistic: f64) -> f64 {
    if statistic.is_nan() { 1.0 } else { (2.0 * normal_tail(statistic.abs())).min(1.0) }
}

fn refine(mut x: f64, tail: f64, sf: impl Fn(f64) -> f64, pdf: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..4 {
        let density = pdf(x);
        if density <= 0.0 {
            break;
        }
        let step = (sf(x) - tail) / density; // density > 0
        if !step.is_finite() || step.abs() > 0.5 * x.abs() {
            break;
        }
        x += step;
    }
    x
}

/// Critical values by sample count, computed once: index n gives t with n−1 degrees of freedom.
#[derive(Debug, Clone)]
pub struct TTable {
    level: Level,
    by_count: Vec<f64>,
    beyond: f64,
}

impl TTable {
    /// Sample counts above this use the normal quantile, whose relative distance is then below 0.03 %
    /// at 99.8 %.
    pub const LARGEST: u32 = 8192;

    /// A table for sample counts 2 to `largest` (at most [`TTable::LARGEST`]).
    #[must_use]
    pub fn new(level: Level, largest: u32) -> Self {
        let largest = largest.clamp(2, Self::LARGEST);
        let mut by_count = vec![f64::INFINITY; 2];
        by_count.extend((2..=largest).map(|n| t_quantile(level, u64::from(n) - 1)));
        Self { level, by_count, beyond: normal_quantile(level) }
    }

    /// The table's level.
    #[must_use]
    pub fn level(&self) -> Level {
        self.level
    }

    /// Critical value for `n` samples; infinite below 2, where no interval exists.
    #[must_use]
    pub fn at(&self, n: u32) -> f64 {
        match self.by_count.get(n as usize) {
            Some(&t) => t,
            None if n > Self::LARGEST => self.beyond,
            None => t_quantile(self.level, u64::from(n) - 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn critical_values_match_printed_tables() {
        let table = [(3, 10.2145, 5.8409), (15, 3.7328, 2.9467), (63, 3.2247, 2.6561)];
        for (degrees, t998, t99) in table {
            assert!((t_quantile(Level::TWO_SIDED_998, degrees) - t998).abs() < 6e-5);
            assert!((t_quantile(Level::TWO_SIDED_99, degrees) - t99).abs() < 6e-5);
        }
        assert!((normal_quantile(Level::TWO_SIDED_998) - 3.0902).abs() < 6e-5);
        assert!((normal_quantile(Level::TWO_SIDED_99) - 2.5758).abs() < 6e-5);
        // One degree of freedom is the Cauchy distribution: tan(π(½−α/2)).
        let exact = (std::f64::consts::PI * (0.5 - 0.025)).tan();
        assert!((t_quantile(Level::TWO_SIDED_95, 1) - exact).abs() < 1e-9 * exact);
    }

    #[test]
    fn p_values_invert_the_critical_values() {
        for (level, degrees) in
            [(Level::TWO_SIDED_95, 1), (Level::TWO_SIDED_99, 3), (Level::TWO_SIDED_998, 40)]
        {
            let p = t_two_sided_p(-t_quantile(level, degrees), degrees);
            assert!((p - level.alpha()).abs() < 1e-9, "{p}");
        }
        assert_eq!(t_two_sided_p(0.0, 5), 1.0);
        assert_eq!(t_two_sided_p(f64::NEG_INFINITY, 5), 0.0);
        assert_eq!(t_two_sided_p(f64::NAN, 3), 1.0, "nothing is known");
    }

    #[test]
    fn table_decreases_towards_the_normal_quantile() {
        let table = TTable::new(Level::TWO_SIDED_998, 300);
        assert_eq!(table.at(1), f64::INFINITY);
        let mut last = f64::INFINITY;
        for n in [2, 3, 4, 16, 64, 300, 301, 1024, TTable::LARGEST, TTable::LARGEST + 1, u32::MAX] {
            assert!(table.at(n) < last || n == u32::MAX, "n = {n}");
            last = table.at(n);
        }
        assert!((table.at(TTable::LARGEST) / table.at(u32::MAX) - 1.0).abs() < 4e-4);
    }

    #[test]
    fn huge_counts_meet_the_normal_quantile() {
        let (below, above) =
            (t_quantile(Level::TWO_SIDED_998, 1_000_000), t_quantile(Level::TWO_SIDED_998, u64::MAX));
        assert!(below > above && below / above < 1.0 + 4e-6, "{below} {above}");
    }

    #[test]
    fn five_thousand_samples_are_tabulated_without_drift() {
        let table = TTable::new(Level::TWO_SIDED_99, 5000);
        for n in [2u32, 17, 500, 5000] {
            assert_eq!(table.at(n), t_quantile(Level::TWO_SIDED_99, u64::from(n) - 1));
        }
    }
}
