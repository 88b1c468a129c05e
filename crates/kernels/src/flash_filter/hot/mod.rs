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

/// Everything for one block of offsets.
pub(super) struct Step<'t, 'a> {
    pub tile: &'t mut TileView<'a>,
    pub offsets: &'t Offsets,
    /// One of [`JOINT`], [`SEPARATE`], [`SINGLE`].
    pub rule: usize,
    /// Whether the vertical patch sums are there already, see [`CubeColumns`].
    pub summed: bool,
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

/// Vertical patch sums of one block where patches are cubes. Apart from [`Step`], whose code for squares stays as it is.
pub(super) struct CubeColumns<'t, 'a> {
    pub tile: &'t mut TileView<'a>,
    pub offsets: &'t Offsets,
    pub pairs: &'t [GuidePair],
}

impl Kernel for CubeColumns<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, s: S) {
        let Some(guide) = self.tile.guide else { return };
        let distance = CubeDistance { guide, plane: self.tile.layout.guide.plane, pairs: self.pairs };
        match self.tile.layout.patch {
            0 => columns::<S, 0>(s, self.tile, self.offsets, &distance),
            1 => columns::<S, 1>(s, self.tile, self.offsets, &distance),
            2 => columns::<S, 2>(s, self.tile, self.offsets, &distance),
            _ => columns::<S, 3>(s, self.tile, self.offsets, &distance),
        }
    }
}

#[inline(always)]
fn columns<S: Simd, const PATCH: usize>(
    s: S,
    tile: &mut TileView<'_>,
    offsets: &Offsets,
    distance: &impl PatchDistance<S>,
) {
    let walk = Columns { guide: tile.layout.guide, sums: tile.layout.columns, radii: 0, width: tile.width };
    let (taps, block) = (Weighted(tile.taps), &offsets.block);
    walk.sum::<S, PATCH, PATCH>(s, (distance, &taps), tile.columns, block, block.count);
}

impl Step<'_, '_> {
    #[inline(always)]
    fn guided<S: Simd, const PATCH: usize>(self, s: S, distance: GuideDistance<'_>) {
        if !self.summed {
            columns::<S, PATCH>(s, self.tile, self.offsets, &distance);
        }
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
