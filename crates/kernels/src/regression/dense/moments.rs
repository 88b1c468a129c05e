//! Moments of the models of a vector of neighbouring pixels: one model in each lane.
//!
//! Columns are [1, dx, dy, differences of features], right sides the three colours. dx and dy are the same in every lane: per row
//! of the window only Σ w·z and Σ w·dx·z are summed, and dy is a factor on the sums of its row.

#![expect(clippy::needless_range_loop, reason = "fixed counts, unrolled; iterators may end up as calls")]

use crate::engine::{Plane, Simd};

/// Where planes and sums lie, for `n` features.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slots {
    pub features: usize,
    /// Pixels of a window's side.
    pub side: usize,
}

/// Sums of the position alone: Σ w, w·dx, w·dx², w·dy, w·dx·dy, w·dy².
pub(super) const POSITIONS: usize = 6;

impl Slots {
    /// Factors on the left: w, w·dx, w·differences.
    pub fn left(&self) -> usize {
        2 + self.features
    }

    /// Factors on the right: differences, colours.
    pub fn right(&self) -> usize {
        self.features + 3
    }

    /// Values of one row of the window, per lane: w, w·dx, differences.
    pub fn row(&self) -> usize {
        self.left() * self.side
    }

    /// Sums of a model: positions, then for each factor on the left all on the right, then those of w·dy.
    pub fn sums(&self) -> usize {
        POSITIONS + (self.left() + 1) * self.right()
    }

    /// Where the sums of a factor on the left with one on the right are, `left` = [`Self::left`] for w·dy.
    pub fn sum(&self, left: usize, right: usize) -> usize {
        POSITIONS + left * self.right() + right
    }
}

/// Copies that the moments of a tile's models read.
#[derive(Clone, Copy)]
pub(super) struct Area<'a> {
    /// Features, then colours, with the window around the tile.
    pub planes: &'a Plane<f64>,
    /// Between planes.
    pub plane: usize,
}

/// One row of the window, for the pixels of a vector.
#[derive(Clone, Copy)]
pub(super) struct Row {
    /// Where the pixels are in the area, and their neighbours at dx = −R.
    pub here: usize,
    pub there: usize,
    /// Where weights of dx = −R start, and how far those of the next dx are.
    pub weights: usize,
    pub step: usize,
    pub dy: isize,
    pub reach: isize,
}

/// Adds one row of the window to the sums.
#[inline(always)]
pub(super) fn add_row<S: Simd>(
    s: S,
    slots: &Slots,
    area: Area<'_>,
    (weights, row): (&Plane, Row),
    work: &mut Plane<f64>,
    sums: &mut Plane<f64>,
) {
    let lanes = S::DOUBLES;
    let stride = slots.side * lanes;
    let mut any = false;
    let (mut one, mut by_x, mut by_xx) = (s.splat_double(0.0), s.splat_double(0.0), s.splat_double(0.0));
    for i in 0..slots.side {
        let w = s.load_widened(weights, row.weights + i * row.step);
        any |= s.any_double(w);
        let dx = s.splat_double((i as isize - row.reach) as f64);
        let wx = s.mul_doubles(w, dx);
        one = s.add_doubles(one, w);
        by_x = s.add_doubles(by_x, wx);
        by_xx = s.fma_doubles(wx, dx, by_xx);
        s.store_doubles(work, i * lanes, w);
        s.store_doubles(work, stride + i * lanes, wx);
    }
    if !any {
        return;
    }
    for j in 0..slots.features {
        let here = s.load_doubles(area.planes, j * area.plane + row.here);
        let (from, to) = (j * area.plane + row.there, (2 + j) * stride);
        for i in 0..slots.side {
            let there = s.load_doubles(area.planes, from + i);
            s.store_doubles(work, to + i * lanes, s.sub_doubles(there, here));
        }
    }
    let dy = s.splat_double(row.dy as f64);
    let of_y = [s.mul_doubles(one, dy), s.mul_doubles(by_x, dy), s.mul_doubles(s.mul_doubles(one, dy), dy)];
    for (i, value) in [one, by_x, by_xx].into_iter().chain(of_y).enumerate() {
        add(s, sums, i * lanes, value);
    }
    let row = Products { slots, area, there: row.there, stride, dy };
    let mut left = 0;
    while left < slots.left() {
        let tall = (slots.left() - left).min(3);
        // Differences times differences: the upper half.
        let mut from = left.saturating_sub(2);
        while from < slots.features {
            // At most four at a time, and three and three rather than four and two.
            let wide = match slots.features - from {
                rest @ 1..=4 => rest,
                5 | 6 => 3,
                _ => 4,
            };
            row.differences(s, (left, tall), (from, wide), work, sums);
            from += wide;
        }
        row.colors(s, (left, tall), work, sums);
        left += tall;
    }
}

