//! The inner loops, generic over the instruction set: what one block of horizontal offsets adds to the sums of a tile.
//!
//! First the vertical part of the patch distances ([`distances`]), then for each vector of pixels the feature distances
//! ([`limits`]), what moving the pixel changes ([`derivative`]), weights and sums ([`weigh`]). Every function is inlined whole
//! into that of its instruction set; there are no calls inside.

#![expect(clippy::needless_range_loop, reason = "fixed counts, unrolled; iterators may end up as calls")]

mod derivative;
mod distances;
mod limits;
mod tile;
mod weigh;

pub(super) use limits::PENALTY;
pub(super) use tile::{Constants, HotPass, LOCAL, TileView};

use self::distances::ColourDistance;
use self::tile::{Group, NO_PATCH, Place};
use crate::engine::{Block, Columns, Equal, Kernel, Simd};
use crate::nlm::layout::Layout;

/// Everything for one block of offsets.
pub(super) struct Step<'t, 'a> {
    pub tile: &'t mut TileView<'a>,
    pub block: &'t Block,
    /// Offsets whose values are loaded together: 3, 6 or 7. Those after the block's have weight 0.
    pub group: usize,
}

impl Kernel for Step<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, s: S) {
        let Self { tile, block, group } = self;
        match *tile.layout.patches.as_slice() {
            [] => {}
            [0] => columns::<S, 0, 0>(s, tile, block),
            [1] => columns::<S, 1, 1>(s, tile, block),
            [2] => columns::<S, 2, 2>(s, tile, block),
            [3] => columns::<S, 3, 3>(s, tile, block),
            // No other pair: see `fits`.
            _ => columns::<S, 3, 1>(s, tile, block),
        }
        match group {
            3 => accumulate::<S, 3>(s, tile, block),
            6 => accumulate::<S, 6>(s, tile, block),
            _ => accumulate::<S, 7>(s, tile, block),
        }
    }
}

/// Vertical patch sums of all offsets of the block.
#[inline(always)]
fn columns<S: Simd, const BIG: usize, const SMALL: usize>(s: S, tile: &mut TileView<'_>, block: &Block) {
    let (guide, sums) = (tile.layout.guide, tile.layout.columns);
    let walk = Columns { guide, sums, radii: tile.layout.block * sums.plane, width: tile.width };
    let distance = ColourDistance {
        here: tile.here,
        there: tile.there,
        channels: tile.layout.channels,
        plane: guide.plane,
        constants: tile.constants,
    };
    walk.sum::<S, BIG, SMALL>(s, (&distance, &Equal), tile.columns, block, block.count);
}

/// Adds the block's offsets to the running sums of every pixel of the tile, vector by vector: what one reads of all planes
/// stays in the first cache while the block's groups of `G` offsets pass over it.
#[inline(always)]
fn accumulate<S: Simd, const G: usize>(s: S, tile: &mut TileView<'_>, block: &Block) {
    let Layout { area, guide, pixel, sums, columns, .. } = *tile.layout;
    for y in block.rows.clone() {
        let mut x = 0;
        while x < tile.width {
            let mut first = 0;
            while first < block.count {
                let group = Group::new(tile, block, first, G);
                let shift = |pitch: usize| group.dy * pitch as isize + group.dx;
                let here = guide.origin() + y * guide.pitch + x;
                let place = Place {
                    pixel: y * pixel.pitch + x,
                    sums: y * sums.pitch + x,
                    area: (area.origin() + y * area.pitch + x).wrapping_add_signed(shift(area.pitch)),
                    here,
                    there: here.wrapping_add_signed(shift(guide.pitch)),
                    columns: first * columns.plane + y * columns.pitch + x,
                };
                vector::<S, G>(s, tile, &group, place);
                first += G;
            }
            x += S::LANES;
        }
    }
}

/// [`accumulate`] for one vector of pixels.
#[inline(always)]
fn vector<S: Simd, const G: usize>(s: S, tile: &mut TileView<'_>, group: &Group, place: Place) {
    limits::limits::<S, G>(s, tile, group, place);
    if tile.constants.derivative {
        derivative::own_patch::<S, G>(s, tile, group, place);
        if group.near {
            derivative::other_patch::<S, G>(s, tile, group, place);
        }
    }
    for k in 0..tile.passes.len() {
        let pass = tile.passes[k];
        match pass.patch {
            0 => weigh::weigh::<S, G, 0>(s, tile, group, place, k, pass),
            1 => weigh::weigh::<S, G, 1>(s, tile, group, place, k, pass),
            2 => weigh::weigh::<S, G, 2>(s, tile, group, place, k, pass),
            3 => weigh::weigh::<S, G, 3>(s, tile, group, place, k, pass),
            _ => weigh::weigh::<S, G, NO_PATCH>(s, tile, group, place, k, pass),
        }
    }
}
