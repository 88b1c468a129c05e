//! One model: its window, weights, steps of its error estimate, and its fit.

use super::distances::{self, Distances, from_center};
use super::field::{GUIDE, IMPORTANCE, TARGET, VARIANCE};
use super::moments::{Design, predict, quadratic, sides, square, total};
use super::solve::Square;
use super::{COLUMNS, Field, LANES, Lanes, MAX_BANDWIDTHS, MAX_FEATURES};
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

/// Columns of one value per pixel that takes part.
type Column = Vec<Lanes>;

/// The window that is worked on, and a worker's memory.
#[derive(Clone, Debug)]
pub struct Window {
    /// Pixels that take part, as indices into the image: first those that the smallest bandwidth gives a weight, then those that
    /// only larger ones do.
    pixels: Vec<u32>,
    /// How many each bandwidth gives a weight.
    counts: [usize; MAX_BANDWIDTHS],
    /// Rows of X, column by column, `stride` after each other.
    x: Column,
    stride: usize,
    /// M and u less M at the centre, Var_0, importance.
    guide: [Column; 3],
    target: [Column; 3],
    variance: Column,
    importance: Column,
    /// P at k = 1 of what takes part.
    distances: Column,
    /// P of the whole window, in rows.
    map: Vec<f32>,
    center: [f32; 3],
    /// One for each bandwidth.
    models: Vec<Model>,
    /// y_{t−1} less M at the centre, Var_{t−1}.
    start: [Column; 4],
    /// Squares for variances: w² Var.
    squares: Column,
    /// u and M fitted with the chosen bandwidth, less M at the centre.
    fitted: [Column; 6],
    /// That bandwidth.
    chosen: usize,
}

/// One bandwidth.
#[derive(Clone, Debug)]
struct Model {
    weights: Column,
    inverse: Square,
    /// y_t less M at the centre, Var_t, and the squared error that step t estimates.
    value: [Column; 3],
    variance: Column,
    error: Column,
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

    /// Goes to the window of `radius` around `center`, at most the radius that there is room for. Distances that `known` holds
    /// are taken from it, with the same result.
    pub fn open(
        &mut self,
        field: &Field,
        center: (usize, usize),
        radius: usize,
        known: &Distances,
        level: InstructionSet,
    ) {
        level.run(Open { window: self, field, center, radius, known });
    }

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
    fn groups(&self, k: usize) -> usize {
        self.counts[k].div_ceil(LANES)
    }
}

struct Open<'a> {
    window: &'a mut Window,
    field: &'a Field,
    center: (usize, usize),
    radius: usize,
    known: &'a Distances,
}

