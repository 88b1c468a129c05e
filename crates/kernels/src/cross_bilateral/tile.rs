//! The bank in one tile, row by row.
//!
//! For a row of pixels and each row of neighbours: e^−D at all horizontal offsets, which stays in a near cache, then for each filter
//! whose window has that row the sums over its own offsets. What a row of pixels has summed up stays in a near cache too.

use super::distances::{scale, share};
use super::layout::{LANES, Layout, TILE, Work};
use super::params::{BilateralGuide, BilateralParams};
use super::rows::{Columns, Rows};
use super::sums::add;
use crate::engine::{Copies, Grid, Tile, TileRows, Vectorised};

/// D beyond the image.
const OUTSIDE: f32 = 1e9;

pub(super) struct Filter<'a, 'b> {
    pub params: &'a BilateralParams,
    pub guides: &'a [BilateralGuide<'a>],
    pub planes: &'a [&'a [f32]],
    pub layout: &'a Layout,
    pub work: &'a mut Work,
    pub tile: Tile,
    pub out: Vec<TileRows<'b>>,
}

impl Vectorised for Filter<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        let Self { params, guides, planes, layout, work, tile, mut out } = self;
        let [area, beyond, shared, sums, factors] = work.parts(layout);
        let copies = Copies { width: params.width, height: params.height, tile };
        copy(&copies, guides, planes, layout, area);
        // Rows of neighbours lie in the image, columns may not.
        copies.mark_columns(&Grid { rows: 1, ..layout.area }, beyond, OUTSIDE);
        let (x, y, reach) = (tile.x as isize, tile.y as isize, layout.reach as isize);
        let columns = Columns {
            first: (-reach).max(1 - x - tile.width as isize),
            last: reach.min(params.width as isize - 1 - x),
            // Tiles are whole lanes wide; what lies beyond the image is not read.
            width: tile.width.next_multiple_of(LANES),
        };
        for row in 0..tile.height {
            sums.fill(0.0);
            let above = y + row as isize;
            let below = params.height as isize - 1 - above;
            for dy in (-reach).max(-above)..=reach.min(below) {
                let pair = Rows { layout, area, columns: &columns, row, dy };
                share(&pair, guides, params.floor, beyond, shared);
                for (filter, sums) in layout.filters.iter().zip(sums.chunks_exact_mut(layout.sums)) {
                    if dy.unsigned_abs() <= filter.reach {
                        add(&pair, filter, shared, factors, sums);
                    }
                }
            }
            finish(layout, sums, &mut out, row);
        }
    }
}

/// Copies what the tile's windows see.
#[inline(always)]
fn copy(
    copies: &Copies,
    guides: &[BilateralGuide<'_>],
    planes: &[&[f32]],
    layout: &Layout,
    area: &mut [f32],
) {
    let grid = &layout.area;
    for (k, guide) in guides.iter().enumerate() {
        copies.marked(grid, guide.value, &mut area[k * grid.plane..], 0.0);
        let to = &mut area[(layout.guides + k) * grid.plane..];
        copies.marked(grid, guide.variance, to, 0.0);
        let scale = scale(guide);
        for row in 0..grid.rows {
            for variance in &mut to[row * grid.pitch..][..grid.columns] {
                *variance *= scale;
            }
        }
    }
    for (k, plane) in planes.iter().enumerate() {
        copies.marked(grid, plane, &mut area[(2 * layout.guides + k) * grid.plane..], 0.0);
    }
}

/// Divides the sums of a row and writes them.
#[inline(always)]
fn finish(layout: &Layout, sums: &[f32], out: &mut [TileRows<'_>], row: usize) {
    let filters = out.chunks_exact_mut(layout.averaged + 1).zip(sums.chunks_exact(layout.sums));
    for (out, sums) in filters {
        let (planes, weights) = sums.split_at(layout.averaged * TILE.0);
        for (k, out) in out.iter_mut().enumerate() {
            let to = &mut *out[row];
            if k == layout.averaged {
                to.copy_from_slice(&weights[..to.len()]);
                continue;
            }
            for ((to, sum), weight) in to.iter_mut().zip(&planes[k * TILE.0..]).zip(weights) {
                // The pixel's own weight is 1.
                *to = sum / weight;
            }
        }
    }
}
