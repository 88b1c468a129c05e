//! Moments of the models of a vector of neighbouring pixels: one model in each lane.
//!
//! Columns are [1, dx, dy, differences of features], right sides the three colours. dx and dy are the same in every lane: per row
//! of the window only Σ w·z and Σ w·dx·z are summed, and dy is a factor on the sums of its row.

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

    /// Values of one row of the window, per lane.
    pub fn row(&self) -> usize {
        (self.left() + self.right()) * self.side
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
    let right = slots.left() * stride;
    // Neighbours that have a weight in some lane.
    let mut count = 0;
    let (mut one, mut by_x, mut by_xx) = (s.splat_double(0.0), s.splat_double(0.0), s.splat_double(0.0));
    for i in 0..slots.side {
        let w = s.load_widened(weights, row.weights + i * row.step);
        if !s.any_double(w) {
            continue;
        }
        let dx = s.splat_double((i as isize - row.reach) as f64);
        let wx = s.mul_doubles(w, dx);
        one = s.add_doubles(one, w);
        by_x = s.add_doubles(by_x, wx);
        by_xx = s.fma_doubles(wx, dx, by_xx);
        let at = count * lanes;
        s.store_doubles(work, at, w);
        s.store_doubles(work, stride + at, wx);
        for j in 0..slots.features {
            let plane = j * area.plane;
            let here = s.load_doubles(area.planes, plane + row.here);
            let difference = s.sub_doubles(s.load_doubles(area.planes, plane + row.there + i), here);
            s.store_doubles(work, (2 + j) * stride + at, s.mul_doubles(w, difference));
            s.store_doubles(work, right + j * stride + at, difference);
        }
        for c in 0..3 {
            let plane = (slots.features + c) * area.plane;
            let color = s.load_doubles(area.planes, plane + row.there + i);
            s.store_doubles(work, right + (slots.features + c) * stride + at, color);
        }
        count += 1;
    }
    if count == 0 {
        return;
    }
    let dy = s.splat_double(row.dy as f64);
    let by_y = s.mul_doubles(one, dy);
    for (i, value) in
        [one, by_x, by_xx, by_y, s.mul_doubles(by_x, dy), s.mul_doubles(by_y, dy)].into_iter().enumerate()
    {
        let old = s.load_doubles(sums, i * lanes);
        s.store_doubles(sums, i * lanes, s.add_doubles(old, value));
    }
    let mut block = Block { slots, count, stride, dy };
    let mut left = 0;
    while left < slots.left() {
        let tall = (slots.left() - left).min(3);
        // Differences times differences: the upper half.
        let mut from = left.saturating_sub(2);
        while from < slots.right() {
            let wide = (slots.right() - from).min(4);
            block.any(s, (left, tall), (from, wide), work, sums);
            from += wide;
        }
        left += tall;
    }
}

/// Sums of products over the neighbours of one row.
struct Block<'a, S: Simd> {
    slots: &'a Slots,
    count: usize,
    stride: usize,
    dy: S::D,
}

impl<S: Simd> Block<'_, S> {
    #[inline(always)]
    fn any(
        &mut self,
        s: S,
        (left, tall): (usize, usize),
        (from, wide): (usize, usize),
        work: &Plane<f64>,
        sums: &mut Plane<f64>,
    ) {
        match (tall, wide) {
            (3, 4) => self.of::<3, 4>(s, left, from, work, sums),
            (3, 3) => self.of::<3, 3>(s, left, from, work, sums),
            (3, 2) => self.of::<3, 2>(s, left, from, work, sums),
            (3, _) => self.of::<3, 1>(s, left, from, work, sums),
            (2, 4) => self.of::<2, 4>(s, left, from, work, sums),
            (2, 3) => self.of::<2, 3>(s, left, from, work, sums),
            (2, 2) => self.of::<2, 2>(s, left, from, work, sums),
            (2, _) => self.of::<2, 1>(s, left, from, work, sums),
            (_, 4) => self.of::<1, 4>(s, left, from, work, sums),
            (_, 3) => self.of::<1, 3>(s, left, from, work, sums),
            (_, 2) => self.of::<1, 2>(s, left, from, work, sums),
            _ => self.of::<1, 1>(s, left, from, work, sums),
        }
    }

    /// `L` factors on the left with `R` on the right, their sums in registers.
    #[inline(always)]
    fn of<const L: usize, const R: usize>(
        &mut self,
        s: S,
        left: usize,
        from: usize,
        work: &Plane<f64>,
        sums: &mut Plane<f64>,
    ) {
        let lanes = S::DOUBLES;
        let zero = s.splat_double(0.0);
        let mut sum = [[zero; R]; L];
        let (a, b) = (left * self.stride, (self.slots.left() + from) * self.stride);
        for k in 0..self.count {
            let mut factors = [zero; L];
            for (i, factor) in factors.iter_mut().enumerate() {
                *factor = s.load_doubles(work, a + i * self.stride + k * lanes);
            }
            for j in 0..R {
                let value = s.load_doubles(work, b + j * self.stride + k * lanes);
                for i in 0..L {
                    sum[i][j] = s.fma_doubles(factors[i], value, sum[i][j]);
                }
            }
        }
        for i in 0..L {
            for j in 0..R {
                let at = self.slots.sum(left + i, from + j) * lanes;
                let old = s.load_doubles(sums, at);
                s.store_doubles(sums, at, s.add_doubles(old, sum[i][j]));
                if left + i == 0 {
                    let at = self.slots.sum(self.slots.left(), from + j) * lanes;
                    let old = s.load_doubles(sums, at);
                    s.store_doubles(sums, at, s.fma_doubles(sum[i][j], self.dy, old));
                }
            }
        }
    }
}
