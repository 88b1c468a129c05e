use crate::{Interval, Level, ReferenceShare};

/// An estimate with what makes it uncertain.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimated {
    /// Point estimate.
    pub value: f64,
    /// Standard error over replicates, by the jackknife; absent where there are too few.
    pub replicate_error: Option<f64>,
    /// What the reference adds: common to all that is held against it. Without parts nothing is known and it is 0.
    pub reference: ReferenceShare,
    /// Replicates.
    pub replicates: u32,
}

impl Estimated {
    /// Root of the sum of both variances; absent where that over replicates is.
    #[must_use]
    pub fn standard_error(&self) -> Option<f64> {
        self.replicate_error.map(|own| own.hypot(self.reference.standard_error))
    }

    /// Value ± Student's t for R−1 degrees of freedom times the standard error.
    #[must_use]
    pub fn interval(&self, level: Level) -> Interval {
        match self.standard_error() {
            Some(se) if self.replicates >= 2 => Interval::symmetric(
                self.value,
                se,
                level,
                Some(u64::from(self.replicates) - 1),
                self.replicates,
            ),
            _ => Interval::point(self.value, level),
        }
    }
}

/// Weighted means over the pixel-channels of an image or a group: Σ w·… over their number, as relative errors are averaged.
///
/// **Standard errors over replicates.** Bias and squared error are means over replicates, whose jackknife is s/√R and
/// unbiased. B̂² and V̂ are means over pairs of replicates: the jackknife is unbiased for their part that is linear in each
/// replicate, which is all that matters for B̂² where bias exceeds noise. The other part it overestimates, never the
/// reverse: without any bias, the variance of the mean B̂² by 2(R−1)/(R−2), that of V̂ of normal values by (R−1)/(R−2).
///
/// **The reference's share** for B̂² and squared error is made of L_k = mean of w(D̄−B)(P_k−A)/√(n_A(n_A−1)) for the parts of
/// A, likewise for B, and of the product term, in the sign in which [`ReferenceShare`]s of squared errors are combined; for
/// the signed bias of −p·√w(P_k−A)/√(n_A(n_A−1)), p = n_A/(n_A+n_B).
#[derive(Debug, Clone, PartialEq)]
pub struct BiasVarianceTotal {
    /// Pixel-channels behind the means.
    pub pixel_channels: u64,
    /// Mean of √w(D̄ − r): signed, in the unit of the roots of the others.
    pub bias: Estimated,
    /// Mean of w·B̂²; absent where the reference's noise is unknown.
    pub squared_bias: Option<Estimated>,
    /// Mean of w·V̂, the variance of one replicate.
    pub variance: Estimated,
    /// Mean of w(D_r−A)(D_r−B) over replicates, the sum of the two; absent like the squared bias.
    pub mse: Option<Estimated>,
}
