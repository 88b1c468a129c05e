//! Sums over pixel-channels, of which totals and their standard errors are made. Everything is kept as deviations from
//! means, so that a large bias does not swallow a small variance.

use super::jackknife::{of_means, of_pairs};
use super::reference::{BiasReference, Residuals};
use super::total::{BiasVarianceTotal, Estimated};
use crate::ReferenceShare;

/// What one pixel-channel contributes.
#[derive(Debug, Clone)]
pub(super) struct Terms {
    /// D̄ − r.
    pub(super) bias: f64,
    /// D_r − D̄.
    deviations: Vec<f64>,
    residuals: [f64; 2],
    noise: f64,
    /// P_k − A and P_k − B.
    parts: [Vec<f64>; 2],
}

impl Terms {
    pub(super) fn new(replicates: usize, parts: [&[&[f32]]; 2]) -> Self {
        Self {
            bias: 0.0,
            deviations: vec![0.0; replicates],
            residuals: [0.0; 2],
            noise: 0.0,
            parts: parts.map(|p| vec![0.0; p.len()]),
        }
    }

    /// Takes pixel-channel `i`; false if something is not finite there.
    pub(super) fn fill(&mut self, images: &[&[f32]], reference: &BiasReference<'_>, i: usize) -> bool {
        let mean = images.iter().map(|d| f64::from(d[i])).sum::<f64>() / images.len() as f64; // at least 2
        self.deviations.iter_mut().zip(images).for_each(|(c, d)| *c = f64::from(d[i]) - mean);
        let Residuals { mean: bias, halves, noise } = reference.residuals(i, mean);
        (self.bias, self.residuals, self.noise) = (bias, halves, noise);
        for ((own, parts), residual) in self.parts.iter_mut().zip(reference.parts()).zip(halves) {
            let half = mean - residual;
            own.iter_mut().zip(parts).for_each(|(c, part)| *c = f64::from(part[i]) - half);
        }
        let residuals = self.residuals.iter().chain([&self.bias, &self.noise]);
        residuals.chain(&self.deviations).chain(self.parts.iter().flatten()).all(|v| v.is_finite())
    }

    /// V̂.
    pub(super) fn variance(&self) -> f64 {
        self.deviations.iter().map(|c| c * c).sum::<f64>() / (self.deviations.len() - 1) as f64 // at least 2
    }

    /// B̂².
    pub(super) fn squared_bias(&self) -> f64 {
        self.residuals[0] * self.residuals[1] - self.noise - self.variance() / self.deviations.len() as f64
    }
}

/// Weighted sums over the pixel-channels of a group.
#[derive(Debug, Clone)]
pub(super) struct Sums {
    count: u64,
    /// Σ √w(D̄ − r).
    bias: f64,
    /// Σ w·B̂².
    squared_bias: f64,
    /// Σ √w(D_r − D̄) per replicate.
    signed: Vec<f64>,
    /// Σ w·½(D̄ − A + D̄ − B)(D_r − D̄) per replicate.
    cross: Vec<f64>,
    /// Σ w(D_r − D̄)² per replicate.
    squares: Vec<f64>,
    /// Σ w(D̄ − B)(P_k − A) and Σ w(D̄ − A)(P_k − B).
    influences: [Vec<f64>; 2],
    /// Σ √w(P_k − A) and Σ √w(P_k − B).
    light: [Vec<f64>; 2],
    /// Σ w(P_k − A)(P_l − B), row by row.
    products: Vec<f64>,
}

impl Sums {
    pub(super) fn new(replicates: usize, parts: [&[&[f32]]; 2]) -> Self {
        let per_part = || parts.map(|p| vec![0.0; p.len()]);
        Self {
            count: 0,
            bias: 0.0,
            squared_bias: 0.0,
            signed: vec![0.0; replicates],
            cross: vec![0.0; replicates],
            squares: vec![0.0; replicates],
            influences: per_part(),
            light: per_part(),
            products: vec![0.0; parts[0].len() * parts[1].len()],
        }
    }

