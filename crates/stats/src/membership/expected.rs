//! How often tests of membership tell two pixels of normal samples apart.
//!
//! Throughout, `shift` is the difference of the true means in units of the centre's standard error, and `ratio` the standard
//! error of the other mean over the centre's: the difference of the means has √(1 + ratio²) times the centre's standard error.

use super::test::MembershipTest;
use crate::student::{normal_tail, t_tail};
use crate::{Level, normal_quantile, t_quantile};

/// P(|T·scale + shift| > threshold) for a symmetric T with this upper tail, scale ≥ 1; NaN for a shift or a scale that is not
/// finite.
fn outside(threshold: f64, shift: f64, scale: f64, tail: impl Fn(f64) -> f64) -> f64 {
    if !shift.is_finite() || !scale.is_finite() {
        return f64::NAN;
    }
    (tail((threshold - shift) / scale) + tail((threshold + shift) / scale)).min(1.0)
}

impl MembershipTest {
    /// Probability that means of many samples, n → ∞, are told apart. Without a shift that is the rate of false alarms: for
    /// equal errors 2Φ(−z/√2) of [`MembershipTest::InInterval`], 2Φ(−z·√2) of [`MembershipTest::Overlap`], and α = 2Φ(−z) of
    /// [`MembershipTest::Welch`], z the normal critical value. At two-sided 99 % that is 6.85, 0.027 and 1 %.
    #[must_use]
    pub fn asymptotic_rejection(self, shift: f64, ratio: f64, level: Level) -> f64 {
        let (z, scale) = (normal_quantile(level), ratio.hypot(1.0));
        let threshold = match self {
            Self::InInterval => z,
            Self::Overlap => z * (1.0 + ratio),
            Self::Welch => z * scale,
        };
        outside(threshold, shift, scale, normal_tail)
    }
}

/// Probability that [`MembershipTest::InInterval`] tells means apart whose centre has `n` ≥ 2 samples, exactly for independent
/// normal samples: the difference over the centre's standard error sᵢ/√nᵢ is √(1 + ratio²) times Student's t. `shift` is in
/// units of sᵢ/√nᵢ as it was estimated.
#[must_use]
pub fn interval_rejection(n: u32, shift: f64, ratio: f64, level: Level) -> f64 {
    let degrees = n.max(2) - 1;
    let threshold = t_quantile(level, u64::from(degrees));
    outside(threshold, shift, ratio.hypot(1.0), |statistic| t_tail(statistic, f64::from(degrees)))
}
