//! Variance of the first step's output, for the tests of the second step that do not use the input's.
//!
//! Plain loops in `f64` over the small first window: these are ablations, several times slower per pixel than the kernel.

use noisefloor_frame::{Frame, Image, Variance};
use noisefloor_kernels::flash_filter::PatchWeights;
use noisefloor_kernels::mirror;
use rayon::prelude::*;

use crate::SpreadKind;
use crate::guide::Guide;
use crate::params::Step;
use crate::tolerance::Tolerance;

/// The first step, as its weights are defined by.
pub(crate) struct FirstStep<'a> {
    pub frame: &'a Frame,
    pub guide: Option<&'a Guide>,
    pub patch: &'a PatchWeights,
    pub step: &'a Step,
    pub tolerance: &'a Tolerance,
}

impl FirstStep<'_> {
    /// Variance of the first step's output under `kind`; `None` if the frame lacks what it needs.
    pub fn variance(&self, kind: SpreadKind) -> Option<Image> {
        let variance = self.frame.color.variance.as_ref().map(Variance::mean_variance)?;
        match kind {
            SpreadKind::Raw => Some(variance.clone()),
            // Σ w²·var / (Σ w)²: the sum of weights is at least 1.
            SpreadKind::Propagated => Some(self.gather(
                |_, sums| sums.map(|sum| sum.weighted_square / (sum.weight * sum.weight)),
                [variance, variance],
            )),
            SpreadKind::Halves => {
                let [a, b] = self.frame.color.halves.as_ref()?;
                Some(self.gather(
                    |p, sums| {
                        let (n_a, n_b) = self.frame.samples.halves_at(p);
                        let (n_a, n_b) = (f64::from(n_a), f64::from(n_b));
                        let n = n_a + n_b; // at least 2, or the frame was refused
                        sums.map(|sum| {
                            let difference = sum.weighted[0] / sum.weight - sum.weighted[1] / sum.weight;
                            difference * difference * n_a * n_b / (n * n)
                        })
                    },
                    [a, b],
                ))
            }
        }
    }

    /// Runs over every pixel's homogeneous set, summing weights and weighted values of two images.
    fn gather(&self, finish: impl Fn(usize, [Sums; 3]) -> [f64; 3] + Sync, images: [&Image; 2]) -> Image {
        let (width, height) = (self.frame.width(), self.frame.height());
        let padded = self.guide.map(|guide| Padded::new(&guide.image, self.patch));
        let padded = padded.as_ref();
        let rows: Vec<Vec<[f64; 3]>> = (0..height)
            .into_par_iter()
            .map(|y| (0..width).map(|x| finish(y * width + x, self.sums(padded, x, y, images))).collect())
            .collect();
        Image::from_fn(width, height, 3, |c, x, y| rows[y][x][c] as f32)
    }

    fn sums(&self, padded: Option<&Padded>, x: usize, y: usize, images: [&Image; 2]) -> [Sums; 3] {
        let (width, height) = (self.frame.width(), self.frame.height());
        let r = self.step.window_radius;
        let p = y * width + x;
        let mut sums = [Sums::default(); 3];
        for qy in y.saturating_sub(r)..(y + r + 1).min(height) {
            for qx in x.saturating_sub(r)..(x + r + 1).min(width) {
                let q = qy * width + qx;
                let members = self.tolerance.members(&self.frame.color.mean, p, q);
                if members == [false; 3] {
                    continue;
                }
                let weight = if p == q { 1.0 } else { self.weight(padded, (x, y), (qx, qy)) };
                for c in (0..3).filter(|&c| members[c]) {
                    sums[c].add(weight, images.map(|image| f64::from(image.plane(c)[q])));
                }
            }
        }
        sums
    }

    /// w(p, q) of Eq. 1.
    fn weight(&self, padded: Option<&Padded>, p: (usize, usize), q: (usize, usize)) -> f64 {
        let sigma = f64::from(self.step.spatial_sigma);
        let offset = (p.0.abs_diff(q.0).pow(2) + p.1.abs_diff(q.1).pow(2)) as f64;
        let spatial = (-offset / (2.0 * sigma * sigma)).exp(); // sigma > 0 by validation
        let (Some(guide), Some(padded)) = (self.guide, padded) else { return spatial };
        let distance = padded.patch_distance(self.patch, p, q);
        spatial * (-distance * f64::from(guide.inv_two_sigma_r2[p.1 * self.frame.width() + p.0])).exp()
    }
}

/// The guide with a mirrored border as wide as the patch reaches.
struct Padded {
    stride: usize,
    planes: [Vec<f32>; 3],
}

impl Padded {
    fn new(image: &Image, patch: &PatchWeights) -> Self {
        let f = patch.radius() as isize;
        let (w, h) = (image.width(), image.height());
        let columns: Vec<usize> = (-f..w as isize + f).map(|x| mirror(x, w)).collect();
        let plane = |c: usize| {
            let rows = (-f..h as isize + f).map(|y| &image.plane(c)[mirror(y, h) * w..][..w]);
            rows.flat_map(|row| columns.iter().map(move |&x| row[x])).collect()
        };
        Self { stride: columns.len(), planes: [0, 1, 2].map(plane) }
    }

    /// Σ_j G(j)·⅓Σ_c (F_c(p+j) − F_c(q+j))².
    fn patch_distance(&self, patch: &PatchWeights, p: (usize, usize), q: (usize, usize)) -> f64 {
        let f = patch.radius();
        let side = 2 * f + 1;
        let mut distance = 0.0;
        for j in 0..side {
            let mut across = 0.0;
            for plane in &self.planes {
                // Pixel (x, y) lies at (x + f, y + f), so its patch starts at (x, y).
                let row = |(x, y): (usize, usize)| &plane[(y + j) * self.stride + x..][..side];
                for (i, (a, b)) in row(p).iter().zip(row(q)).enumerate() {
                    let difference = f64::from(*a) - f64::from(*b);
                    across += patch.tap(i.abs_diff(f)) * difference * difference;
                }
            }
            distance += patch.tap(j.abs_diff(f)) * across;
        }
        distance / 3.0
    }
}

/// Sums over one channel's homogeneous set.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    weight: f64,
    /// Σ w·value of the two images.
    weighted: [f64; 2],
    /// Σ w²·value of the first image.
    weighted_square: f64,
}

impl Sums {
    fn add(&mut self, weight: f64, values: [f64; 2]) {
        self.weight += weight;
        self.weighted_square += weight * weight * values[0];
        for (sum, value) in self.weighted.iter_mut().zip(values) {
            *sum += weight * value;
        }
    }
}
