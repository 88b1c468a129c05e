//! How much of a metric's uncertainty is the reference's own: common to all replicates, so no average removes
//! it.
//!
//! Notation, per pixel and channel: d = x − μ the true residual, A = μ + α and B = μ + β the halves. The
//! corrected squared error (x−A)(x−B) = d² − d(α+β) + αβ is unbiased; what the reference adds is the spread
//! of the weighted mean of −d(α+β) + αβ.
//!
//! With independent parts P_k (at least 2 per half) the sum is linear in each half, so deleting one part at a
//! time has a closed form: V_A = Σ_k L_k² with L_k the weighted mean of (x−B)(P_k−A) over √(n_A(n_A−1)), likewise V_B
//! (delete-one jackknife, Miller 1974, per half; see `influence.rs` for the relative error, which is not linear). Both
//! contain the product term αβ; V_AB, estimated from the doubly centred products, takes it out once: V = V_A + V_B −
//! V_AB, and never less than V_AB.
//!
//! With halves only, (x−(A+B)/2)(A−B) has the same variance as what the reference adds (exactly so for normal
//! noise of equal halves); its sums over blocks of 32×32 pixels count as independent.
//!
//! With a variance v only, (x−r)² − v has the variance 4d²v + 2v² for normal noise, estimated without bias by
//! 4(x−r)²v − 2v². Pixels count as independent, and the channels of a pixel as erring alike: three times the
//! sum over channels, an upper limit.

use std::collections::BTreeMap;

use noisefloor_frame::{Image, SquaredError};

use crate::blocks::blocks;
use crate::contribution::{Contribution, Contributions};
use crate::measured::Values;
use crate::pixels::Pixels;
use crate::truth::{Truth, halves_term};

/// Parts of the reference relative to the mean of their half, and the weighted variance of the product term.
#[derive(Debug, Default)]
pub(crate) struct ReferenceNoise {
    /// P_k − A for the parts of half A, P_k − B for those of half B; all planes; empty without enough parts.
    pub(crate) centred: [Vec<Vec<f32>>; 2],
    /// V_AB for weight 1 and for weight 1/(max(r,0)²+ε).
    pub(crate) product: [f64; 2],
    /// The same over the pixels of each class.
    pub(crate) class_products: Vec<[f64; 2]>,
}

impl ReferenceNoise {
    pub(crate) fn new(truth: &Truth<'_>) -> Self {
        let parts = &truth.reference.parts;
        let Some([a, b]) = &truth.reference.frame.color.halves else { return Self::default() };
        let Some(in_a) = truth.parts_in_a() else { return Self::default() };
        let centre = |parts: &[Image], half: &Image| -> Vec<Vec<f32>> {
            let differences = |part: &Image| {
                let valid = truth.valid.iter().cycle();
                let pairs = part.data().iter().zip(half.data()).zip(valid);
                pairs.map(|((p, h), &ok)| if ok { p - h } else { 0.0 }).collect()
            };
            parts.iter().map(differences).collect()
        };
        let centred = [centre(&parts[..in_a], a), centre(&parts[in_a..], b)];
        let used = count(&truth.valid);
        let mut product = [0.0; 2];
        let mut classes = ClassProducts::new(truth);
        for left in &centred[0] {
            for right in &centred[1] {
                let values: Vec<f64> =
                    left.iter().zip(right).map(|(&l, &r)| f64::from(l) * f64::from(r)).collect();
                product[0] += (values.iter().sum::<f64>() / used).powi(2);
                product[1] += (dot(&values, &truth.weight) / used).powi(2);
                classes.add(truth, &values);
            }
        }
        let (na, nb) = (centred[0].len() as f64, centred[1].len() as f64);
        // Both halves have at least 2 parts.
        let pairs = na * (na - 1.0) * nb * (nb - 1.0);
        let product = product.map(|sum| sum / pairs);
        let class_products = classes.sums.iter().map(|sums| sums.map(|sum| sum / pairs)).collect();
        Self { centred, product, class_products }
    }

