//! The inner loops, generic over the instruction set: what one block of horizontal offsets adds to the sums of a tile.
//!
//! First the vertical part of the patch distances ([`distances`]), then the horizontal part, weights and sums ([`weigh`]).
//! Every function is inlined whole into that of its instruction set; there are no calls inside.

mod distances;
mod tile;
mod weigh;

pub(super) use tile::{JOINT, Offsets, SEPARATE, SINGLE, TileView};

use self::distances::GuideDistance;
use self::weigh::accumulate;
use crate::engine::{Columns, Kernel, Simd, Weighted};

/// Everything for one block of offsets.
pub(super) struct Step<'t, 'a> {
    pub tile: &'t mut TileView<'a>,
    pub offsets: &'t Offsets,
    /// One of [`JOINT`], [`SEPARATE`], [`SINGLE`].
    pub rule: usize,
}

impl Kernel for Step<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, s: S) {
        let Some(guide) = self.tile.guide else { return self.ruled::<S, 0, false>(s) };
        let distance = GuideDistance { guide, plane: self.tile.layout.guide.plane };
        match self.tile.layout.patch {
            0 => self.guided::<S, 0>(s, distance),
            1 => self.guided::<S, 1>(s, distance),
            2 => self.guided::<S, 2>(s, distance),
            _ => self.guided::<S, 3>(s, distance),
        }
    }
}

impl Step<'_, '_> {
    #[inline(always)]
    fn guided<S: Simd, const PATCH: usize>(self, s: S, distance: GuideDistance<'_>) {
        let (tile, block) = (&mut *self.tile, &self.offsets.block);
        let (guide, sums) = (tile.layout.guide, tile.layout.columns);
        let walk = Columns { guide, sums, radii: 0, width: tile.width };
        let taps = Weighted(tile.taps);
        walk.sum::<S, PATCH, PATCH>(s, (&distance, &taps), tile.columns, block, block.count);
        self.ruled::<S, PATCH, true>(s);
    }

    #[inline(always)]
    fn ruled<S: Simd, const PATCH: usize, const GUIDED: bool>(self, s: S) {
        match self.rule {
            JOINT => accumulate::<S, PATCH, JOINT, GUIDED>(s, self.tile, self.offsets),
            SEPARATE => accumulate::<S, PATCH, SEPARATE, GUIDED>(s, self.tile, self.offsets),
            _ => accumulate::<S, PATCH, SINGLE, GUIDED>(s, self.tile, self.offsets),
        }
    }
}
