//! A row of pixels and a row of neighbours.

use super::layout::Layout;

/// Horizontal offsets at which some pixel of the tile has its neighbour in the image, and the width of its rows in whole lanes.
pub(super) struct Columns {
    pub first: isize,
    pub last: isize,
    pub width: usize,
}

/// A row of the tile and the row of its neighbours `dy` further.
pub(super) struct Rows<'a> {
    pub layout: &'a Layout,
    pub area: &'a [f32],
    pub columns: &'a Columns,
    pub row: usize,
    pub dy: isize,
}

impl<'a> Rows<'a> {
    /// The pixels in plane `k`.
    #[inline(always)]
    pub fn own(&self, k: usize) -> &'a [f32] {
        &self.area[self.start(k)..][..self.columns.width]
    }

    /// Their neighbours in plane `k` at the offsets from `first` to `last`, from the first of the first pixel to the last of the
    /// last.
    #[inline(always)]
    pub fn others(&self, k: usize, first: isize, last: isize) -> &'a [f32] {
        let shift = self.dy * self.layout.area.pitch as isize + first;
        let offsets = (last - first) as usize;
        &self.area[self.start(k).wrapping_add_signed(shift)..][..self.columns.width + offsets]
    }

    #[inline(always)]
    fn start(&self, k: usize) -> usize {
        let grid = &self.layout.area;
        grid.origin() + self.row * grid.pitch + k * grid.plane
    }
}
