//! All models of one tile in one pass over the image: their errors, their bandwidths, the pixels that they cover.

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::regression::models::{Area, Distances, Field, Start, Window};

use crate::blend::Patch;
use crate::centres::{Center, Tile};
use crate::params::Assembled;
use crate::settings::Settings;

/// Planes of a blended image: weight, u, y, error.
pub(crate) const BLENDED: usize = 8;
/// Planes of an image that the next step starts from: weight, y, Var.
pub(crate) const ASSEMBLED: usize = 5;
/// Least weight in the blend where everything is covered, so that pixels that no model looks like get the mean of all.
const FAINT: f32 = 1e-30;
/// Models of a tile from which on distances from all of its pixels cost less than those from the centres; ours, measured.
const MANY: usize = 64;

/// A worker's memory.
#[derive(Debug)]
pub(crate) struct Work {
    window: Window,
    distances: Distances,
}

impl Work {
    pub fn new(pass: &Pass<'_>) -> Self {
        Self { window: Window::new(pass.field, pass.settings.reach), distances: Distances::default() }
    }
}

/// y_t and Var_t.
#[derive(Debug)]
pub(crate) struct Assembly {
    pub value: [Vec<f32>; 3],
    pub variance: Vec<f32>,
}

/// What a pass does.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pass<'a> {
    pub size: (usize, usize),
    pub settings: &'a Settings,
    pub field: &'a Field,
    /// Images of the steps before, one for each bandwidth or one for all.
    pub images: &'a [Vec<Assembly>],
    /// Step of the error estimate that is due.
    pub step: usize,
    /// Whether centres are added.
    pub grows: bool,
    /// Whether the models are blended after it; else images for the next step are made.
    pub last: bool,
}

