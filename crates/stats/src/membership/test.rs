use super::mean::SampleMean;
use super::welch;
use crate::observed::rounding;
use crate::{Level, t_quantile};

/// How two means are compared. Of an upper level each takes the critical value, on both sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MembershipTest {
    /// Whether the other mean lies in the t-interval of the centre's: |x̄ⱼ − x̄ᵢ| ≤ t·sᵢ/√nᵢ with nᵢ−1 degrees of freedom
    /// (moon2013flash, Eq. 2). The error of x̄ⱼ is left out, so that of two equal pixels with equal errors the difference has
    /// √2 times the standard error that is compared with, and i may be a neighbour of j without j being one of i.
    InInterval,
    /// Whether the t-intervals of both overlap: |x̄ⱼ − x̄ᵢ| ≤ tᵢ·sᵢ/√nᵢ + tⱼ·sⱼ/√nⱼ.
    Overlap,
    /// Welch's t-test (Welch 1947): |x̄ⱼ − x̄ᵢ| in units of √(sᵢ²/nᵢ + sⱼ²/nⱼ), by Student's t with Satterthwaite's degrees of
    /// freedom. The textbook's: it keeps its level for normal samples, up to that approximation.
    Welch,
}

impl MembershipTest {
    /// Every test, that of the source work first.
    pub const ALL: [Self; 3] = [Self::InInterval, Self::Overlap, Self::Welch];

    /// Whether the two means are told apart; `None` where there is no test: fewer than 2 samples of a mean whose spread it
    /// uses, or numbers that are not finite.
    ///
    /// Differences within 4·eps·max(|x̄ᵢ|, |x̄ⱼ|), eps that of f32, are rounding and tell nothing apart, as where the source
    /// work's method is implemented.
    #[must_use]
    pub fn rejects(self, centre: &SampleMean, other: &SampleMean, level: Level) -> Option<bool> {
        self.rejects_with(centre, other, level, |n| t_quantile(level, u64::from(n) - 1))
    }

    /// The same with critical values from elsewhere, for at least 2 samples.
    pub(crate) fn rejects_with(
        self,
        centre: &SampleMean,
        other: &SampleMean,
        level: Level,
        critical: impl Fn(u32) -> f64,
    ) -> Option<bool> {
        let uses_other = self != Self::InInterval;
        let numbers = centre.mean + other.mean + centre.variance + other.variance;
        if !numbers.is_finite() || centre.n < 2 || (uses_other && other.n < 2) {
            return None;
        }
        let difference = (other.mean - centre.mean).abs();
        let distance = (difference - rounding(centre.mean, other.mean)).max(0.0);
        let reach = |mean: &SampleMean| critical(mean.n) * mean.standard_error();
        Some(match self {
            Self::InInterval => distance > reach(centre),
            Self::Overlap => distance > reach(centre) + reach(other),
            Self::Welch => welch::tells_apart(distance, centre, other, level),
        })
    }
}
