//! The regression: tile by tile the weights of all windows, then row by row models and what they predict.

use super::distances::{Distances, Group};
use super::guide::{GROUP, Layout, lines, scaled_variances};
use super::moments::{Area, Row, Slots, add_row};
use super::params::{Fit, Join, Planes, Solver};
use super::predict::{Line, Models};
use super::solve::Normal;
use super::units;
use crate::engine::{
    Copies, Grid, InstructionSet, Kernel, LINE, MAX_LANES, Plane, Scratch, Simd, Tile, Window, for_each_tile,
    map_tiles,
};

/// Tile, (width, height) in pixels: wider than any window's radius, so that windows reach into the tiles beside it alone.
const TILE: (usize, usize) = (32, 32);

/// One call's constants, shared by all workers.
struct Job<'a> {
    fit: &'a Fit,
    planes: &'a Planes<'a>,
    variances: Vec<Vec<f32>>,
    layout: Layout,
    slots: Slots,
    /// Of the features, over the image.
    ranges: Vec<f64>,
    /// Copies of features and colours with the window around the tile; sums of predictions alike.
    area: Grid,
    level: InstructionSet,
}

/// A worker's memory.
struct Memory {
    single: Scratch,
    double: Scratch<f64>,
}

/// Runs a checked call.
pub(super) fn regress(fit: &Fit, planes: &Planes<'_>, level: InstructionSet) -> [Vec<f32>; 3] {
    let weighting = fit.weighting;
    let guides: Vec<_> = planes.guide.iter().collect();
    let layout = Layout::new(weighting, planes.guide.len(), TILE);
    let reach = weighting.window;
    let job = Job {
        fit,
        planes,
        variances: scaled_variances(&weighting, &guides),
        slots: Slots { features: planes.features.len(), side: layout.side() },
        ranges: units::ranges(planes),
        area: Grid::new(reach, reach, layout.wide + 2 * reach + MAX_LANES, TILE.1 + 2 * reach),
        layout,
        level,
    };
    let size = (weighting.width, weighting.height);
    let predictions = map_tiles(size, TILE, || job.memory(), |memory, tile| job.run(memory, tile));
    let mut out = [0, 1, 2].map(|_| vec![0.0; weighting.width * weighting.height]);
    let across = weighting.width.div_ceil(TILE.0);
    for_each_tile(
        weighting.width,
        TILE,
        out.iter_mut().map(Vec::as_mut_slice),
        || vec![0.0f64; 4 * TILE.0],
        |sums, tile, mut rows| {
            for j in 0..tile.height {
                sums.fill(0.0);
                // All tiles whose windows reach here, in one order.
                for ty in (tile.y / TILE.1).saturating_sub(1)..=tile.y / TILE.1 + 1 {
                    for tx in (tile.x / TILE.0).saturating_sub(1)..=tile.x / TILE.0 + 1 {
                        if tx < across
                            && let Some(prediction) = predictions.get(ty * across + tx)
                        {
                            prediction.add(tile, j, sums);
                        }
                    }
                }
                for (c, rows) in rows.iter_mut().enumerate() {
                    for (i, to) in rows[j].iter_mut().enumerate() {
                        // The pixel's own model has a weight of at least 1e-4.
                        *to = (sums[c * TILE.0 + i] / sums[3 * TILE.0 + i]) as f32;
                    }
                }
            }
        },
    );
    out
}

/// Sums of the predictions of one tile's models: three colours, then Σ w, for the tile and the window around it.
struct Prediction {
    tile: Tile,
    reach: usize,
    sums: Vec<f32>,
}

impl Prediction {
    /// Adds what they say of row `j` of a tile to four rows of sums.
    fn add(&self, to: Tile, j: usize, sums: &mut [f64]) {
        let (columns, rows) = (self.tile.width + 2 * self.reach, self.tile.height + 2 * self.reach);
        let Some(row) = (to.y + j + self.reach).checked_sub(self.tile.y).filter(|row| *row < rows) else {
            return;
        };
        // Column `i` of the tile is column `i + shift` here.
        let shift = (to.x + self.reach) as isize - self.tile.x as isize;
        let first = (-shift).max(0) as usize;
        let end = (columns as isize - shift).clamp(0, to.width as isize) as usize;
        if first >= end {
            return;
        }
        for c in 0..4 {
            let start = ((c * rows + row) * columns).wrapping_add_signed(shift);
            let from = &self.sums[start.wrapping_add(first)..];
            for (sum, value) in sums[c * TILE.0 + first..c * TILE.0 + end].iter_mut().zip(from) {
                *sum += f64::from(*value);
            }
        }
    }
}