    /// Metric id to standard error from the reference, for a test image whose `mse` is known.
    pub(crate) fn standard_errors(
        &self,
        truth: &Truth<'_>,
        test: &Image,
        errors: &Pixels<'_>,
        values: &Values,
        contributions: &Contributions,
    ) -> BTreeMap<String, f64> {
        let valid = errors.valid.as_slice();
        let mse = values["mse"].unwrap_or(0.0);
        let variance_of = |id: &str| contributions.get(id).and_then(Contribution::variance).unwrap_or(0.0);
        let variances = match truth.squared_error() {
            SquaredError::Exact | SquaredError::Uncorrected => return BTreeMap::new(),
            SquaredError::Halves if !self.centred[0].is_empty() => ["mse", "relmse"].map(variance_of),
            SquaredError::Halves => from_halves(truth, test, valid),
            SquaredError::SubtractVariance => from_variance(truth, test, valid),
        };
        let mut out = named(variances.map(f64::sqrt), mse);
        if let Some(energy) = values["energy"] {
            let variance = match truth.squared_error() {
                SquaredError::Halves if !self.centred[0].is_empty() => variance_of("energy"),
                _ => (energy / mean_of_valid(&errors.truth, valid)).powi(2) * mean_variance(truth, valid),
            };
            out.insert("energy".to_owned(), variance.sqrt());
        }
        let trimmed = contributions.get("relmse_trimmed").and_then(Contribution::variance);
        out.extend(trimmed.map(|variance| ("relmse_trimmed".to_owned(), variance.sqrt())));
        out
    }

    /// The same for an image that equals the truth.
    pub(crate) fn floor(&self, truth: &Truth<'_>) -> BTreeMap<String, f64> {
        let variances = match truth.squared_error() {
            SquaredError::Exact | SquaredError::Uncorrected => return BTreeMap::new(),
            SquaredError::Halves if !self.centred[0].is_empty() => self.product,
            SquaredError::Halves => product_from_halves(truth),
            SquaredError::SubtractVariance => product_from_variance(truth, &truth.valid),
        };
        named(variances.map(f64::sqrt), 0.0)
    }
}

/// V_AB over the pixels of each class, before division.
struct ClassProducts {
    /// Values in each class.
    counts: Vec<f64>,
    sums: Vec<[f64; 2]>,
}

impl ClassProducts {
    fn new(truth: &Truth<'_>) -> Self {
        let names = truth.classes.map_or(0, |classes| classes.names.len());
        let mut counts = vec![0.0; names];
        if let Some(classes) = &truth.classes {
            let valid = truth.valid.iter().zip(classes.of_pixel).filter(|(ok, _)| **ok);
            valid.for_each(|(_, &class)| counts[usize::from(class)] += 3.0);
        }
        Self { counts, sums: vec![[0.0; 2]; names] }
    }

    fn add(&mut self, truth: &Truth<'_>, values: &[f64]) {
        let Some(classes) = &truth.classes else { return };
        let mut means = vec![[0.0; 2]; self.sums.len()];
        for ((&value, w), &class) in values.iter().zip(&truth.weight).zip(classes.of_pixel.iter().cycle()) {
            let mean = &mut means[usize::from(class)];
            (mean[0], mean[1]) = (mean[0] + value, mean[1] + value * w);
        }
        for ((sums, mean), count) in self.sums.iter_mut().zip(means).zip(&self.counts) {
            sums.iter_mut().zip(mean).for_each(|(sum, mean)| *sum += (mean / count.max(1.0)).powi(2));
        }
    }
}

/// Values that enter a mean: three channels of each valid pixel, at least 1 so that means of nothing are 0.
fn count(valid: &[bool]) -> f64 {
    (3 * valid.iter().filter(|&&ok| ok).count()).max(1) as f64
}

/// Mean over the pixels that take part.
fn mean_of_valid(values: &[f64], valid: &[bool]) -> f64 {
    let sum: f64 = values.iter().zip(valid).filter(|(_, ok)| **ok).map(|(value, _)| value).sum();
    3.0 * sum / count(valid)
}

