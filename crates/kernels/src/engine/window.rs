//! The walk over a search window.

use std::ops::Range;

use super::Tile;

/// A square window around each pixel, clipped to the image.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// Image width in pixels.
    pub width: usize,
    /// Image height in pixels.
    pub height: usize,
    /// Window radius r.
    pub reach: usize,
}

/// A few neighbours in a row: horizontal offsets dx, dx + 1, … at vertical offset dy.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Tile rows whose neighbours lie inside the image.
    pub rows: Range<usize>,
    pub dy: isize,
    pub dx: isize,
    /// Number of offsets, at least 1.
    pub count: usize,
}

impl Window {
    /// The offsets for which some pixel of the tile has its neighbour inside the image, row by row in blocks of at most
    /// `group`: the same order for every pixel of every tile.
    pub fn blocks(self, tile: Tile, group: usize) -> impl Iterator<Item = Block> {
        let reach = self.reach as isize;
        let (width, height) = (self.width as isize, self.height as isize);
        let (x, y, rows) = (tile.x as isize, tile.y as isize, tile.height as isize);
        let last = (x + tile.width as isize - 1, y + rows - 1);
        let (left, right) = ((-reach).max(-last.0), reach.min(width - 1 - x));
        let (top, bottom) = ((-reach).max(-last.1), reach.min(height - 1 - y));
        (top..=bottom).flat_map(move |dy| {
            let rows = (-dy - y).max(0) as usize..(height - dy - y).min(rows) as usize;
            (left..=right).step_by(group).map(move |dx| {
                let count = ((right - dx + 1) as usize).min(group);
                Block { rows: rows.clone(), dy, dx, count }
            })
        })
    }
}