impl Job<'_> {
    fn memory(&self) -> Memory {
        Memory {
            single: Scratch::new(self.single_sizes().iter().sum()),
            double: Scratch::new(self.double_sizes().iter().sum()),
        }
    }

    /// Values of the parts: guide, vertical sums, border, weights.
    fn single_sizes(&self) -> [usize; 4] {
        let layout = &self.layout;
        [
            lines(layout.guide_size()),
            lines(layout.sums_size()),
            lines(layout.border_size()),
            TILE.1 * self.weights_of_row(),
        ]
    }

    /// Values of the parts: area, sums of predictions, a row of a window, sums of models, coefficients, base,
    /// units.
    fn double_sizes(&self) -> [usize; 7] {
        [
            self.slots.right() * self.area.plane,
            4 * self.area.plane,
            lines(self.slots.row() * MAX_LANES),
            lines(self.slots.sums() * MAX_LANES),
            3 * (3 + self.slots.features) * self.layout.wide,
            3 * self.layout.wide,
            if self.fit.solver == Solver::MinimalNorm { self.slots.features * self.units() } else { 0 },
        ]
    }

    /// Values from the weights of one row of the tile to those of the next: a line more, so that rows fall into different
    /// cache sets.
    fn weights_of_row(&self) -> usize {
        self.layout.side() * self.layout.side() * self.layout.wide + LINE
    }

    /// Units of one feature in a tile.
    fn units(&self) -> usize {
        TILE.1 * self.layout.wide
    }

    fn run(&self, memory: &mut Memory, tile: Tile) -> Prediction {
        let [guide, vertical, border, weights] = memory.single.parts(self.single_sizes());
        let [area, sums, work, moments, coefficients, base, units] = memory.double.parts(self.double_sizes());
        let weighting = &self.layout.weighting;
        let copies = Copies { width: weighting.width, height: weighting.height, tile };
        let channels: Vec<_> =
            self.planes.guide.iter().zip(&self.variances).map(|(c, v)| (c, v.as_slice())).collect();
        self.layout.fill_guide(&copies, &channels, guide);
        self.layout.fill_border(tile, border);
        self.fill_area(tile, area);
        if self.fit.solver == Solver::MinimalNorm {
            for (j, plane) in self.planes.features.iter().enumerate() {
                let size = (weighting.width, weighting.height);
                let to = (&mut units[j * self.units()..], self.layout.wide);
                units::fill(plane, size, (tile, weighting.window), self.ranges[j], to);
            }
        }
        // Neighbours beyond the image are not visited.
        weights.fill(0.0);
        sums.fill(0.0);
        // SAFETY: the parts have the sizes of the layout, whose copies reach as far around the tile as the window and the patch
        // do, and a group of offsets and a vector more; the walk keeps offsets within the reach and rows within the tile.
        let mut view = unsafe {
            View {
                guide: Plane::vouched(guide),
                border: Plane::vouched(border),
                area: Plane::vouched(area),
                vertical: Plane::vouched_mut(vertical),
                weights: Plane::vouched_mut(weights),
                sums: Plane::vouched_mut(sums),
                work: Plane::vouched_mut(work),
                moments: Plane::vouched_mut(moments),
                coefficients: Plane::vouched_mut(coefficients),
                base: Plane::vouched_mut(base),
            }
        };
        let window = Window { width: weighting.width, height: weighting.height, reach: weighting.window };
        for block in window.blocks(tile, GROUP) {
            let group = Group { rows: block.rows, dy: block.dy, dx: block.dx, count: block.count };
            self.level.launch(Weigh { job: self, tile, group: &group, view: &mut view });
        }
        let mut normal = Normal::new();
        self.level.launch(Model { job: self, tile, view: &mut view, normal: &mut normal, units });
        self.prediction(tile, sums)
    }

    /// Columns of the window around a column of the image, or around the last one.
    fn columns(&self, x: usize) -> usize {
        let (reach, last) = (self.layout.weighting.window, self.layout.weighting.width - 1);
        let x = x.min(last);
        (x + reach).min(last) - x.saturating_sub(reach) + 1
    }

    /// Copies features and colours, 0 beyond the image.
    fn fill_area(&self, tile: Tile, to: &mut [f64]) {
        let (grid, reach) = (&self.area, self.layout.weighting.window);
        let (width, height) = (self.layout.weighting.width, self.layout.weighting.height);
        let all = self.planes.features.iter().chain(&self.planes.image);
        for (k, plane) in all.enumerate() {
            for j in 0..tile.height + 2 * reach {
                let row = &mut to[k * grid.plane + j * grid.pitch..][..grid.columns];
                row.fill(0.0);
                let Some(y) = (tile.y + j).checked_sub(reach).filter(|y| *y < height) else { continue };
                let skip = reach.saturating_sub(tile.x);
                let first = tile.x.saturating_sub(reach);
                let end = (tile.x + tile.width + reach).min(width);
                for (to, from) in row[skip..].iter_mut().zip(&plane[y * width + first..y * width + end]) {
                    *to = f64::from(*from);
                }
            }
        }
    }

    fn prediction(&self, tile: Tile, sums: &[f64]) -> Prediction {
        let reach = self.layout.weighting.window;
        let (columns, rows) = (tile.width + 2 * reach, tile.height + 2 * reach);
        let mut out = Vec::with_capacity(4 * columns * rows);
        for c in 0..4 {
            for j in 0..rows {
                let row = &sums[c * self.area.plane + j * self.area.pitch..][..columns];
                out.extend(row.iter().map(|v| *v as f32));
            }
        }
        Prediction { tile, reach, sums: out }
    }
}