/// Variance of the reference's mean over all pixels and channels: from block sums of (A−B)/2, or from its variance.
fn mean_variance(truth: &Truth<'_>, valid: &[bool]) -> f64 {
    let color = &truth.reference.frame.color;
    match (truth.squared_error(), &color.halves, &color.variance) {
        (SquaredError::Halves, Some([a, b]), _) => {
            block_variance(truth, valid, |i| [0.5 * (f64::from(a.data()[i]) - f64::from(b.data()[i])), 0.0])
                [0]
        }
        (SquaredError::SubtractVariance, _, Some(variance)) => {
            let variance = variance.mean_variance().data();
            pixel_variance(truth, valid, |i| f64::from(variance[i]).max(0.0))[0]
        }
        _ => 0.0,
    }
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

/// Block sums of (x−(A+B)/2)(A−B), squared and added, over the squared count; and of the relative error's term.
fn from_halves(truth: &Truth<'_>, test: &Image, valid: &[bool]) -> [f64; 2] {
    let Some([a, b]) = &truth.reference.frame.color.halves else { return [0.0; 2] };
    block_variance(truth, valid, |i| {
        let (x, a, b) = (f64::from(test.data()[i]), f64::from(a.data()[i]), f64::from(b.data()[i]));
        [(x - 0.5 * (a + b)) * (a - b), halves_term(truth, i, x, a, b)]
    })
}

/// For a perfect image only αβ is left, of variance σ⁴, where E(A−B)⁴ = 12σ⁴ for normal noise of equal
/// halves.
fn product_from_halves(truth: &Truth<'_>) -> [f64; 2] {
    let Some([a, b]) = &truth.reference.frame.color.halves else { return [0.0; 2] };
    pixel_variance(truth, &truth.valid, |i| (f64::from(a.data()[i]) - f64::from(b.data()[i])).powi(4) / 12.0)
}

/// Sum over pixels and channels of a variance per value, three times because the channels of a pixel may err
/// alike, over the squared count; for both weights.
fn pixel_variance(truth: &Truth<'_>, valid: &[bool], variance: impl Fn(usize) -> f64) -> [f64; 2] {
    let n = valid.len();
    let mut sums = [0.0; 2];
    for p in (0..n).filter(|&p| valid[p]) {
        for i in [p, n + p, 2 * n + p] {
            let value = 3.0 * variance(i);
            sums[0] += value;
            sums[1] += value * truth.weight[i].powi(2);
        }
    }
    sums.map(|sum| sum / count(valid).powi(2))
}

fn block_variance(truth: &Truth<'_>, valid: &[bool], terms: impl Fn(usize) -> [f64; 2]) -> [f64; 2] {
    let n = valid.len();
    let mut sums = [0.0; 2];
    for block in blocks(truth.mean.width(), truth.mean.height(), |p| valid[p]) {
        let mut totals = [0.0; 2];
        for i in block.iter().flat_map(|p| [*p, n + p, 2 * n + p]) {
            totals.iter_mut().zip(terms(i)).for_each(|(total, term)| *total += term);
        }
        sums.iter_mut().zip(totals).for_each(|(sum, total)| *sum += total * total);
    }
    sums.map(|sum| sum / count(valid).powi(2))
}

/// 4(x−r)²v − 2v² summed over the image, and at least the 2v² that stays for a perfect image.
fn from_variance(truth: &Truth<'_>, test: &Image, valid: &[bool]) -> [f64; 2] {
    let Some(variance) = &truth.reference.frame.color.variance else { return [0.0; 2] };
    let variance = variance.mean_variance().data();
    let estimate = pixel_variance(truth, valid, |i| {
        let v = f64::from(variance[i]).max(0.0);
        let e = f64::from(test.data()[i]) - f64::from(truth.mean.data()[i]);
        4.0 * e * e * v - 2.0 * v * v
    });
    let least = product_from_variance(truth, valid);
    [0, 1].map(|k| estimate[k].max(least[k]))
}

fn product_from_variance(truth: &Truth<'_>, valid: &[bool]) -> [f64; 2] {
    let Some(variance) = &truth.reference.frame.color.variance else { return [0.0; 2] };
    let variance = variance.mean_variance().data();
    pixel_variance(truth, valid, |i| 2.0 * f64::from(variance[i]).powi(2))
}
