//! Weights of the guide (rousselle2013rdfc, Sec. 4, Eq. 2) for one pair of opposite offsets: maps of Δ², patch means, weights,
//! what opposite neighbours share, and smoothing.

use super::boxes::{Region, sums};
use super::counts::Counts;
use super::exponential::exponential;
use super::frames::Around;
use super::layout::{Layout, Place, row, row_mut};
use super::offset::{Offset, both_seen, keep_only};
use super::pairs::{share_all, share_near};
use super::squares::{Square, add_mean, add_one};
use crate::nlm::{Pairs, Taps, WeightRules};

/// Of the neighbour at an offset, of the opposite one, and of their mean.
pub(super) type Three = [Vec<f32>; 3];

/// Maps of one pair of offsets. What lies beyond the image in them means nothing.
#[derive(Clone, Debug)]
pub(super) struct Maps {
    /// Σ_c Δ²_c.
    squares: Three,
    /// d².
    pub distances: Three,
    /// Weights; of the tile's pixels, smoothed and shared, at last.
    pub weights: Three,
    /// Shares of the weights of the mean, where only near neighbours share.
    pub shares: Vec<f32>,
    across: Vec<f32>,
    smooth: Vec<f32>,
}

impl Maps {
    /// Room for the maps of one pair.
    pub fn new(layout: &Layout) -> Self {
        let map = || vec![0.0; layout.map.plane];
        let three = || [map(), map(), map()];
        Self {
            squares: three(),
            distances: three(),
            weights: three(),
            shares: map(),
            across: map(),
            smooth: map(),
        }
    }
}

/// What all passes share.
#[derive(Clone, Copy)]
pub(super) struct Guides<'a> {
    pub layout: &'a Layout,
    pub place: Place,
    pub square: Square,
    pub rules: WeightRules,
    pub here: &'a Around,
    pub there: &'a Around,
    pub offset: Offset,
}

