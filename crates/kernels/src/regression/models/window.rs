//! One model: its window, weights, steps of its error estimate, and its fit.

use super::distances;
use super::field::Field;
use super::moments::total;
use super::size::{COLUMNS, LANES, Lanes, MAX_BANDWIDTHS};
use super::solve::Square;

/// Columns of one value per pixel that takes part.
pub(super) type Column = Vec<Lanes>;

/// The window that is worked on, and a worker's memory.
#[derive(Clone, Debug)]
pub struct Window {
    /// Pixels that take part, as indices into the image: first those that the smallest bandwidth gives a weight, then those that
    /// only larger ones do.
    pub(super) pixels: Vec<u32>,
    /// How many each bandwidth gives a weight.
    pub(super) counts: [usize; MAX_BANDWIDTHS],
    /// Rows of X, column by column, `stride` after each other.
    pub(super) x: Column,
    pub(super) stride: usize,
    /// M and u less M at the centre, Var_0, importance.
    pub(super) guide: [Column; 3],
    pub(super) target: [Column; 3],
    pub(super) variance: Column,
    pub(super) importance: Column,
    /// P at k = 1 of what takes part.
    pub(super) distances: Column,
    /// P of the whole window, in rows.
    pub(super) map: Vec<f32>,
    pub(super) center: [f32; 3],
    /// One for each bandwidth.
    pub(super) models: Vec<Model>,
    /// y_{t−1} less M at the centre, Var_{t−1}.
    pub(super) start: [Column; 4],
    /// Squares for variances: w² Var.
    pub(super) squares: Column,
    /// u and M fitted with the chosen bandwidth, less M at the centre.
    pub(super) fitted: [Column; 6],
    /// That bandwidth.
    pub(super) chosen: usize,
}

/// One bandwidth.
#[derive(Clone, Debug)]
pub(super) struct Model {
    pub(super) weights: Column,
    pub(super) inverse: Square,
    /// y_t less M at the centre, Var_t, and the squared error that step t estimates.
    pub(super) value: [Column; 3],
    pub(super) variance: Column,
    pub(super) error: Column,
}

impl Window {
    /// Room for windows of this radius at most.
    #[must_use]
    pub fn new(field: &Field, radius: usize) -> Self {
        let side = 2 * radius + 1;
        let stride = (side * side).div_ceil(LANES);
        let column = || vec![[0.0; LANES]; stride];
        let model = || Model {
            weights: column(),
            inverse: Square::default(),
            value: [(); 3].map(|()| column()),
            variance: column(),
            error: column(),
        };
        Self {
            pixels: Vec::with_capacity(side * side),
            counts: [0; MAX_BANDWIDTHS],
            x: vec![[0.0; LANES]; stride * COLUMNS],
            stride,
            guide: [(); 3].map(|()| column()),
            target: [(); 3].map(|()| column()),
            variance: column(),
            importance: column(),
            distances: column(),
            map: vec![0.0; side.next_multiple_of(distances::LANES) * side],
            center: [0.0; 3],
            models: field.rules.bandwidths.iter().map(|_| model()).collect(),
            start: [(); 4].map(|()| column()),
            squares: column(),
            fitted: [(); 6].map(|()| column()),
            chosen: 0,
        }
    }

    /// Pixels that take part in bandwidth number `k`, as indices into the image. What is said of pixels below is in this order.
    #[must_use]
    pub fn pixels(&self, k: usize) -> &[u32] {
        &self.pixels[..self.counts[k]]
    }

    /// Weights of bandwidth number `k`.
    #[must_use]
    pub fn weights(&self, k: usize) -> &[f32] {
        self.part(k, &self.models[k].weights)
    }

    /// Σ w of bandwidth number `k`.
    #[must_use]
    pub fn weight_sum(&self, k: usize) -> f64 {
        self.models[k].weights[..self.groups(k)].iter().map(total).sum()
    }

    /// y_t of the last step with bandwidth number `k`, less [`Window::center`].
    #[must_use]
    pub fn value(&self, k: usize) -> [&[f32]; 3] {
        [0, 1, 2].map(|c| self.part(k, &self.models[k].value[c]))
    }

    /// Var_t of that step.
    #[must_use]
    pub fn variance(&self, k: usize) -> &[f32] {
        self.part(k, &self.models[k].variance)
    }

    /// bias_t² + Var_t of that step, mean of the channels.
    #[must_use]
    pub fn error(&self, k: usize) -> &[f32] {
        self.part(k, &self.models[k].error)
    }

    /// u, or M, as last fitted, less [`Window::center`].
    #[must_use]
    pub fn fitted(&self) -> [&[f32]; 3] {
        [0, 1, 2].map(|c| self.part(self.chosen, &self.fitted[c]))
    }

    /// M as last fitted, less [`Window::center`].
    #[must_use]
    pub fn refitted(&self) -> [&[f32]; 3] {
        [3, 4, 5].map(|c| self.part(self.chosen, &self.fitted[c]))
    }

    /// M at the centre.
    #[must_use]
    pub fn center(&self) -> [f32; 3] {
        self.center
    }

    fn part<'a>(&self, k: usize, column: &'a [Lanes]) -> &'a [f32] {
        &column.as_flattened()[..self.counts[k]]
    }

    /// Lanes in use with bandwidth number `k`; what they hold beyond its pixels weighs nothing with it.
    #[inline(always)]
    pub(super) fn groups(&self, k: usize) -> usize {
        self.counts[k].div_ceil(LANES)
    }
}
