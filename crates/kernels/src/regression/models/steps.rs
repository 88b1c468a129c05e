//! One model in the window: weights, steps of its error estimate, its fit.

use super::field::Field;
use super::moments::{Design, predict, quadratic, sides, square, total};
use super::size::{COLUMNS, LANES, Lanes};
use super::window::{Column, Model, Window};
use crate::InstructionSet;
use crate::engine::Vectorised;
use crate::nlm::maps::exponential::exponential;

/// A ridge below this leaves too few digits of sums in `f32`.
const FINE: f64 = 1e-4;

/// What a step of the error estimate starts from: y_{t−1} and Var_{t−1}.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// y_0 = M and Var_0.
    First,
    /// Whole images.
    Images {
        /// y_{t−1}, three channels.
        value: [&'a [f32]; 3],
        /// Var_{t−1}, mean of the channels.
        variance: &'a [f32],
    },
    /// What the last step with the same bandwidth gave in this window.
    Own,
}

impl Window {
    /// Weights of bandwidth number `k`, and the normal matrix with them.
    pub fn weigh(&mut self, field: &Field, k: usize, level: InstructionSet) {
        level.run(Weigh { window: self, field, k });
    }

    /// One step of Eq. 11 with bandwidth number `k`, which has been [weighed](Window::weigh). Gives Σ_j w(i,j)·importance(j)·(bias_t²
    /// + Var_t), bias² the mean of the channels.
    pub fn step(&mut self, field: &Field, k: usize, start: Start<'_>, level: InstructionSet) -> f64 {
        level.run(Step { window: self, field, k, start })
    }

    /// Fits u, or M where `prefiltered`, and M with bandwidth number `k`.
    pub fn fit(&mut self, field: &Field, k: usize, prefiltered: bool, level: InstructionSet) {
        level.run(Fit { window: self, field, k, prefiltered });
    }
}

struct Weigh<'a> {
    window: &'a mut Window,
    field: &'a Field,
    k: usize,
}

impl Vectorised for Weigh<'_> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        let Self { window, field, k } = self;
        let (factor, least) = (field.factor(k), field.rules.least_weight);
        let groups = window.groups(k);
        let model = &mut window.models[k];
        for (weights, distances) in model.weights[..groups].iter_mut().zip(&window.distances) {
            for (weight, distance) in weights.iter_mut().zip(distances) {
                let w = exponential(distance * factor);
                *weight = if w < least { 0.0 } else { w };
            }
        }
        // Lanes that this bandwidth does not reach.
        for i in window.counts[k]..groups * LANES {
            model.weights[i / LANES][i % LANES] = 0.0;
        }
        let weights = &model.weights[..groups];
        let ridge = field.rules.ridge;
        let design = Design { x: &window.x, stride: window.stride, groups };
        model.inverse = square(weights, design, ridge < FINE).inverse(ridge);
    }
}

struct Step<'a, 'b> {
    window: &'a mut Window,
    field: &'a Field,
    k: usize,
    start: Start<'b>,
}

impl Vectorised for Step<'_, '_> {
    type Out = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let Self { window, field, k, start } = self;
        let n = window.groups(k);
        match start {
            Start::First => {}
            Start::Images { value, variance } => {
                for (i, p) in window.pixels[..window.counts[k]].iter().enumerate() {
                    let (g, l, p) = (i / LANES, i % LANES, *p as usize);
                    for ((start, value), center) in window.start.iter_mut().zip(value).zip(window.center) {
                        start[g][l] = value[p] - center;
                    }
                    window.start[3][g][l] = variance[p];
                }
                for i in window.counts[k]..n * LANES {
                    window.start.iter_mut().for_each(|column| column[i / LANES][i % LANES] = 0.0);
                }
            }
            Start::Own => {
                let model = &window.models[k];
                for (start, value) in window.start.iter_mut().zip(model.value.iter().chain([&model.variance]))
                {
                    start[..n].copy_from_slice(&value[..n]);
                }
            }
        }
        let Window { x, stride, guide, variance, start: images, importance, squares, models, .. } = window;
        let design = Design { x, stride: *stride, groups: n };
        let (from, variance) = match start {
            Start::First => ([&guide[0][..n], &guide[1][..n], &guide[2][..n]], &variance[..n]),
            _ => ([&images[0][..n], &images[1][..n], &images[2][..n]], &images[3][..n]),
        };
        let Model { weights, inverse, value, variance: out, error } = &mut models[k];
        let weights = &weights[..n];
        let fine = field.rules.ridge < FINE;

        // H y_{t−1}.
        let sums = sides(weights, design, from, fine);
        let slopes = [inverse.times(&sums[0]), inverse.times(&sums[1]), inverse.times(&sums[2])];
        let [r, g, b] = value;
        predict(design, &slopes, [&mut r[..n], &mut g[..n], &mut b[..n]], fine);

        // Σ_s H² Var_{t−1}.
        for ((square, w), v) in squares.iter_mut().zip(weights).zip(variance) {
            for l in 0..LANES {
                square[l] = w[l] * w[l] * v[l];
            }
        }
        let spread = inverse.around(&self::square(&squares[..n], design, fine));
        quadratic(design, &spread, &mut out[..n], fine);

        // bias_t² + Var_t.
        let mut sum = [0.0f32; LANES];
        for g in 0..n {
            for l in 0..LANES {
                let mut square = 0.0;
                for c in 0..3 {
                    let bias = value[c][g][l] - from[c][g][l];
                    square += bias * bias;
                }
                let here = square * (1.0 / 3.0) + out[g][l];
                error[g][l] = here;
                sum[l] += weights[g][l] * importance[g][l] * here;
            }
        }
        total(&sum)
    }
}

struct Fit<'a> {
    window: &'a mut Window,
    field: &'a Field,
    k: usize,
    prefiltered: bool,
}

impl Vectorised for Fit<'_> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        let Self { window, field, k, prefiltered } = self;
        let n = window.groups(k);
        window.chosen = k;
        let model = &window.models[k];
        let fine = field.rules.ridge < FINE;
        let design = Design { x: &window.x, stride: window.stride, groups: n };
        let [a, b, c, d, e, f] = &mut window.fitted;
        let weights = &model.weights[..n];
        let guide = fit(model, weights, design, &window.guide, fine);
        predict(design, &guide, [&mut d[..n], &mut e[..n], &mut f[..n]], fine);
        let target = if prefiltered { guide } else { fit(model, weights, design, &window.target, fine) };
        predict(design, &target, [&mut a[..n], &mut b[..n], &mut c[..n]], fine);
    }
}

/// β of three planes.
#[inline(always)]
fn fit(
    model: &Model,
    weights: &[Lanes],
    design: Design<'_>,
    y: &[Column; 3],
    fine: bool,
) -> [[f64; COLUMNS]; 3] {
    let n = design.groups;
    let sums = sides(weights, design, [&y[0][..n], &y[1][..n], &y[2][..n]], fine);
    [model.inverse.times(&sums[0]), model.inverse.times(&sums[1]), model.inverse.times(&sums[2])]
}