/// A worker's planes.
struct View<'a> {
    guide: &'a Plane,
    border: &'a Plane,
    area: &'a Plane<f64>,
    vertical: &'a mut Plane,
    weights: &'a mut Plane,
    sums: &'a mut Plane<f64>,
    work: &'a mut Plane<f64>,
    moments: &'a mut Plane<f64>,
    coefficients: &'a mut Plane<f64>,
    base: &'a mut Plane<f64>,
}

/// Weights of one group of offsets.
struct Weigh<'a, 'b> {
    job: &'a Job<'a>,
    tile: Tile,
    group: &'a Group,
    view: &'a mut View<'b>,
}

impl Kernel for Weigh<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, s: S) {
        match self.job.layout.weighting.patch {
            0 => self.weigh::<S, 0>(s),
            1 => self.weigh::<S, 1>(s),
            2 => self.weigh::<S, 2>(s),
            _ => self.weigh::<S, 3>(s),
        }
    }
}

impl Weigh<'_, '_> {
    #[inline(always)]
    fn weigh<S: Simd, const F: usize>(self, s: S) {
        let Self { job, tile, group, view } = self;
        let layout = &job.layout;
        let distances = Distances { layout, guide: view.guide, width: tile.width };
        distances.down::<S, F>(s, group, view.vertical);
        let reach = layout.weighting.window as isize;
        let offset = (group.dy + reach) as usize * layout.side() + (group.dx + reach) as usize;
        let joined = if job.fit.join == Join::Mean { layout.channels } else { 1 };
        for row in group.rows.clone() {
            let factor = s.splat(layout.row_factor(tile.y + row, group.dy, joined));
            for i in 0..group.count {
                let dx = group.dx + i as isize;
                let to = row * job.weights_of_row() + (offset + i) * layout.wide;
                let mut x = 0;
                while x < tile.width {
                    let mut sum = distances.patch::<S, F>(s, view.vertical, (0, i), row, x);
                    for c in 1..layout.channels {
                        let other = distances.patch::<S, F>(s, view.vertical, (c, i), row, x);
                        sum = if job.fit.join == Join::Mean { s.add(sum, other) } else { s.max(sum, other) };
                    }
                    let mut weight = distances.weight(s, sum, view.border, factor, dx, x);
                    if dx == 0 && group.dy == 0 {
                        weight = s.max(weight, s.load(view.border, layout.own() + x));
                    }
                    s.store(view.weights, to + x, weight);
                    x += S::LANES;
                }
            }
        }
    }
}

/// Models of a tile and what they predict.
struct Model<'a, 'b> {
    job: &'a Job<'a>,
    tile: Tile,
    view: &'a mut View<'b>,
    normal: &'a mut Normal,
    units: &'a [f64],
}

