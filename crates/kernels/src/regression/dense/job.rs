//! What the workers of one call share, and what each of them reads and writes.

use super::guide::{Layout, lines, scaled_variances};
use super::moments::Slots;
use super::params::{Fit, Planes, Solver};
use super::prediction::Prediction;
use super::units;
use crate::engine::{Grid, InstructionSet, LINE, MAX_LANES, Plane, Tile};

/// Tile, (width, height) in pixels: wider than any window's radius, so that windows reach into the tiles beside it alone.
pub(super) const TILE: (usize, usize) = (32, 32);

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

impl<'a> Job<'a> {
    pub fn new(fit: &'a Fit, planes: &'a Planes<'a>, level: InstructionSet) -> Self {
        let weighting = fit.weighting;
        let guides: Vec<_> = planes.guide.iter().collect();
        let layout = Layout::new(weighting, &guides, TILE);
        let reach = weighting.window;
        Self {
            fit,
            planes,
            variances: scaled_variances(&weighting, &guides),
            slots: Slots { features: planes.features.len(), side: layout.side() },
            ranges: units::ranges(planes),
            area: Grid::new(reach, reach, layout.wide + 2 * reach + MAX_LANES, TILE.1 + 2 * reach),
            layout,
            level,
        }
    }

    /// Values of the parts: guide, vertical sums, border, weights.
    pub fn single_sizes(&self) -> [usize; 4] {
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
    pub fn double_sizes(&self) -> [usize; 7] {
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

    /// Columns of the window around a column of the image, or around the last one.
    pub fn columns(&self, x: usize) -> usize {
        let (reach, last) = (self.layout.weighting.window, self.layout.weighting.width - 1);
        let x = x.min(last);
        (x + reach).min(last) - x.saturating_sub(reach) + 1
    }

    /// Copies features and colours, 0 beyond the image.
    pub fn fill_area(&self, tile: Tile, to: &mut [f64]) {
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

    pub fn prediction(&self, tile: Tile, sums: &[f64]) -> Prediction {
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