impl Vectorised for Open<'_> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        let Self { window, field, center: (x, y), radius, known } = self;
        let columns = x.saturating_sub(radius)..(x + radius + 1).min(field.width);
        let rows = y.saturating_sub(radius)..(y + radius + 1).min(field.height);
        let pitch = columns.len().next_multiple_of(distances::LANES);
        let map = &mut window.map[..pitch * rows.len()];
        if known.holds((x, y), radius) {
            known.copy((x, y), &columns, &rows, map, pitch);
        } else {
            from_center(field, (x, y), &columns, &rows, map, pitch);
        }

        // Scales from all of the window.
        let own = &field.records[y * field.width + x];
        let (mut low, mut high) = (*own, *own);
        for j in rows.clone() {
            for record in &field.records[j * field.width + columns.start..][..columns.len()] {
                for l in 0..LANES {
                    low[l] = if record[l] < low[l] { record[l] } else { low[l] };
                    high[l] = if record[l] > high[l] { record[l] } else { high[l] };
                }
            }
        }
        let scale = |range: f32, floor: f32| {
            let by = if range > floor { range } else { floor };
            // A column that is constant in the image is 0 and stays so.
            if by > 0.0 { 1.0 / by } else { 1.0 }
        };
        let mut scales = [0.0; 2 + MAX_FEATURES];
        scales[0] = scale((columns.len() - 1) as f32, field.floors[0]);
        scales[1] = scale((rows.len() - 1) as f32, field.floors[1]);
        for i in 0..field.features {
            scales[2 + i] = scale(high[i] - low[i], field.floors[2 + i]);
        }

        // The first bandwidth that gives each pixel a weight, if any does, and how many there are of each.
        let bandwidths = field.rules.bandwidths.len();
        let mut farthest = [f32::INFINITY; MAX_BANDWIDTHS];
        for (k, farthest) in farthest.iter_mut().enumerate().take(bandwidths) {
            *farthest = -field.rules.least_weight.ln() / factor(field, k);
        }
        let farthest = &farthest[..bandwidths];
        // One more place for what no bandwidth gives a weight.
        let mut next = [0; MAX_BANDWIDTHS + 2];
        for distances in window.map[..pitch * rows.len()].chunks(pitch) {
            for distance in &distances[..columns.len()] {
                next[first_of(farthest, *distance) + 1] += 1;
            }
        }
        for k in 0..bandwidths {
            next[k + 1] += next[k];
        }
        window.counts[..bandwidths].copy_from_slice(&next[1..=bandwidths]);
        let n = window.counts[bandwidths - 1];

        window.center = [own[GUIDE], own[GUIDE + 1], own[GUIDE + 2]];
        window.pixels.clear();
        window.pixels.resize(n, 0);
        let stride = window.stride;
        for (j, distances) in rows.clone().zip(window.map.chunks(pitch)) {
            for (i, distance) in columns.clone().zip(distances) {
                let k = first_of(farthest, *distance);
                if k == bandwidths {
                    continue;
                }
                let (p, place) = (j * field.width + i, next[k]);
                next[k] += 1;
                let record = &field.records[p];
                let (g, l) = (place / LANES, place % LANES);
                window.pixels[place] = p as u32;
                window.distances[g][l] = *distance;
                window.x[g][l] = 1.0;
                window.x[stride + g][l] = (i as f32 - x as f32) * scales[0];
                window.x[2 * stride + g][l] = (j as f32 - y as f32) * scales[1];
                for f in 0..field.features {
                    window.x[(3 + f) * stride + g][l] = (record[f] - own[f]) * scales[2 + f];
                }
                for c in 0..3 {
                    window.guide[c][g][l] = record[GUIDE + c] - own[GUIDE + c];
                    window.target[c][g][l] = record[TARGET + c] - own[GUIDE + c];
                }
                window.variance[g][l] = record[VARIANCE];
                window.importance[g][l] = record[IMPORTANCE];
            }
        }
        // The rest of the last lanes weighs nothing.
        for i in n..n.next_multiple_of(LANES) {
            let (g, l) = (i / LANES, i % LANES);
            window.distances[g][l] = f32::INFINITY;
            for column in 0..COLUMNS {
                window.x[column * stride + g][l] = 0.0;
            }
            for c in 0..3 {
                window.guide[c][g][l] = 0.0;
                window.target[c][g][l] = 0.0;
            }
            window.variance[g][l] = 0.0;
            window.importance[g][l] = 0.0;
        }
    }
}

/// Number of the first bandwidth at which a distance is not too far, or how many there are.
#[inline(always)]
fn first_of(farthest: &[f32], distance: f32) -> usize {
    let mut k = 0;
    for limit in farthest {
        k += usize::from(distance > *limit);
    }
    k
}

/// 1/(2σ_r²k²) of bandwidth number `k`.
#[inline(always)]
fn factor(field: &Field, k: usize) -> f32 {
    let width = field.rules.range_sigma * field.rules.bandwidths[k];
    0.5 / (width * width)
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
        let (factor, least) = (factor(field, k), field.rules.least_weight);
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
        predict(design, &slopes, [&mut r[..n], &mut g[..n], &mut b[..n]]);

        // Σ_s H² Var_{t−1}.
        for ((square, w), v) in squares.iter_mut().zip(weights).zip(variance) {
            for l in 0..LANES {
                square[l] = w[l] * w[l] * v[l];
            }
        }
        let spread = inverse.around(&self::square(&squares[..n], design, fine));
        quadratic(design, &spread, &mut out[..n]);

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
        predict(design, &guide, [&mut d[..n], &mut e[..n], &mut f[..n]]);
        let target = if prefiltered { guide } else { fit(model, weights, design, &window.target, fine) };
        predict(design, &target, [&mut a[..n], &mut b[..n], &mut c[..n]]);
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