impl Kernel for Model<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, s: S) {
        for row in 0..self.tile.height {
            let mut x = 0;
            while x < self.tile.width {
                self.sum(s, row, x);
                self.solve::<S>(row, x);
                x += S::DOUBLES;
            }
            self.predict(s, row);
        }
    }
}

impl Model<'_, '_> {
    /// Rows of the window of a row of the tile that lie in the image.
    fn rows(&self, row: usize) -> std::ops::RangeInclusive<isize> {
        let (y, reach) = ((self.tile.y + row) as isize, self.reach());
        let last = self.job.layout.weighting.height as isize - 1;
        (-reach).max(-y)..=reach.min(last - y)
    }

    fn reach(&self) -> isize {
        self.job.layout.weighting.window as isize
    }

    /// Where the row's pixels are in the area, and their neighbours at dx = −R.
    fn places(&self, row: usize, dy: isize) -> [usize; 2] {
        let area = &self.job.area;
        let here = area.origin() + row * area.pitch;
        [here, here.wrapping_add_signed(dy * area.pitch as isize - self.reach())]
    }

    /// Where the weights of dx = −R start.
    fn weights(&self, row: usize, dy: isize) -> usize {
        let layout = &self.job.layout;
        row * self.job.weights_of_row() + (dy + self.reach()) as usize * layout.side() * layout.wide
    }

    /// Moments of the models of a vector of pixels.
    #[inline(always)]
    fn sum<S: Simd>(&mut self, s: S, row: usize, x: usize) {
        let slots = self.job.slots;
        for i in 0..slots.sums() {
            s.store_doubles(self.view.moments, i * S::DOUBLES, s.splat_double(0.0));
        }
        for dy in self.rows(row) {
            let [here, there] = self.places(row, dy);
            let of_window = Row {
                here: here + x,
                there: there + x,
                weights: self.weights(row, dy) + x,
                step: self.job.layout.wide,
                dy,
                reach: self.reach(),
            };
            let area = Area { planes: self.view.area, plane: self.job.area.plane };
            let View { weights, work, moments, .. } = &mut *self.view;
            add_row(s, &slots, area, (weights, of_window), work, moments);
        }
    }

    /// Coefficients of the models of a vector of pixels.
    #[inline(always)]
    fn solve<S: Simd>(&mut self, row: usize, x: usize) {
        let tall = self.rows(row).count();
        let Self { job, view, normal, .. } = self;
        let (slots, wide) = (job.slots, job.layout.wide);
        let count = 3 + slots.features;
        let absent = if job.fit.positions { 0..0 } else { 1..3 };
        for lane in 0..S::DOUBLES {
            normal.fill(&slots, |i| view.moments.get(i * S::DOUBLES + lane));
            let coefficients = match job.fit.solver {
                Solver::Dropped => {
                    let pixels = tall * job.columns(self.tile.x + x + lane);
                    normal.dropped(count, absent.clone(), pixels)
                }
                Solver::MinimalNorm => {
                    // Positions by the full window's side, also where it is cut.
                    let side = (2 * job.layout.weighting.window).max(1) as f64;
                    let at = row * wide + x + lane;
                    let unit = |j: usize| j.checked_sub(3).map_or(side, |j| self.units[j * job.units() + at]);
                    normal.minimal_norm(count, absent.clone(), unit)
                }
            };
            for (j, three) in coefficients.iter().enumerate().take(count) {
                for (c, value) in three.iter().enumerate() {
                    view.coefficients.set((3 * j + c) * wide + x + lane, *value);
                }
            }
        }
    }

    #[inline(always)]
    fn predict<S: Simd>(&mut self, s: S, row: usize) {
        let (job, area) = (self.job, &self.job.area);
        for dy in self.rows(row) {
            let [here, there] = self.places(row, dy);
            let line = Line {
                here,
                there,
                weights: self.weights(row, dy),
                step: job.layout.wide,
                sums: there,
                plane: area.plane,
                dy,
                reach: self.reach(),
                width: self.tile.width,
                wide: job.layout.wide,
            };
            let View { area: planes, weights, coefficients, base, sums, .. } = &mut *self.view;
            let models = Models {
                features: job.slots.features,
                area: Area { planes, plane: area.plane },
                weights,
                coefficients,
            };
            models.add(s, line, base, sums);
        }
    }
}
