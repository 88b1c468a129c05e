use std::fmt;

/// How far a measured number may lie from its expectation: a multiple of its standard error, derived from the
/// number of trials and never chosen to make a test pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Expected value.
    pub expected: f64,
    /// Standard error of the measurement.
    pub standard_error: f64,
    /// Allowed distance in standard errors.
    pub z: f64,
}

impl Tolerance {
    /// Standard errors allowed unless said otherwise: a two-sided false alarm in 1.7 million.
    pub const Z: f64 = 5.0;

    /// A measured rate over `trials` independent trials with probability `rate`. Channels of one pixel are
    /// one trial if they share their random numbers.
    #[must_use]
    pub fn rate(rate: f64, trials: u64) -> Self {
        Self {
            expected: rate,
            standard_error: noisefloor_stats::rate_standard_error(rate, trials),
            z: Self::Z,
        }
    }

    /// The mean of `trials` independent draws with this expectation and standard deviation.
    #[must_use]
    pub fn mean(expected: f64, standard_deviation: f64, trials: u64) -> Self {
        let standard_error = standard_deviation / (trials.max(1) as f64).sqrt();
        Self { expected, standard_error, z: Self::Z }
    }

    /// The unbiased variance of `trials` independent normal draws of this variance: relative standard error
    /// √(2/(trials−1)).
    #[must_use]
    pub fn normal_variance(variance: f64, trials: u64) -> Self {
        let standard_error = variance * (2.0 / (trials.max(2) - 1) as f64).sqrt();
        Self { expected: variance, standard_error, z: Self::Z }
    }

    /// The mean of these independent measurements (one per replicate), with the standard error from their own
    /// spread.
    #[must_use]
    pub fn of_mean(expected: f64, measurements: &[f64]) -> Self {
        let n = measurements.len() as f64;
        let mean = measurements.iter().sum::<f64>() / n.max(1.0);
        let m2: f64 = measurements.iter().map(|v| (v - mean).powi(2)).sum();
        let standard_error = if measurements.len() > 1 { (m2 / (n - 1.0) / n).sqrt() } else { f64::INFINITY };
        Self { expected, standard_error, z: Self::Z }
    }

    /// Another number of standard errors.
    #[must_use]
    pub fn with_z(self, z: f64) -> Self {
        Self { z, ..self }
    }

    /// Whether `measured` is near enough on both sides.
    ///
    /// # Errors
    /// A sentence with all numbers if not.
    pub fn near(&self, measured: f64) -> Result<(), String> {
        self.judge(measured, (measured - self.expected).abs(), "differs from")
    }

    /// Whether `measured` does not exceed the expectation by more than chance explains.
    ///
    /// # Errors
    /// A sentence with all numbers if it does.
    pub fn at_most(&self, measured: f64) -> Result<(), String> {
        self.judge(measured, measured - self.expected, "exceeds")
    }

    /// Whether `measured` does not fall below the expectation by more than chance explains.
    ///
    /// # Errors
    /// A sentence with all numbers if it does.
    pub fn at_least(&self, measured: f64) -> Result<(), String> {
        self.judge(measured, self.expected - measured, "falls below")
    }

    fn judge(&self, measured: f64, distance: f64, how: &str) -> Result<(), String> {
        if distance <= self.z * self.standard_error {
            Ok(())
        } else {
            Err(format!("{measured} {how} {self}"))
        }
    }
}

impl fmt::Display for Tolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ± {} ({} standard errors allowed)", self.expected, self.standard_error, self.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_judged_in_standard_errors() {
        // √(0.05·0.95/10000) = 0.00218.
        let t = Tolerance::rate(0.05, 10_000);
        assert!((t.standard_error - 0.002_179).abs() < 1e-6);
        assert!(t.near(0.0608).is_ok() && t.near(0.0610).is_err() && t.near(0.0390).is_err());
        assert!(t.at_most(0.0).is_ok() && t.at_most(0.07).is_err());
        assert!(t.at_least(1.0).is_ok() && t.at_least(0.03).is_err());
        assert!(t.near(f64::NAN).is_err());
        assert!(t.near(1.0).unwrap_err().contains("1 differs from 0.05"));
    }

    #[test]
    fn spread_of_measurements_makes_the_tolerance() {
        let t = Tolerance::of_mean(2.0, &[1.0, 2.0, 3.0, 4.0]);
        assert!((t.standard_error - (5.0f64 / 12.0).sqrt()).abs() < 1e-12);
        assert!(Tolerance::of_mean(0.0, &[7.0]).near(7.0).is_ok(), "one measurement has no known error");
        assert!((Tolerance::normal_variance(2.0, 9).standard_error - 1.0).abs() < 1e-12);
        assert!((Tolerance::mean(0.0, 3.0, 9).with_z(2.0).standard_error - 1.0).abs() < 1e-12);
    }
}
