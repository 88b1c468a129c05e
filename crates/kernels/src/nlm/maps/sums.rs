//! What weights add up to (rousselle2013rdfc, Sec. 3, Eq. 1), and what is made of it.

use super::layout::{Layout, Place, row_mut};
use super::squares::least;
use crate::engine::{Copies, Grid, TileRows};
use crate::nlm::{Center, NlmInputs, Pass};

/// Sums of one set of weights.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// Σ w.
    pub sum: Vec<f32>,
    /// The largest w.
    pub largest: Vec<f32>,
}

/// Sums of a pass, for every pixel of a tile; without the pixel itself.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    pub weights: Weights,
    /// Σ w·u(q) of each target.
    pub targets: Vec<Vec<f32>>,
    /// Σ w·(g(q) − g(p)), three channels.
    pub step: [Vec<f32>; 3],
    /// The same with the guide at p moved.
    pub moved_step: [Vec<f32>; 3],
    /// Weights after moving each channel; the first only if all move at once.
    pub moved: [Weights; 3],
}

impl Sums {
    /// Room for the sums of a pass.
    pub fn new(layout: &Layout, pass: &Pass) -> Self {
        let plane = || vec![0.0; layout.pixel.plane];
        let differs = pass.derivative && pass.patch.is_some();
        let moved = || if differs { plane() } else { Vec::new() };
        let weights = |plane: &dyn Fn() -> Vec<f32>| Weights { sum: plane(), largest: plane() };
        Self {
            weights: weights(&plane),
            targets: (0..layout.targets).map(|_| plane()).collect(),
            step: [(); 3].map(|()| moved()),
            moved_step: [(); 3].map(|()| moved()),
            moved: [(); 3].map(|()| weights(&moved)),
        }
    }

    /// Back to nothing.
    pub fn clear(&mut self) {
        let Self { weights, targets, step, moved_step, moved } = self;
        let weights = std::iter::once(weights).chain(moved).flat_map(|w| [&mut w.sum, &mut w.largest]);
        weights.chain(targets).chain(step).chain(moved_step).for_each(|plane| plane.fill(0.0));
    }
}

impl Weights {
    /// Adds a row of weights of both neighbours.
    #[inline(always)]
    pub fn add(&mut self, grid: &Grid, y: isize, [first, second]: [&[f32]; 2]) {
        let n = first.len();
        let (sum, most) =
            (row_mut(&mut self.sum, grid, (0, y), n), row_mut(&mut self.largest, grid, (0, y), n));
        for ((sum, most), (a, b)) in sum.iter_mut().zip(most).zip(first.iter().zip(second)) {
            *sum += a + b;
            let larger = if a > b { *a } else { *b };
            *most = if larger > *most { larger } else { *most };
        }
    }
}

/// Adds a row of values at both neighbours times their weights.
#[inline(always)]
pub(super) fn add_values(sum: &mut [f32], weights: [&[f32]; 2], values: [&[f32]; 2]) {
    let first = weights[0].iter().zip(values[0]);
    let second = weights[1].iter().zip(values[1]);
    for ((sum, (w1, u1)), (w2, u2)) in sum.iter_mut().zip(first).zip(second) {
        *sum += w1 * u1 + w2 * u2;
    }
}

/// The same of differences to the pixels' own values.
#[inline(always)]
pub(super) fn add_differences(sum: &mut [f32], weights: [&[f32]; 2], values: [&[f32]; 2], own: &[f32]) {
    let first = weights[0].iter().zip(values[0]);
    let second = weights[1].iter().zip(values[1]);
    for (((sum, own), (w1, u1)), (w2, u2)) in sum.iter_mut().zip(own).zip(first).zip(second) {
        *sum += w1 * (u1 - own) + w2 * (u2 - own);
    }
}

/// Lowers a row of weights to limits.
#[inline(always)]
pub(super) fn limit(weights: &mut [f32], limits: &[f32]) {
    for (weight, limit) in weights.iter_mut().zip(limits) {
        *weight = least(*limit, *weight);
    }
}

/// Adds the pixel itself, divides and writes what a pass gives for a tile.
pub(super) struct Finish<'a> {
    pub layout: &'a Layout,
    pub place: Place,
    pub center: Center,
    pub inputs: &'a NlmInputs<'a>,
    pub joint: bool,
}

impl Finish<'_> {
    /// Weight of the pixel itself.
    fn own(&self, largest: f32) -> f32 {
        match self.center {
            Center::One => 1.0,
            Center::LargestNeighbor { least } => largest.max(least),
        }
    }

    /// `out` are the targets, Σ w, the pixel's share and the derivatives.
    pub fn pass<'o>(&self, pass: &Pass, sums: &Sums, out: &mut impl Iterator<Item = TileRows<'o>>) {
        let Place { tile, width, height } = self.place;
        let grid = &self.layout.pixel;
        let copies = Copies { width, height, tile };
        let mut own = vec![0.0; grid.plane];
        for (sum, target) in sums.targets.iter().zip(&self.inputs.frame.targets) {
            copies.own(grid, target, &mut own, |v| v);
            self.rows(out, |y, i| {
                let at = y * grid.pitch + i;
                let weight = self.own(sums.weights.largest[at]);
                // The pixel's own weight is above 0.
                (sum[at] + weight * own[at]) / (sums.weights.sum[at] + weight)
            });
        }
        let total = |at: usize| sums.weights.sum[at] + self.own(sums.weights.largest[at]);
        let share = |at: usize| self.own(sums.weights.largest[at]) / total(at);
        self.rows(out, |y, i| total(y * grid.pitch + i));
        self.rows(out, |y, i| share(y * grid.pitch + i));
        if !pass.derivative {
            return;
        }
        for c in 0..3 {
            let (Some(_), Some(perturbation)) = (pass.patch, &self.inputs.perturbation) else {
                self.rows(out, |y, i| share(y * grid.pitch + i));
                continue;
            };
            copies.own(grid, perturbation.step[c], &mut own, |v| v);
            let moved = &sums.moved[if self.joint { 0 } else { c }];
            self.rows(out, |y, i| {
                let at = y * grid.pitch + i;
                let delta = own[at];
                if delta <= 0.0 {
                    return share(at);
                }
                let before = sums.step[c][at] / total(at);
                let weight = self.own(moved.largest[at]);
                let after = (sums.moved_step[c][at] + weight * delta) / (moved.sum[at] + weight);
                (after - before) / delta
            });
        }
    }

    /// Writes the next plane.
    fn rows<'o>(&self, out: &mut impl Iterator<Item = TileRows<'o>>, value: impl Fn(usize, usize) -> f32) {
        for (y, row) in out.next().into_iter().flatten().enumerate() {
            for (i, to) in row.iter_mut().enumerate() {
                *to = value(y, i);
            }
        }
    }
}
