//! What the noise of one common reference adds to errors, and to anything that is made from several of them.

use serde::{Deserialize, Serialize};

/// What the reference's own noise contributes to one error, or to a mean of errors on the same scene.
///
/// All errors against one reference share its noise: what it adds to a contrast Σ wᵢ·eᵢ, such as a log ratio
/// (w = 1/e) or a slope, is not the sum of the single variances. With influences it is exact to first order, see
/// [`ReferenceShare::combined`].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ReferenceShare {
    /// Standard error that the reference contributes to the error alone; 0 where nothing is known.
    pub standard_error: f64,
    /// Influence of each independent part of the reference, in the unit of the error, scaled so that their squares add
    /// up to a variance (that contains the product term once too often, see `product`). In the same order for all
    /// errors against a reference; empty where the reference has no parts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<f64>,
    /// Standard deviation of the term that is the product of the noise of both halves: `parts` holds its variance
    /// twice, because each half's influences are taken with the noisy residual to the other half. It is the same term
    /// for all errors against a reference, so it adds up with its sign.
    #[serde(default)]
    pub product: f64,
}

impl From<f64> for ReferenceShare {
    /// A standard error of which the parts are unknown; what is not a positive number counts as none.
    fn from(standard_error: f64) -> Self {
        Self { standard_error: standard_error.max(0.0), ..Self::default() }
    }
}

