//! What a tile's models say of the tile and what lies around it.

use crate::engine::Tile;

/// Sums of the predictions of one tile's models: three colours, then Σ w, for the tile and the window around it.
pub(super) struct Prediction {
    pub tile: Tile,
    pub reach: usize,
    pub sums: Vec<f32>,
}

impl Prediction {
    /// Adds what they say of row `j` of a tile to four rows of sums of `wide` values.
    pub fn add(&self, to: Tile, j: usize, sums: &mut [f64], wide: usize) {
        let (columns, rows) = (self.tile.width + 2 * self.reach, self.tile.height + 2 * self.reach);
        let Some(row) = (to.y + j + self.reach).checked_sub(self.tile.y).filter(|row| *row < rows) else {
            return;
        };
        // Column `i` of the tile is column `i + shift` here.
        let shift = (to.x + self.reach) as isize - self.tile.x as isize;
        let first = (-shift).max(0) as usize;
        let end = (columns as isize - shift).clamp(0, to.width as isize) as usize;
        if first >= end {
            return;
        }
        for c in 0..4 {
            let start = ((c * rows + row) * columns).wrapping_add_signed(shift);
            let from = &self.sums[start.wrapping_add(first)..];
            for (sum, value) in sums[c * wide + first..c * wide + end].iter_mut().zip(from) {
                *sum += f64::from(*value);
            }
        }
    }
}
