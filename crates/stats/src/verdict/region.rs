use serde::{Deserialize, Serialize};

/// Where an effect must lie for a claim to hold; ends included.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Least effect that the claim allows.
    pub low: f64,
    /// Greatest.
    pub high: f64,
}

/// What counts as the promised coverage: a tenth of α, or, for small α, what few replicates of a small image can show.
/// α/10 alone would ask for half-widths of 0.001 and 0.0002 at 99 and 99.8 %.
fn tolerance(alpha: f64) -> f64 {
    (0.1 * alpha).max(0.005 * (alpha / 0.05).sqrt())
}

impl Region {
    /// Estimated over measured error of an estimate that is called calibrated.
    pub const ESTIMATE: Self = Self { low: 0.8, high: 1.25 };

    /// Coverage of intervals of a nominal confidence, which is in (0, 1): 1−α±δ, δ = max(α/10, 0.005·√(α/0.05)).
    #[must_use]
    pub fn coverage(confidence: f64) -> Self {
        let delta = tolerance(1.0 - confidence);
        Self { low: confidence - delta, high: (confidence + delta).min(1.0) }
    }

    /// Coverage of intervals that promise at least their confidence: 1−α−δ to 1, δ as in [`Region::coverage`].
    #[must_use]
    pub fn guarantee(confidence: f64) -> Self {
        Self { low: confidence - tolerance(1.0 - confidence), high: 1.0 }
    }

    /// Rate of violations of a bound that promises at most α.
    #[must_use]
    pub fn bound(alpha: f64) -> Self {
        Self { low: 0.0, high: alpha }
    }

    /// Slope of log error over log samples of plain Monte Carlo: −1 ± 0.1 for squared errors (`order` 2), half of it for
    /// their roots (`order` 1).
    #[must_use]
    pub fn slope(order: u32) -> Self {
        let unit = if order == 1 { 0.5 } else { 1.0 };
        Self { low: -1.1 * unit, high: -0.9 * unit }
    }

    /// A source's range of a positive ratio, a tenth wider on both sides.
    #[must_use]
    pub fn source(low: f64, high: f64) -> Self {
        Self { low: low / 1.1, high: high * 1.1 }
    }

    /// The region of the logarithm; `None` unless both ends are positive.
    #[must_use]
    pub fn ln(self) -> Option<Self> {
        (self.low > 0.0 && self.high > 0.0).then(|| Self { low: self.low.ln(), high: self.high.ln() })
    }

    pub(super) fn holds(self, [low, high]: [f64; 2]) -> bool {
        self.low <= low && high <= self.high
    }

    pub(super) fn misses(self, [low, high]: [f64; 2]) -> bool {
        high < self.low || low > self.high
    }

    /// Distance from estimates to the region; 0 if one of them, or anything between, lies in it.
    pub(super) fn distance(self, [low, high]: [f64; 2]) -> f64 {
        (self.low - high).max(low - self.high).max(0.0)
    }

    /// How far the estimates are from the nearest decision: inside, the distance to the nearer end; outside, that to the
    /// region. `None` where they lie on both sides of an end.
    pub(super) fn margin(self, estimates: [f64; 2]) -> Option<f64> {
        let outside = self.distance(estimates);
        let inside = (estimates[0] - self.low).min(self.high - estimates[1]);
        if outside > 0.0 { Some(outside) } else { Some(inside).filter(|inside| *inside >= 0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_are_as_wide_as_few_replicates_can_show() {
        let width = |confidence: f64| Region::coverage(confidence).high.min(1.0) - confidence;
        assert!((width(0.95) - 0.005).abs() < 1e-12);
        assert!((width(0.99) - 0.005 * 0.2f64.sqrt()).abs() < 1e-12);
        assert!((width(0.998) - 0.001).abs() < 1e-12, "0.998 + 0.001 = 0.999 is below 1");
        assert!((width(0.5) - 0.05).abs() < 1e-12);
        assert_eq!(Region::guarantee(0.95).high, 1.0);
        assert_eq!(Region::slope(1), Region { low: -0.55, high: -0.45 });
    }

    #[test]
    fn the_margin_is_that_to_the_nearest_decision() {
        let region = Region { low: 1.0, high: 2.0 };
        assert_eq!(region.margin([1.25, 1.25]), Some(0.25));
        assert_eq!(region.margin([2.5, 2.5]), Some(0.5));
        assert_eq!(region.margin([0.5, 1.5]), None);
        assert_eq!(region.distance([0.5, 1.5]), 0.0);
    }
}