impl ReferenceShare {
    /// Whether the influences of the parts are known.
    #[must_use]
    pub fn has_parts(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The share in `factor` times the error.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            standard_error: self.standard_error * factor.abs(),
            parts: self.parts.iter().map(|l| l * factor).collect(),
            product: self.product * factor,
        }
    }

    /// The share in the mean of errors over replicates, which have the same reference: influences are averaged, and so
    /// are the single standard errors. Influences are dropped unless all have as many. `None` without any.
    #[must_use]
    pub fn mean(shares: &[Self]) -> Option<Self> {
        let n = shares.len() as f64;
        let first = shares.first()?;
        let standard_error = shares.iter().map(|s| s.standard_error).sum::<f64>() / n; // not empty
        let count = first.parts.len();
        if shares.iter().any(|s| s.parts.len() != count) {
            return Some(Self::from(standard_error));
        }
        let parts = (0..count).map(|k| shares.iter().map(|s| s.parts[k]).sum::<f64>() / n).collect();
        let product = shares.iter().map(|s| s.product).sum::<f64>() / n;
        Some(Self { standard_error, parts, product })
    }

    /// The share in Σ wᵢ·eᵢ of errors against the same reference.
    ///
    /// With influences the variance is Σ_k (Σᵢ wᵢ·L_ik)² − P², P = Σᵢ wᵢ·productᵢ, and at least P²: the product term is
    /// in the influences of either half. Unless all of them have as many influences, the single variances are added
    /// as if they were independent, which is too much for errors that move together and too little for errors that
    /// move against each other (by up to √2 in the standard error of a ratio). Errors without any share add nothing.
    #[must_use]
    pub fn combined(terms: &[(f64, &Self)]) -> Self {
        let noisy = || terms.iter().filter(|(_, share)| share.has_parts() || share.standard_error > 0.0);
        let count = noisy().next().map_or(0, |(_, share)| share.parts.len());
        if count == 0 || noisy().any(|(_, share)| share.parts.len() != count) {
            return Self::from(noisy().fold(0.0f64, |sum, (w, share)| sum.hypot(w * share.standard_error)));
        }
        let parts: Vec<f64> =
            (0..count).map(|k| noisy().map(|(w, share)| w * share.parts[k]).sum()).collect();
        let product: f64 = noisy().map(|(w, share)| w * share.product).sum();
        let least = product * product;
        let variance = (parts.iter().map(|l| l * l).sum::<f64>() - least).max(least);
        Self { standard_error: variance.sqrt(), parts, product }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;

    fn share(parts: &[f64], product: f64) -> ReferenceShare {
        ReferenceShare { standard_error: 1.0, parts: parts.to_vec(), product }
    }

    #[test]
    fn what_is_common_cancels_and_what_is_opposite_adds() {
        let (a, b) = (share(&[3.0, 4.0], 0.0), share(&[-3.0, -4.0], 0.0));
        assert_eq!(ReferenceShare::combined(&[(1.0, &a)]).standard_error, 5.0);
        assert_eq!(ReferenceShare::combined(&[(1.0, &a), (-1.0, &a)]).standard_error, 0.0);
        assert_eq!(ReferenceShare::combined(&[(1.0, &a), (-1.0, &b)]).standard_error, 10.0);
        // Without parts the two are taken as independent: √2 too little for the last.
        let alone = ReferenceShare::from(5.0);
        let sum = ReferenceShare::combined(&[(1.0, &alone), (-1.0, &alone)]).standard_error;
        assert!((sum - 50f64.sqrt()).abs() < 1e-12);
        let exact = ReferenceShare::default();
        assert_eq!(ReferenceShare::combined(&[(2.0, &a), (1.0, &exact)]).standard_error, 10.0);
        assert_eq!(ReferenceShare::combined(&[]).standard_error, 0.0);
        assert_eq!(ReferenceShare::from(f64::NAN).standard_error, 0.0);
    }

    #[test]
    fn means_and_multiples_keep_the_parts() {
        let mean = ReferenceShare::mean(&[share(&[1.0, 3.0], 0.5), share(&[3.0, -1.0], 1.5)]).unwrap();
        assert_eq!((mean.parts, mean.product, mean.standard_error), (vec![2.0, 1.0], 1.0, 1.0));
        let mixed = ReferenceShare::mean(&[share(&[1.0], 0.0), ReferenceShare::from(3.0)]).unwrap();
        assert_eq!(mixed, ReferenceShare::from(2.0));
        assert_eq!(ReferenceShare::mean(&[]), None);
        let twice = share(&[1.0, -2.0], 0.5).scaled(-2.0);
        assert_eq!((twice.parts, twice.product, twice.standard_error), (vec![-2.0, 4.0], -1.0, 2.0));
    }

    /// Errors Σ_p (d_p − α_p)(d_p − β_p)/n of pixels against a reference in 4 + 4 normal parts, with what the formula
    /// says of the log ratio of two of them, with halves of standard deviation `sd`; over many references the stated variance is the actual one.
    fn log_ratio(d: [f64; 2], sd: f64) -> (f64, f64) {
        const PIXELS: usize = 400;
        const PARTS: usize = 4;
        let mut normals = Normals::new(11);
        let (mut logs, mut stated) = (Vec::new(), 0.0);
        let draws = 1500;
        for _ in 0..draws {
            let mut half = || -> Vec<[f64; PARTS]> {
                (0..PIXELS)
                    .map(|_| std::array::from_fn(|_| sd * (PARTS as f64).sqrt() * normals.next()))
                    .collect()
            };
            let halves = [half(), half()];
            let mean = |p: &[f64; PARTS]| p.iter().sum::<f64>() / PARTS as f64;
            let n = PIXELS as f64;
            let scale = n * ((PARTS * (PARTS - 1)) as f64).sqrt();
            let mut product = 0.0;
            for k in 0..PARTS * PARTS {
                let (k, l) = (k / PARTS, k % PARTS);
                let pairs = halves[0].iter().zip(&halves[1]);
                let sum: f64 = pairs.map(|(a, b)| (a[k] - mean(a)) * (b[l] - mean(b))).sum();
                product += (sum / (n * (PARTS * (PARTS - 1)) as f64)).powi(2);
            }
            let measure = |d: f64| {
                let pairs = || halves[0].iter().zip(&halves[1]);
                let error = pairs().map(|(a, b)| (d - mean(a)) * (d - mean(b))).sum::<f64>() / n;
                let of_a = (0..PARTS)
                    .map(|k| pairs().map(|(a, b)| (d - mean(b)) * (a[k] - mean(a))).sum::<f64>() / scale);
                let of_b = (0..PARTS)
                    .map(|k| pairs().map(|(a, b)| (d - mean(a)) * (b[k] - mean(b))).sum::<f64>() / scale);
                let parts = of_a.chain(of_b).collect();
                (error, ReferenceShare { standard_error: 0.0, parts, product: product.sqrt() })
            };
            let ((a, share_a), (b, share_b)) = (measure(d[0]), measure(d[1]));
            logs.push((a / b).ln());
            let log = ReferenceShare::combined(&[(1.0 / a, &share_a), (-1.0 / b, &share_b)]);
            stated += log.standard_error.powi(2) / f64::from(draws);
        }
        (stated, crate::interval::mean_and_variance(&logs).unwrap().1)
    }

    #[test]
    fn the_log_ratio_of_methods_with_opposite_biases_spreads_as_stated() {
        // Opposite biases of 0.1, as large as the noise of a half: the two errors move against each other.
        // Elsewhere with less noise, so that the cut at the product term, which widens, hardly ever acts.
        for (d, sd) in [
            ([0.1, -0.1], 0.1),
            ([0.1, -0.1], 0.03),
            ([0.1, 0.1], 0.1),
            ([0.1, 0.2], 0.03),
            ([-0.1, 0.3], 0.03),
        ] {
            let (stated, actual) = log_ratio(d, sd);
            if d[0] == d[1] {
                assert!(stated < 1e-20 && actual < 1e-20, "{stated} {actual}");
                continue;
            }
            // An empirical variance over 1500 draws has a relative standard error of √(2/1499) = 0.037, a stated one
            // (6 degrees of freedom each) of √(2/6/1500) = 0.015; second order in the relative error of each value
            // (at most 10 %) adds 1 to 2 %.
            let off = stated / actual - 1.0;
            assert!(off.abs() < 4.0 * 0.04 + 0.02, "{d:?} {sd}: {off} from {stated} and {actual}");
        }
    }
}
