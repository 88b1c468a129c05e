//! Sums over boxes: across rows, then down columns, each in one order for every pixel.

use super::layout::{row, row_mut};
use crate::engine::Grid;

/// A tile and so many pixels around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    /// Tile columns.
    pub width: usize,
    /// Tile rows.
    pub height: usize,
    /// Pixels on every side.
    pub around: usize,
}

impl Region {
    /// Column of its first pixel from the tile's.
    #[inline(always)]
    pub fn left(self) -> isize {
        -(self.around as isize)
    }

    /// Its columns.
    #[inline(always)]
    pub fn columns(self) -> usize {
        self.width + 2 * self.around
    }

    /// Its rows from the tile's first.
    #[inline(always)]
    pub fn rows(self) -> std::ops::Range<isize> {
        self.left()..(self.height + self.around) as isize
    }

    /// With `by` more pixels on every side.
    #[inline(always)]
    pub fn grown(self, by: usize) -> Self {
        Self { around: self.around + by, ..self }
    }
}

/// Sums of a map over boxes of `radius` around each pixel of the region, by way of `across`.
#[inline(always)]
pub(super) fn sums(
    grid: &Grid,
    region: Region,
    radius: usize,
    from: &[f32],
    across: &mut [f32],
    to: &mut [f32],
) {
    let (reach, left, columns) = (radius as isize, region.left(), region.columns());
    for y in region.grown(radius).rows() {
        let from = row(from, grid, (left - reach, y), columns + 2 * radius);
        add(radius, row_mut(across, grid, (left, y), columns), |i| &from[i..]);
    }
    for y in region.rows() {
        let to = row_mut(to, grid, (left, y), columns);
        add(radius, to, |i| row(across, grid, (left, y - reach + i as isize), columns));
    }
}

/// Sum of the slices `part(0)` to `part(2·radius)`.
#[inline(always)]
fn add<'a>(radius: usize, to: &mut [f32], part: impl Fn(usize) -> &'a [f32]) {
    if radius == 0 {
        to.copy_from_slice(&part(0)[..to.len()]);
        return;
    }
    let (a, b, c) = (part(0), part(1), part(2));
    for (((to, a), b), c) in to.iter_mut().zip(a).zip(b).zip(c) {
        *to = a + b + c;
    }
    for i in 1..radius {
        let (a, b) = (part(2 * i + 1), part(2 * i + 2));
        for ((to, a), b) in to.iter_mut().zip(a).zip(b) {
            *to = *to + a + b;
        }
    }
}
