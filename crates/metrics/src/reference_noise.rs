//! How much of a metric's uncertainty is the reference's own: common to all replicates, so no average removes
//! it.
//!
//! Notation, per pixel and channel: d = x − μ the true residual, A = μ + α and B = μ + β the halves. The
//! corrected squared error (x−A)(x−B) = d² − d(α+β) + αβ is unbiased; what the reference adds is the spread
//! of the weighted mean of −d(α+β) + αβ.
//!
//! With independent parts P_k (at least 2 per half) the sum is linear in each half, so deleting one part at a
//! time has a closed form: V_A = Σ_k L_k²/(n_A(n_A−1)) with L_k the weighted mean of (x−B)(P_k−A), likewise
//! V_B (delete-one jackknife, Miller 1974, per half). Both contain the product term αβ; V_AB, estimated from
//! the doubly centred products, takes it out once: V = V_A + V_B − V_AB, and never less than V_AB.
//!
//! With halves only, (x−(A+B)/2)(A−B) has the same variance as what the reference adds (exactly so for normal
//! noise of equal halves); its sums over blocks of 32×32 pixels count as independent.
//!
//! With a variance v only, (x−r)² − v has the variance 4d²v + 2v² for normal noise, estimated without bias by
//! 4(x−r)²v − 2v². Pixels count as independent, and the channels of a pixel as erring alike: three times the
//! sum over channels, an upper limit.

use std::collections::BTreeMap;

use noisefloor_frame::{Image, SquaredError, Variance};

use crate::bootstrap::blocks;
use crate::measurer::Measurer;

/// Parts of the reference relative to the mean of their half, and the weighted variance of the product term.
#[derive(Debug, Default)]
pub(crate) struct ReferenceNoise {
    /// P_k − A for the parts of half A, P_k − B for those of half B; all planes; empty without enough parts.
    centred: [Vec<Vec<f32>>; 2],
    /// V_AB for weight 1 and for weight 1/(max(r,0)²+ε).
    product: [f64; 2],
}

impl ReferenceNoise {
    pub(crate) fn new(measurer: &Measurer<'_>) -> Self {
        let parts = &measurer.reference.parts;
        let in_a = parts.len().div_ceil(2);
        let Some([a, b]) = &measurer.reference.frame.color.halves else { return Self::default() };
        if parts.len() < 4 {
            return Self::default();
        }
        let centre = |parts: &[Image], half: &Image| -> Vec<Vec<f32>> {
            let differences = |part: &Image| {
                let valid = measurer.valid.iter().cycle();
                let pairs = part.data().iter().zip(half.data()).zip(valid);
                pairs.map(|((p, h), &ok)| if ok { p - h } else { 0.0 }).collect()
            };
            parts.iter().map(differences).collect()
        };
        let centred = [centre(&parts[..in_a], a), centre(&parts[in_a..], b)];
        let used = count(&measurer.valid);
        let mut product = [0.0; 2];
        for left in &centred[0] {
            for right in &centred[1] {
                let values: Vec<f64> =
                    left.iter().zip(right).map(|(&l, &r)| f64::from(l) * f64::from(r)).collect();
                product[0] += (values.iter().sum::<f64>() / used).powi(2);
                product[1] += (dot(&values, &measurer.weight) / used).powi(2);
            }
        }
        let (na, nb) = (centred[0].len() as f64, centred[1].len() as f64);
        // Both halves have at least 2 parts.
        let product = product.map(|sum| sum / (na * (na - 1.0) * nb * (nb - 1.0)));
        Self { centred, product }
    }

    /// Metric id to standard error from the reference, for a test image whose `mse` is known.
    pub(crate) fn standard_errors(
        &self,
        measurer: &Measurer<'_>,
        test: &Image,
        valid: &[bool],
        mse: f64,
    ) -> BTreeMap<String, f64> {
        let variances = match measurer.squared_error() {
            SquaredError::Exact | SquaredError::Uncorrected => return BTreeMap::new(),
            SquaredError::Halves if !self.centred[0].is_empty() => self.jackknife(measurer, test, valid),
            SquaredError::Halves => from_halves(measurer, test, valid),
            SquaredError::SubtractVariance => from_variance(measurer, test, valid),
        };
        named(variances.map(f64::sqrt), mse)
    }