    pub(super) fn add(&mut self, weight: f64, terms: &Terms) {
        let root = weight.sqrt(); // the caller's is at least 0
        self.count += 1;
        self.bias += root * terms.bias;
        self.squared_bias += weight * terms.squared_bias();
        let middle = 0.5 * (terms.residuals[0] + terms.residuals[1]);
        for (r, c) in terms.deviations.iter().enumerate() {
            self.signed[r] += root * c;
            self.cross[r] += weight * middle * c;
            self.squares[r] += weight * c * c;
        }
        for half in 0..2 {
            let other = weight * terms.residuals[1 - half];
            for (k, c) in terms.parts[half].iter().enumerate() {
                self.influences[half][k] += other * c;
                self.light[half][k] += root * c;
            }
        }
        let [a, b] = &terms.parts;
        for (k, left) in a.iter().enumerate() {
            for (l, right) in b.iter().enumerate() {
                self.products[k * b.len() + l] += weight * left * right;
            }
        }
    }

    pub(super) fn total(&self, reference: &BiasReference<'_>) -> Option<BiasVarianceTotal> {
        if self.count == 0 {
            return None;
        }
        let n = self.count as f64;
        let mean = |sums: &[f64]| -> Vec<f64> { sums.iter().map(|s| s / n).collect() };
        let (signed, cross, squares) = (mean(&self.signed), mean(&self.cross), mean(&self.squares));
        let replicates = squares.len();
        let estimated = |value: f64, replicate_error: Option<f64>, reference: ReferenceShare| Estimated {
            value,
            replicate_error,
            reference,
            replicates: replicates as u32,
        };
        let variance = squares.iter().sum::<f64>() / (replicates - 1) as f64; // at least 2
        let squared_bias = self.squared_bias / n;
        let share = self.share();
        let (of_bias, of_variance) = of_pairs(&cross, &squares);
        // Of a replicate's squared error, what the mean image does not have.
        let errors: Vec<f64> = cross.iter().zip(&squares).map(|(l, k)| 2.0 * l + k).collect();
        let squared = reference.squared();
        Some(BiasVarianceTotal {
            pixel_channels: self.count,
            bias: estimated(self.bias / n, Some(of_means(&signed)), self.share_of_bias()),
            squared_bias: squared.then(|| estimated(squared_bias, of_bias, share.clone())),
            variance: estimated(variance, of_variance, ReferenceShare::default()),
            mse: squared.then(|| estimated(squared_bias + variance, Some(of_means(&errors)), share)),
        })
    }

    /// √(n(n−1)) of the parts of each half; 1 without parts, where there is nothing to scale.
    fn scales(&self) -> [f64; 2] {
        self.light.each_ref().map(|parts| {
            let n = parts.len() as f64;
            if n >= 2.0 { (n * (n - 1.0)).sqrt() } else { 1.0 }
        })
    }

    /// What the reference adds to the squared bias, and to the squared error: it enters both in the same way.
    fn share(&self) -> ReferenceShare {
        let scales = self.scales();
        let n = self.count as f64; // above 0, or there were no total
        let pairs = self.influences.iter().zip(scales);
        let parts = pairs.flat_map(|(sums, scale)| sums.iter().map(move |s| s / (n * scale))).collect();
        let both = n * scales[0] * scales[1];
        let product = self.products.iter().map(|s| (s / both).powi(2)).sum::<f64>().sqrt();
        with_error(parts, product)
    }

    /// What the reference adds to the signed bias: r = pA + qB, p and q the halves' shares of the parts.
    fn share_of_bias(&self) -> ReferenceShare {
        let all = self.light.iter().map(Vec::len).sum::<usize>() as f64;
        let n = self.count as f64; // above 0, or there were no total
        let pairs = self.light.iter().zip(self.scales());
        let part = |(sums, scale): (&Vec<f64>, f64)| {
            let factor = -(sums.len() as f64) / (all * n * scale); // only used where there are parts
            sums.iter().map(move |s| s * factor).collect::<Vec<_>>()
        };
        with_error(pairs.flat_map(part).collect(), 0.0)
    }
}

fn with_error(parts: Vec<f64>, product: f64) -> ReferenceShare {
    let share = ReferenceShare { standard_error: 0.0, parts, product };
    ReferenceShare::combined(&[(1.0, &share)])
}
