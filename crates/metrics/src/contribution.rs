use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// What the noise of the reference does to one value of a metric, beside its standard error.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Contribution {
    /// Bias that was estimated and taken out: the value is lower by it than without. What remains is of higher order in
    /// the reference's relative noise. 0 for metrics that are linear in each half.
    #[serde(default)]
    pub bias: f64,
    /// What was taken out of a relative error's numerator: the mean of the reference's variance over max(r,0)²+ε. 0 for
    /// other metrics.
    #[serde(default)]
    pub noise: f64,
    /// Influence of each independent part of the reference on the value, first those of half A, scaled so that the sum of
    /// squares is the variance, up to `product`. Of a reference in halves without parts: of up to 16 groups of blocks of
    /// 32×32 pixels. Empty where the reference has neither, or the image is too small for it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<f64>,
    /// Standard deviation of the term that is the product of both halves' noise, whose variance `parts` holds twice; the
    /// same for all images. 0 without parts of the reference.
    #[serde(default)]
    pub product: f64,
}

impl Contribution {
    /// Share of a value above which the bias that was taken out of it leaves too much in doubt: the series that it is the
    /// first term of goes on with about its square, 6 % of the value here.
    pub const LARGEST_BIAS: f64 = 0.25;

    /// Mean relative variance of the reference, 14 % of the radiance, above which the series itself is in doubt, even where
    /// its first terms cancel.
    pub const LARGEST_NOISE: f64 = 0.02;

    /// For a value whose bias or noise exceeds [`Self::LARGEST_BIAS`] or [`Self::LARGEST_NOISE`]: the upper limit to print
    /// instead. It is `high`, the upper end of the value's interval (the value itself without one), plus the size of the
    /// bias and the noise, and so at least the error with all noise left in: to second order that is too small by at most
    /// 3/4 of the relative variance, at x = μ/3 and before the bias is added, and mostly much too large.
    #[must_use]
    pub fn upper_limit(&self, value: f64, high: Option<f64>) -> Option<f64> {
        let doubtful = self.bias.abs() > Self::LARGEST_BIAS * value.abs() || self.noise > Self::LARGEST_NOISE;
        let limit = high.unwrap_or(value).max(value) + self.bias.abs() + self.noise.max(0.0);
        (doubtful && limit > 0.0 && limit.is_finite()).then_some(limit)
    }

    /// Variance that the reference contributes to the value, from the influences; `None` without any.
    #[must_use]
    pub fn variance(&self) -> Option<f64> {
        let least = self.product * self.product;
        let sum: f64 = self.parts.iter().map(|l| l * l).sum();
        (!self.parts.is_empty()).then(|| (sum - least).max(least))
    }
}

/// Metric id to contribution.
pub(crate) type Contributions = BTreeMap<String, Contribution>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bias_that_is_a_good_part_of_the_value_makes_it_an_upper_limit() {
        let of = |bias| Contribution { bias, ..Contribution::default() };
        assert_eq!(of(0.2).upper_limit(1.0, Some(1.1)), None);
        assert_eq!(of(-0.5).upper_limit(1.0, Some(1.25)), Some(1.75));
        assert_eq!(of(0.5).upper_limit(1.0, None), Some(1.5));
        assert_eq!(of(0.5).upper_limit(-2.0, None), None, "no positive limit");
        assert_eq!(of(0.0).upper_limit(0.0, None), None);
        let noisy = Contribution { noise: 0.5, ..of(0.25) };
        assert_eq!(noisy.upper_limit(2.0, None), Some(2.75), "the noise is in doubt, however small the bias");
    }

    #[test]
    fn the_product_term_is_counted_once() {
        let of = |parts: &[f64], product| Contribution {
            parts: parts.to_vec(),
            product,
            ..Contribution::default()
        };
        assert_eq!(of(&[3.0, 4.0], 2.0).variance(), Some(21.0));
        assert_eq!(of(&[1.0, 1.0], 2.0).variance(), Some(4.0), "never less than the product term alone");
        assert_eq!(of(&[], 2.0).variance(), None);
    }
}