impl Pass<'_> {
    /// Planes of its patches.
    pub fn planes(&self) -> usize {
        match (self.last, self.settings.assembled) {
            (true, _) => BLENDED,
            (false, Assembled::Image) => ASSEMBLED * self.settings.bandwidths.len(),
            (false, _) => ASSEMBLED,
        }
    }

    /// Runs it on one tile, with the centres that the tile has so far.
    pub fn run(&self, tile: &Tile, mut centers: Vec<Center>, work: &mut Work) -> (Vec<Center>, Patch) {
        let settings = self.settings;
        let mut patch = Patch::new(tile, settings.reach, self.size, self.planes(), self.last);
        let mut covered = vec![false; tile.width * tile.height];
        work.distances.clear();
        if centers.iter().filter(|center| center.radius <= settings.growth).count() > MANY {
            self.keep_distances(tile, work);
        }
        for center in &mut centers {
            self.model(center, tile, work, &mut covered, &mut patch);
        }
        if self.grows {
            // Sec. 3.5: every pixel that nothing covers is a centre; its own weight is 1.
            let mut added = 0;
            for p in 0..covered.len() {
                if covered[p] {
                    continue;
                }
                if added == MANY && covered[p..].iter().filter(|covered| !**covered).count() > MANY {
                    self.keep_distances(tile, work);
                }
                let (x, y) = (tile.x + p % tile.width, tile.y + p / tile.width);
                let mut center = Center::new(x, y, settings.growth);
                self.model(&mut center, tile, work, &mut covered, &mut patch);
                centers.push(center);
                added += 1;
            }
        }
        (centers, patch)
    }

    /// Computes distances from all pixels of a tile, unless they are there.
    fn keep_distances(&self, tile: &Tile, work: &mut Work) {
        let Tile { x, y, width, height, .. } = *tile;
        if !work.distances.holds((x, y), self.settings.growth) {
            let area = Area { x, y, width, height };
            work.distances.fill(self.field, area, self.settings.growth, InstructionSet::in_use());
        }
    }

    /// One model: the steps that it lacks, its bandwidth, what it covers and what it says.
    fn model(
        &self,
        center: &mut Center,
        tile: &Tile,
        Work { window, distances }: &mut Work,
        covered: &mut [bool],
        patch: &mut Patch,
    ) {
        let (settings, field, level) = (self.settings, self.field, InstructionSet::in_use());
        window.open(field, (center.x, center.y), center.radius, distances, level);
        for k in 0..settings.bandwidths.len() {
            window.weigh(field, k, level);
            let over = if settings.divided { window.weight_sum(k) } else { 1.0 };
            for step in center.steps + 1..=self.step {
                let sum = window.step(field, k, self.start(step, k), level);
                // Eq. 10 and Eq. 12, but for the common divisor Σ g_t.
                center.errors[k] += Settings::step_weight(step) * sum / over;
            }
            if !self.last && settings.assembled == Assembled::Image {
                self.assemble(window, k, ASSEMBLED * k, patch);
            }
        }
        center.steps = self.step;
        center.k = least(&settings.bandwidths, &center.errors);
        if !self.last && settings.assembled == Assembled::One {
            self.assemble(window, center.k, 0, patch);
        }
        if self.last {
            window.fit(field, center.k, settings.prefiltered, level);
            self.blend(window, center, patch);
        }
        if self.grows {
            let width = self.size.0;
            for (p, w) in window.pixels(center.k).iter().zip(window.weights(center.k)) {
                let (x, y) = (*p as usize % width, *p as usize / width);
                let (x, y) = (x.wrapping_sub(tile.x), y.wrapping_sub(tile.y));
                if *w >= settings.coverage && x < tile.width && y < tile.height {
                    covered[y * tile.width + x] = true;
                }
            }
        }
    }

    /// What step `step` starts from.
    fn start(&self, step: usize, k: usize) -> Start<'_> {
        match (step, self.settings.assembled) {
            (1, _) => Start::First,
            (_, Assembled::Local) => Start::Own,
            (step, which) => {
                let images = &self.images[step - 2];
                let image = &images[if which == Assembled::One { 0 } else { k }];
                Start::Images { value: image.value.each_ref().map(Vec::as_slice), variance: &image.variance }
            }
        }
    }

    /// Adds y_t and Var_t of bandwidth number `k` to the image that the next step starts from.
    fn assemble(&self, window: &Window, k: usize, first: usize, patch: &mut Patch) {
        let ([r, g, b], variance, m) = (window.value(k), window.variance(k), window.center());
        for (i, (p, w)) in window.pixels(k).iter().zip(window.weights(k)).enumerate() {
            if *w >= self.settings.coverage {
                let place = self.place(patch, *p);
                let values = [m[0] + r[i], m[1] + g[i], m[2] + b[i], variance[i]];
                patch.add(first, place, w.max(FAINT), values);
            }
        }
    }

    /// Eq. 13: adds the fitted u and M, and the error of the last step.
    fn blend(&self, window: &Window, center: &Center, patch: &mut Patch) {
        let (u, y, error, m) = (window.fitted(), window.refitted(), window.error(center.k), window.center());
        let bandwidth = self.settings.bandwidths[center.k];
        for (i, (p, w)) in window.pixels(center.k).iter().zip(window.weights(center.k)).enumerate() {
            if *w >= self.settings.coverage {
                let (place, w) = (self.place(patch, *p), w.max(FAINT));
                let u = [0, 1, 2].map(|c| m[c] + u[c][i]);
                let y = [0, 1, 2].map(|c| m[c] + y[c][i]);
                patch.add(0, place, w, [u[0], u[1], u[2], y[0], y[1], y[2], error[i]]);
                patch.note(place, w, center.radius, bandwidth);
            }
        }
    }

    fn place(&self, patch: &Patch, pixel: u32) -> usize {
        let width = self.size.0;
        patch.place(pixel as usize % width, pixel as usize / width)
    }
}

/// Eq. 9: number of the bandwidth with the least error; the smallest bandwidth of several, whatever their order.
pub(crate) fn least(bandwidths: &[f32], errors: &[f64]) -> usize {
    let pairs = bandwidths.iter().zip(errors).enumerate();
    let best = pairs.min_by(|(_, (a, e)), (_, (b, f))| e.total_cmp(f).then(a.total_cmp(b)));
    best.map_or(0, |(k, _)| k)
}
