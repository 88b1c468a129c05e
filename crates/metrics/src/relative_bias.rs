//! The bias that the noisy denominator gives to relative squared errors, estimated so that it can be taken out.
//!
//! Notation, per pixel and channel: x the image, A and B the halves of the reference, r = pA + qB its mean (p, q the
//! halves' shares of the samples), f(r) = 1/(max(r,0)²+ε), μ the truth, d = x − μ, v the variance of r. The estimate
//! T = (x−A)(x−B)·f(r) has an unbiased numerator, yet E T − d²f(μ) = v·(½f″d² − 2f′d) + …: the mean of f is not f of the
//! mean, and numerator and denominator share their noise.
//!
//! **From parts** (at least 2 per half): T is a smooth function of the means of two independent samples, the parts of A
//! and those of B. The jackknife of such a function (Miller 1974) deletes one part at a time, in either half, with p and q
//! kept: C = Σ over halves (n−1)·(mean_k T₍ₖ₎ − T), n the half's parts. T − C has no bias of first order in 1/n, whatever
//! the distribution. It needs no variance and no derivative.
//!
//! **Without parts** the same term by the delta method, with all that it depends on estimated: C = v·(½f″(r)·N −
//! 2f′(r)·(x−r)), N the corrected squared error. v is the stated variance of independent samples, else that between the
//! halves.
//!
//! Either way C is a quadratic polynomial in x − r whose coefficients depend on the reference alone.

use noisefloor_frame::{Sampling, SquaredError, Variance};

use crate::truth::Truth;
use crate::weight::{weight, weight_curvature, weight_slope};

/// Coefficients of the estimated bias, for all planes; empty where there is nothing to correct with.
#[derive(Debug, Default)]
pub(crate) struct RelativeBias {
    coefficients: Vec<[f64; 3]>,
}

impl RelativeBias {
    pub(crate) fn new(truth: &Truth<'_>) -> Self {
        let coefficients = match truth.squared_error() {
            SquaredError::Exact | SquaredError::Uncorrected => None,
            SquaredError::Halves if truth.parts_in_a().is_some() => jackknife(truth),
            SquaredError::Halves | SquaredError::SubtractVariance => delta(truth),
        };
        Self { coefficients: coefficients.unwrap_or_default() }
    }

    /// Whether a bias is estimated at all.
    pub(crate) fn is_known(&self) -> bool {
        !self.coefficients.is_empty()
    }

    /// The bias at planar index `i` for a residual `y` = x − r.
    #[inline]
    pub(crate) fn at(&self, i: usize, y: f64) -> f64 {
        self.coefficients.get(i).map_or(0.0, |[k0, k1, k2]| k0 + y * (k1 + y * k2))
    }
}

/// factor·(y−a)(y−b) as coefficients of y.
fn product(factor: f64, a: f64, b: f64) -> [f64; 3] {
    [factor * a * b, -factor * (a + b), factor]
}

fn jackknife(truth: &Truth<'_>) -> Option<Vec<[f64; 3]>> {
    let [a, b] = truth.reference.frame.color.halves.as_ref()?;
    let (parts, in_a) = (&truth.reference.parts, truth.parts_in_a()?);
    let share = in_a as f64 / parts.len() as f64; // at least 4 parts
    let of = |i: usize| {
        let (r, valid) = (f64::from(truth.mean.data()[i]), truth.valid[i % truth.valid.len()]);
        if !valid {
            return [0.0; 3];
        }
        let (half_a, half_b) = (f64::from(a.data()[i]), f64::from(b.data()[i]));
        let whole = product(truth.weight[i], half_a - r, half_b - r);
        let mut sum = [0.0; 3];
        for (k, part) in parts.iter().enumerate() {
            let of_a = k < in_a;
            let (half, share, n) = if of_a {
                (half_a, share, in_a as f64)
            } else {
                (half_b, 1.0 - share, (parts.len() - in_a) as f64)
            };
            // Both halves have at least 2 parts.
            let step = (f64::from(part.data()[i]) - half) / (n - 1.0);
            let (moved_a, moved_b) = if of_a { (half_a - step, half_b) } else { (half_a, half_b - step) };
            let without = product(weight(r - share * step), moved_a - r, moved_b - r);
            for ((sum, without), whole) in sum.iter_mut().zip(without).zip(whole) {
                *sum += (n - 1.0) / n * (without - whole);
            }
        }
        sum
    };
    Some((0..truth.mean.data().len()).map(of).collect())
}

fn delta(truth: &Truth<'_>) -> Option<Vec<[f64; 3]>> {
    let frame = &truth.reference.frame;
    let color = &frame.color;
    let from_halves = || Variance::from_halves(color.halves.as_ref()?, &frame.samples).ok();
    // Of low-discrepancy samples s²/n is not the variance of the mean.
    let variance = match frame.sampling {
        Sampling::Independent => color.variance.clone().or_else(from_halves),
        Sampling::LowDiscrepancy => from_halves().or_else(|| color.variance.clone()),
    }?;
    let of = |i: usize| {
        let (r, v) = (f64::from(truth.mean.data()[i]), f64::from(variance.mean_variance().data()[i]));
        if !truth.valid[i % truth.valid.len()] || !v.is_finite() {
            return [0.0; 3];
        }
        let v = v.max(0.0);
        let bend = 0.5 * v * weight_curvature(r);
        let mut out = match &color.halves {
            Some([a, b]) => product(bend, f64::from(a.data()[i]) - r, f64::from(b.data()[i]) - r),
            // (x−r)² − v.
            None => [-bend * v, 0.0, bend],
        };
        out[1] -= 2.0 * v * weight_slope(r);
        out
    };
    Some((0..truth.mean.data().len()).map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivatives_are_those_of_the_weight() {
        let h = 1e-5;
        for r in [-0.5, 0.003, 0.05, 0.1, 0.7, 3.0] {
            let slope = (weight(r + h) - weight(r - h)) / (2.0 * h);
            assert!((slope - weight_slope(r)).abs() < 1e-5 * weight_slope(r).abs().max(1.0), "{r}");
            let curvature = (weight_slope(r + h) - weight_slope(r - h)) / (2.0 * h);
            assert!(
                (curvature - weight_curvature(r)).abs() < 1e-5 * weight_curvature(r).abs().max(1.0),
                "{r}"
            );
        }
    }

    #[test]
    fn products_are_expanded() {
        let [k0, k1, k2] = product(2.0, 0.5, -3.0);
        for y in [-1.0, 0.0, 2.0] {
            let expanded = k0 + y * (k1 + y * k2);
            assert!((expanded - 2.0 * (y - 0.5) * (y + 3.0)).abs() < 1e-12);
        }
    }
}