    /// The same for an image that equals the truth.
    pub(crate) fn floor(&self, measurer: &Measurer<'_>) -> BTreeMap<String, f64> {
        let variances = match measurer.squared_error() {
            SquaredError::Exact | SquaredError::Uncorrected => return BTreeMap::new(),
            SquaredError::Halves if !self.centred[0].is_empty() => self.product,
            SquaredError::Halves => product_from_halves(measurer),
            SquaredError::SubtractVariance => product_from_variance(measurer, &measurer.valid),
        };
        named(variances.map(f64::sqrt), 0.0)
    }

    /// Mean of var(r)/(max(r,0)²+ε).
    pub(crate) fn bias(&self, measurer: &Measurer<'_>) -> BTreeMap<String, f64> {
        let frame = &measurer.reference.frame;
        let from_halves = || {
            let halves = frame.color.halves.as_ref()?;
            Variance::from_halves(halves, &frame.samples).ok()
        };
        let Some(variance) = frame.color.variance.clone().or_else(from_halves) else {
            return BTreeMap::new();
        };
        let values = variance.mean_variance().data();
        let terms = values.iter().zip(&measurer.weight).zip(measurer.valid.iter().cycle());
        let sum: f64 = terms.filter(|(_, ok)| **ok).map(|((&v, w), _)| f64::from(v) * w).sum();
        [("relmse".to_owned(), sum / count(&measurer.valid))].into()
    }

    fn jackknife(&self, measurer: &Measurer<'_>, test: &Image, valid: &[bool]) -> [f64; 2] {
        let Some(halves) = &measurer.reference.frame.color.halves else { return [0.0; 2] };
        let used = count(valid);
        let mut variances = [0.0; 2];
        // Parts of A multiply the residual to B, and the other way round.
        for (parts, other) in self.centred.iter().zip([&halves[1], &halves[0]]) {
            let residual: Vec<f64> = test
                .data()
                .iter()
                .zip(other.data())
                .zip(valid.iter().cycle())
                .map(|((&x, &r), &ok)| if ok { f64::from(x) - f64::from(r) } else { 0.0 })
                .collect();
            let weighted: Vec<f64> = residual.iter().zip(&measurer.weight).map(|(e, w)| e * w).collect();
            // Piece by piece, so that each piece of the residuals stays in the cache for all parts.
            let mut sums = vec![[0.0; 2]; parts.len()];
            for start in (0..residual.len()).step_by(PIECE) {
                let piece = start..(start + PIECE).min(residual.len());
                for (sums, part) in sums.iter_mut().zip(parts) {
                    sums[0] += dot(&residual[piece.clone()], &part[piece.clone()]);
                    sums[1] += dot(&weighted[piece.clone()], &part[piece.clone()]);
                }
            }
            let n = parts.len() as f64; // at least 2
            for (k, variance) in variances.iter_mut().enumerate() {
                *variance += sums.iter().map(|s| (s[k] / used).powi(2)).sum::<f64>() / (n * (n - 1.0));
            }
        }
        [0, 1].map(|k| (variances[k] - self.product[k]).max(self.product[k]))
    }
}

/// Values in a piece of a sum.
const PIECE: usize = 2048;

/// Values that enter a mean: three channels of each valid pixel, at least 1 so that means of nothing are 0.
fn count(valid: &[bool]) -> f64 {
    (3 * valid.iter().filter(|&&ok| ok).count()).max(1) as f64
}

/// Names the standard errors of MSE and rMSE; that of RMSE is how far the root moves with them.
fn named([mse_error, relmse_error]: [f64; 2], mse: f64) -> BTreeMap<String, f64> {
    let mse = mse.max(0.0);
    let rmse_error = (mse + mse_error).sqrt() - mse.sqrt();
    [("mse", mse_error), ("rmse", rmse_error), ("relmse", relmse_error)]
        .map(|(id, value)| (id.to_owned(), value))
        .into()
}