impl Guides<'_> {
    /// Whether opposite neighbours share.
    #[inline(always)]
    pub fn shares(&self) -> bool {
        self.rules.pairs != Pairs::None && self.offset.has_opposite()
    }

    /// Which of the three maps are needed.
    #[inline(always)]
    fn kinds(&self) -> usize {
        match (self.offset.has_opposite(), self.shares()) {
            (false, _) => 1,
            (true, false) => 2,
            (true, true) => 3,
        }
    }

    #[inline(always)]
    fn tile(&self, around: usize) -> Region {
        Region { width: self.place.tile.width, height: self.place.tile.height, around }
    }

    /// Maps of Δ² for all passes.
    #[inline(always)]
    pub fn squares(&self, maps: &mut Maps) {
        let Self { layout, square, offset, here, there, .. } = *self;
        let region = self.tile(layout.margin);
        let (left, n) = (region.left(), region.columns());
        for y in region.rows() {
            for kind in 0..self.kinds() {
                let to = row_mut(&mut maps.squares[kind], &layout.map, (left, y), n);
                to.fill(0.0);
                if self.rules.taps == Taps::Clipped && !self.place.has_row(y) {
                    continue;
                }
                for c in 0..layout.channels {
                    let p = here.guide(layout, c, (left, y), n);
                    let q = |side: usize| {
                        let (dx, dy) = offset.side(side);
                        there.guide(layout, c, (left + dx, y + dy), n)
                    };
                    if kind < 2 {
                        add_one(square, to, p, q(kind));
                    } else {
                        add_mean(square, to, p, [q(0), q(1)]);
                    }
                }
                if self.rules.taps == Taps::Clipped {
                    keep_only(to, self.place.columns(left, n));
                }
            }
        }
    }

    /// Weights of a pass of patch radius `patch`. `taps` counts the taps of its patches in a tile and what smoothing reaches,
    /// `boxes` the pixels of the boxes of smoothing in the tile.
    #[inline(always)]
    pub fn weights(&self, maps: &mut Maps, patch: usize, taps: &Counts, boxes: &Counts) {
        let grid = &self.layout.map;
        let radius = self.rules.smoothing.radius(patch);
        let region = self.tile(radius);
        let (left, n) = (region.left(), region.columns());
        for kind in 0..self.kinds() {
            sums(grid, region, patch, &maps.squares[kind], &mut maps.across, &mut maps.distances[kind]);
            for y in region.rows() {
                let terms = self.layout.channels as f32 * taps.rows(y);
                let distances = row_mut(&mut maps.distances[kind], grid, (left, y), n);
                let weights = row_mut(&mut maps.weights[kind], grid, (left, y), n);
                for ((distance, weight), columns) in distances.iter_mut().zip(weights).zip(&taps.columns) {
                    *distance /= terms * columns;
                    *weight = exponential(*distance);
                }
            }
        }
        if self.shares() && self.rules.pairs == Pairs::Raw {
            self.share_all(maps, region);
        }
        if radius > 0 {
            self.smooth(maps, radius, boxes);
        }
        if self.shares() && self.rules.pairs == Pairs::Near {
            self.share_near(maps);
        }
    }

    #[inline(always)]
    fn share_all(&self, maps: &mut Maps, region: Region) {
        let grid = &self.layout.map;
        let (left, n) = (region.left(), region.columns());
        let [first, second, mean] = &mut maps.weights;
        for y in region.rows() {
            let both = both_seen(&self.place, self.rules.border, (left, y), self.offset, n);
            share_all(
                &mut row_mut(first, grid, (left, y), n)[both.clone()],
                &mut row_mut(second, grid, (left, y), n)[both.clone()],
                &row(mean, grid, (left, y), n)[both],
            );
        }
    }

    #[inline(always)]
    fn share_near(&self, maps: &mut Maps) {
        let grid = &self.layout.map;
        let n = self.place.tile.width;
        let [first, second, mean] = &mut maps.weights;
        for y in self.tile(0).rows() {
            let both = both_seen(&self.place, self.rules.border, (0, y), self.offset, n);
            let shares = row_mut(&mut maps.shares, grid, (0, y), n);
            keep_only(shares, both.clone());
            let distances = [0, 1].map(|side| &row(&maps.distances[side], grid, (0, y), n)[both.clone()]);
            share_near(
                (
                    &mut row_mut(first, grid, (0, y), n)[both.clone()],
                    &mut row_mut(second, grid, (0, y), n)[both.clone()],
                ),
                &row(mean, grid, (0, y), n)[both.clone()],
                (distances[0], distances[1]),
                &mut shares[both],
            );
        }
    }

    /// Means over the pixels of each box that lie in the image.
    #[inline(always)]
    fn smooth(&self, maps: &mut Maps, radius: usize, boxes: &Counts) {
        let grid = &self.layout.map;
        let (wide, tile) = (self.tile(radius), self.tile(0));
        let (left, n) = (wide.left(), wide.columns());
        // Raw pairs have shared already.
        let kinds = if self.rules.pairs == Pairs::Raw { self.kinds().min(2) } else { self.kinds() };
        for kind in 0..kinds {
            for y in wide.rows() {
                let inside = if self.place.has_row(y) { self.place.columns(left, n) } else { 0..0 };
                keep_only(row_mut(&mut maps.weights[kind], grid, (left, y), n), inside);
            }
            sums(grid, tile, radius, &maps.weights[kind], &mut maps.across, &mut maps.smooth);
            for y in tile.rows() {
                let to = row_mut(&mut maps.weights[kind], grid, (0, y), tile.width);
                let sums = row(&maps.smooth, grid, (0, y), tile.width);
                let rows = boxes.rows(y);
                for ((weight, sum), columns) in to.iter_mut().zip(sums).zip(boxes.own_columns()) {
                    *weight = sum / (rows * columns);
                }
            }
        }
    }
}
