//! The inner loops, generic over the instruction set: what one block of horizontal offsets adds to the sums of a tile.
//!
//! First the vertical part of the patch distances ([`distances`]), then the horizontal part, weights and sums ([`weigh`]).
//! Every function is inlined whole into that of its instruction set; there are no calls inside.

mod distances;
mod tile;
mod weigh;

pub(super) use tile::{GuidePair, JOINT, Offsets, SEPARATE, SINGLE, TileView};

use self::distances::{CubeDistance, GuideDistance};
use self::weigh::accumulate;
use crate::engine::{Columns, Kernel, PatchDistance, Simd, Weighted};

/// Vertical patch sums of one block: of squares, or of cubes over several frames.
pub(super) struct PatchColumns<'t, 'a> {
    pub tile: &'t mut TileView<'a>,
    pub offsets: &'t Offsets,
    /// Frames that are compared; none for patches of the target alone.
    pub pairs: &'t [GuidePair],
}

impl Kernel for PatchColumns<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, s: S) {
        match self.tile.layout.patch {
            0 => self.radius::<S, 0>(s),
            1 => self.radius::<S, 1>(s),
            2 => self.radius::<S, 2>(s),
            _ => self.radius::<S, 3>(s),
        }
    }
}

impl PatchColumns<'_, '_> {
    #[inline(always)]
    fn radius<S: Simd, const PATCH: usize>(self, s: S) {
        let Some(guide) = self.tile.guide else { return };
        let plane = self.tile.layout.guide.plane;
        if self.pairs.is_empty() {
            self.sum::<S, PATCH>(s, &GuideDistance { guide, plane });
        } else {
            let pairs = self.pairs;
            self.sum::<S, PATCH>(s, &CubeDistance { guide, plane, pairs });
        }
    }

    #[inline(always)]
    fn sum<S: Simd, const PATCH: usize>(self, s: S, distance: &impl PatchDistance<S>) {
        let Self { tile, offsets: Offsets { block, .. }, .. } = self;
        let (guide, sums) = (tile.layout.guide, tile.layout.columns);
        let walk = Columns { guide, sums, radii: 0, width: tile.width };
        walk.sum::<S, PATCH, PATCH>(s, (distance, &Weighted(tile.taps)), tile.columns, block, block.count);
    }
}

/// Weights and sums of one block, whose vertical patch sums are there.
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
        match (self.tile.guide.is_some(), self.tile.layout.patch) {
            (false, _) => self.ruled::<S, 0, false>(s),
            (true, 0) => self.ruled::<S, 0, true>(s),
            (true, 1) => self.ruled::<S, 1, true>(s),
            (true, 2) => self.ruled::<S, 2, true>(s),
            (true, _) => self.ruled::<S, 3, true>(s),
        }
    }
}

impl Step<'_, '_> {
    #[inline(always)]
    fn ruled<S: Simd, const PATCH: usize, const GUIDED: bool>(self, s: S) {
        match self.rule {
            JOINT => accumulate::<S, PATCH, JOINT, GUIDED>(s, self.tile, self.offsets),
            SEPARATE => accumulate::<S, PATCH, SEPARATE, GUIDED>(s, self.tile, self.offsets),
            _ => accumulate::<S, PATCH, SINGLE, GUIDED>(s, self.tile, self.offsets),
        }
    }
}
