//! Working copies of a tile and what lies around it. They make borders vanish: what is outside the image is mirrored or
//! marked while copying.

use super::{Grid, Tile, mirror};

/// Copies for one tile of an image of `width` × `height` pixels. What they write to starts with the plane in question.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Copies {
    pub width: usize,
    pub height: usize,
    pub tile: Tile,
}

impl Copies {
    /// The part of a plane that a grid shows, mirrored at the border of the image, times `factor`.
    pub fn mirrored(&self, grid: &Grid, from: &[f32], to: &mut [f32], factor: f32) {
        let (width, height) = (self.width, self.height);
        let start = self.tile.x as isize - grid.left as isize;
        let inside = start >= 0 && start as usize + grid.columns <= width;
        for j in 0..grid.rows {
            let row = &mut to[j * grid.pitch..][..grid.columns];
            let y = mirror(self.tile.y as isize + j as isize - grid.above as isize, height);
            let from = &from[y * width..][..width];
            if inside {
                for (value, from) in row.iter_mut().zip(&from[start as usize..]) {
                    *value = from * factor;
                }
            } else {
                for (i, value) in row.iter_mut().enumerate() {
                    *value = from[mirror(start + i as isize, width)] * factor;
                }
            }
        }
    }

    /// The part of a plane that a grid shows, `outside` beyond the image.
    pub fn marked(&self, grid: &Grid, from: &[f32], to: &mut [f32], outside: f32) {
        for j in 0..grid.rows {
            let row = &mut to[j * grid.pitch..][..grid.columns];
            let y = (self.tile.y + j).checked_sub(grid.above).filter(|&y| y < self.height);
            let Some(y) = y else {
                row.fill(outside);
                continue;
            };
            let from = &from[y * self.width..][..self.width];
            let columns = self.inside(grid);
            row[..columns.start].fill(outside);
            let first = self.tile.x.saturating_sub(grid.left);
            row[columns.clone()].copy_from_slice(&from[first..][..columns.len()]);
            row[columns.end..].fill(outside);
        }
    }

    /// 0 in columns inside the image, `outside` beyond them, in every row.
    pub fn mark_columns(&self, grid: &Grid, to: &mut [f32], outside: f32) {
        let columns = self.inside(grid);
        for j in 0..grid.rows {
            let row = &mut to[j * grid.pitch..][..grid.columns];
            row.fill(outside);
            row[columns.clone()].fill(0.0);
        }
    }

    /// The tile's own pixels of a plane, each through `map`.
    pub fn own(&self, grid: &Grid, from: &[f32], to: &mut [f32], map: impl Fn(f32) -> f32) {
        for j in 0..self.tile.height {
            let first = (self.tile.y + j) * self.width + self.tile.x;
            let row = &mut to[j * grid.pitch..][..self.tile.width];
            for (value, &from) in row.iter_mut().zip(&from[first..]) {
                *value = map(from);
            }
        }
    }

    /// Columns of a grid that lie inside the image.
    fn inside(&self, grid: &Grid) -> std::ops::Range<usize> {
        let first = self.tile.x.saturating_sub(grid.left);
        let skip = grid.left.saturating_sub(self.tile.x);
        let count = (self.width - first).min(grid.columns - skip);
        skip..skip + count
    }
}
