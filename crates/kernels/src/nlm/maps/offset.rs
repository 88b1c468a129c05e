//! The walk over a window in opposite offsets.

use std::ops::Range;

use super::layout::{Layout, Place};
use crate::nlm::Border;

/// An offset, and the opposite one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offset {
    pub dx: isize,
    pub dy: isize,
}

impl Offset {
    /// Every offset of a window but (0, 0), of two opposite ones the first; then (0, 0), which is its own opposite, for
    /// frames beside the target. The same order for every pixel of every tile.
    #[inline(always)]
    pub fn all(reach: usize, beside: bool) -> impl Iterator<Item = Self> {
        let reach = reach as isize;
        (-reach..=0).flat_map(move |dy| {
            let last = match (dy, beside) {
                (0, false) => -1,
                (0, true) => 0,
                _ => reach,
            };
            (-reach..=last).map(move |dx| Self { dx, dy })
        })
    }

    /// Whether it has an opposite.
    #[inline(always)]
    pub fn has_opposite(self) -> bool {
        (self.dx, self.dy) != (0, 0)
    }

    /// The larger of both distances.
    #[inline(always)]
    pub fn distance(self) -> usize {
        self.dx.unsigned_abs().max(self.dy.unsigned_abs())
    }

    /// The offset (0) or its opposite (1).
    #[inline(always)]
    pub fn side(self, side: usize) -> (isize, isize) {
        if side == 0 { (self.dx, self.dy) } else { (-self.dx, -self.dy) }
    }

    /// Whether any window sees one of the two.
    #[inline(always)]
    pub fn is_seen(self, layout: &Layout, border: Border) -> bool {
        border == Border::Mirrored
            || (self.dx.unsigned_abs() < layout.width && self.dy.unsigned_abs() < layout.height)
    }
}

/// Which of `length` pixels, the first at `at` from the tile's, see their neighbours at an offset; as places among them.
#[inline(always)]
pub(super) fn seen(
    place: &Place,
    border: Border,
    at: (isize, isize),
    (dx, dy): (isize, isize),
    length: usize,
) -> Range<usize> {
    match border {
        Border::Mirrored => 0..length,
        Border::Clipped if place.has_row(at.1 + dy) => place.columns(at.0 + dx, length),
        Border::Clipped => 0..0,
    }
}

/// Which of them see both their neighbour and the opposite one.
#[inline(always)]
pub(super) fn both_seen(
    place: &Place,
    border: Border,
    at: (isize, isize),
    offset: Offset,
    length: usize,
) -> Range<usize> {
    let [a, b] = [0, 1].map(|side| seen(place, border, at, offset.side(side), length));
    let start = a.start.max(b.start);
    start..a.end.min(b.end).max(start)
}

/// Sets what is not in a range to 0.
#[inline(always)]
pub(super) fn keep_only(values: &mut [f32], range: Range<usize>) {
    values[range.end..].fill(0.0);
    values[..range.start].fill(0.0);
}