/// Sum of products in eight fixed lanes, so that it vectorises and the bits do not depend on how.
fn dot<T: Copy + Into<f64>>(a: &[f64], b: &[T]) -> f64 {
    const LANES: usize = 8;
    let mut lanes = [0.0; LANES];
    let (a_chunks, b_chunks) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a_chunks.remainder().iter().zip(b_chunks.remainder()).map(|(x, &y)| x * y.into()).sum();
    for (x, y) in a_chunks.zip(b_chunks) {
        for ((lane, x), &y) in lanes.iter_mut().zip(x).zip(y) {
            *lane += x * y.into();
        }
    }
    lanes.iter().sum::<f64>() + rest
}

/// Block sums of w·(x−(A+B)/2)(A−B), squared and added, over the squared count; for both weights.
fn from_halves(measurer: &Measurer<'_>, test: &Image, valid: &[bool]) -> [f64; 2] {
    let Some([a, b]) = &measurer.reference.frame.color.halves else { return [0.0; 2] };
    block_variance(measurer, valid, |i| {
        let (x, a, b) = (f64::from(test.data()[i]), f64::from(a.data()[i]), f64::from(b.data()[i]));
        (x - 0.5 * (a + b)) * (a - b)
    })
}

/// For a perfect image only αβ is left, of variance σ⁴, where E(A−B)⁴ = 12σ⁴ for normal noise of equal
/// halves.
fn product_from_halves(measurer: &Measurer<'_>) -> [f64; 2] {
    let Some([a, b]) = &measurer.reference.frame.color.halves else { return [0.0; 2] };
    pixel_variance(measurer, &measurer.valid, |i| {
        (f64::from(a.data()[i]) - f64::from(b.data()[i])).powi(4) / 12.0
    })
}

/// Sum over pixels and channels of a variance per value, three times because the channels of a pixel may err
/// alike, over the squared count; for both weights.
fn pixel_variance(measurer: &Measurer<'_>, valid: &[bool], variance: impl Fn(usize) -> f64) -> [f64; 2] {
    let n = valid.len();
    let mut sums = [0.0; 2];
    for p in (0..n).filter(|&p| valid[p]) {
        for i in [p, n + p, 2 * n + p] {
            let value = 3.0 * variance(i);
            sums[0] += value;
            sums[1] += value * measurer.weight[i].powi(2);
        }
    }
    sums.map(|sum| sum / count(valid).powi(2))
}

fn block_variance(measurer: &Measurer<'_>, valid: &[bool], term: impl Fn(usize) -> f64) -> [f64; 2] {
    let n = valid.len();
    let mut sums = [0.0; 2];
    for block in blocks(measurer.mean.width(), measurer.mean.height(), |p| valid[p]) {
        let mut totals = [0.0; 2];
        for i in block.iter().flat_map(|p| [*p, n + p, 2 * n + p]) {
            let value = term(i);
            totals[0] += value;
            totals[1] += value * measurer.weight[i];
        }
        sums.iter_mut().zip(totals).for_each(|(sum, total)| *sum += total * total);
    }
    sums.map(|sum| sum / count(valid).powi(2))
}

/// 4(x−r)²v − 2v² summed over the image, and at least the 2v² that stays for a perfect image.
fn from_variance(measurer: &Measurer<'_>, test: &Image, valid: &[bool]) -> [f64; 2] {
    let Some(variance) = &measurer.reference.frame.color.variance else { return [0.0; 2] };
    let variance = variance.mean_variance().data();
    let estimate = pixel_variance(measurer, valid, |i| {
        let v = f64::from(variance[i]).max(0.0);
        let e = f64::from(test.data()[i]) - f64::from(measurer.mean.data()[i]);
        4.0 * e * e * v - 2.0 * v * v
    });
    let least = product_from_variance(measurer, valid);
    [0, 1].map(|k| estimate[k].max(least[k]))
}

fn product_from_variance(measurer: &Measurer<'_>, valid: &[bool]) -> [f64; 2] {
    let Some(variance) = &measurer.reference.frame.color.variance else { return [0.0; 2] };
    let variance = variance.mean_variance().data();
    pixel_variance(measurer, valid, |i| 2.0 * f64::from(variance[i]).powi(2))
}
