//! The models of a tile, row by row: moments, solution, predictions.

use super::job::{Job, View};
use super::moments::{Area, Row, add_row};
use super::params::Solver;
use super::predict::{Line, Models};
use super::solve::Normal;
use crate::engine::{Kernel, Simd, Tile};

/// Models of a tile and what they predict.
pub(super) struct Model<'a, 'b> {
    pub job: &'a Job<'a>,
    pub tile: Tile,
    pub view: &'a mut View<'b>,
    pub normal: &'a mut Normal,
    pub units: &'a [f64],
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
