//! The regression: tile by tile the weights of all windows, then row by row models and what they predict.

use super::distances::Group;
use super::guide::{GROUP, Layout, lines, scaled_variances};
use super::model::Model;
use super::moments::Slots;
use super::params::{Fit, Planes, Solver};
use super::prediction::Prediction;
use super::solve::Normal;
use super::units;
use super::weigh::Weigh;
use crate::engine::{
    Copies, Grid, InstructionSet, LINE, MAX_LANES, Plane, Scratch, Tile, Window, for_each_tile, map_tiles,
};

/// Tile, (width, height) in pixels: wider than any window's radius, so that windows reach into the tiles beside it alone.
const TILE: (usize, usize) = (32, 32);

/// One call's constants, shared by all workers.
pub(super) struct Job<'a> {
    pub fit: &'a Fit,
    pub planes: &'a Planes<'a>,
    pub variances: Vec<Vec<f32>>,
    pub layout: Layout,
    pub slots: Slots,
    /// Of the features, over the image.
    pub ranges: Vec<f64>,
    /// Copies of features and colours with the window around the tile; sums of predictions alike.
    pub area: Grid,
    pub level: InstructionSet,
}

/// A worker's memory.
struct Memory {
    pub single: Scratch,
    pub double: Scratch<f64>,
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
                            prediction.add(tile, j, sums, TILE.0);
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
    pub fn weights_of_row(&self) -> usize {
        self.layout.side() * self.layout.side() * self.layout.wide + LINE
    }

    /// Units of one feature in a tile.
    pub fn units(&self) -> usize {
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
    pub fn columns(&self, x: usize) -> usize {
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
pub(super) struct View<'a> {
    pub guide: &'a Plane,
    pub border: &'a Plane,
    pub area: &'a Plane<f64>,
    pub vertical: &'a mut Plane,
    pub weights: &'a mut Plane,
    pub sums: &'a mut Plane<f64>,
    pub work: &'a mut Plane<f64>,
    pub moments: &'a mut Plane<f64>,
    pub coefficients: &'a mut Plane<f64>,
    pub base: &'a mut Plane<f64>,
}