#[inline(always)]
fn add<S: Simd>(s: S, sums: &mut Plane<f64>, at: usize, value: S::D) {
    let old = s.load_doubles(sums, at);
    s.store_doubles(sums, at, s.add_doubles(old, value));
}

/// Sums of products over the neighbours of one row.
struct Products<'a, S: Simd> {
    slots: &'a Slots,
    area: Area<'a>,
    there: usize,
    stride: usize,
    dy: S::D,
}

impl<S: Simd> Products<'_, S> {
    /// Of some factors on the left with some differences.
    #[inline(always)]
    fn differences(
        &self,
        s: S,
        (left, tall): (usize, usize),
        (from, wide): (usize, usize),
        work: &Plane<f64>,
        sums: &mut Plane<f64>,
    ) {
        match (tall, wide) {
            (3, 4) => self.of::<3, 4, false>(s, left, from, work, sums),
            (3, 3) => self.of::<3, 3, false>(s, left, from, work, sums),
            (3, 2) => self.of::<3, 2, false>(s, left, from, work, sums),
            (3, _) => self.of::<3, 1, false>(s, left, from, work, sums),
            // The last rows: no more differences than they are themselves.
            (2, 2) => self.of::<2, 2, false>(s, left, from, work, sums),
            (2, _) => self.of::<2, 1, false>(s, left, from, work, sums),
            _ => self.of::<1, 1, false>(s, left, from, work, sums),
        }
    }

    /// Of some factors on the left with the colours.
    #[inline(always)]
    fn colors(&self, s: S, (left, tall): (usize, usize), work: &Plane<f64>, sums: &mut Plane<f64>) {
        let from = self.slots.features;
        match tall {
            3 => self.of::<3, 3, true>(s, left, from, work, sums),
            2 => self.of::<2, 3, true>(s, left, from, work, sums),
            _ => self.of::<1, 3, true>(s, left, from, work, sums),
        }
    }

    /// `L` factors on the left with `R` on the right, which are colours or differences; the sums in registers.
    #[inline(always)]
    fn of<const L: usize, const R: usize, const COLORS: bool>(
        &self,
        s: S,
        left: usize,
        from: usize,
        work: &Plane<f64>,
        sums: &mut Plane<f64>,
    ) {
        let lanes = S::DOUBLES;
        let zero = s.splat_double(0.0);
        let mut sum = [[zero; R]; L];
        let first = left == 0;
        for k in 0..self.slots.side {
            let mut factors = [zero; L];
            for i in 0..L {
                factors[i] = s.load_doubles(work, (left + i) * self.stride + k * lanes);
                // w and w·dx are there, of differences what is weighed.
                if !first || i >= 2 {
                    factors[i] = s.mul_doubles(factors[i], s.load_doubles(work, k * lanes));
                }
            }
            for j in 0..R {
                let value = if COLORS {
                    s.load_doubles(self.area.planes, (from + j) * self.area.plane + self.there + k)
                } else {
                    s.load_doubles(work, (2 + from + j) * self.stride + k * lanes)
                };
                for i in 0..L {
                    sum[i][j] = s.fma_doubles(factors[i], value, sum[i][j]);
                }
            }
        }
        for i in 0..L {
            for j in 0..R {
                add(s, sums, self.slots.sum(left + i, from + j) * lanes, sum[i][j]);
                if first && i == 0 {
                    let by_y = s.mul_doubles(sum[i][j], self.dy);
                    add(s, sums, self.slots.sum(self.slots.left(), from + j) * lanes, by_y);
                }
            }
        }
    }
}
