//! What the inner loops see of a tile.

use crate::engine::{Block, MAX_LANES, Plane};
use crate::nlm::layout::{KINDS, Layout, MAX_GROUP};
use crate::nlm::params::MAX_PATCH_RADIUS;

/// `PATCH` of a pass without a patch.
pub(super) const NO_PATCH: usize = MAX_PATCH_RADIUS + 1;

/// One pass as the inner loops see it.
#[derive(Clone, Copy, Debug)]
pub(in crate::nlm) struct HotPass {
    /// Patch radius, or [`NO_PATCH`].
    pub(super) patch: usize,
    /// Which of the layout's patch radii.
    pub(super) columns: usize,
    /// Which of the two τ.
    pub(super) floor: usize,
    /// Factor from patch sums to an exponent of 2.
    pub(super) scale: f32,
    /// Whether the derivative is wanted.
    pub(super) derivative: bool,
}

impl HotPass {
    pub fn new(patch: Option<usize>, columns: usize, floor: usize, scale: f32, derivative: bool) -> Self {
        Self { patch: patch.unwrap_or(NO_PATCH), columns, floor, scale, derivative }
    }

    /// Whether the pass gives a derivative.
    pub fn gives_derivative(&self) -> bool {
        self.derivative
    }

    /// Whether that is a finite difference: without a patch the weights do not depend on the guide.
    pub fn finite_difference(&self) -> bool {
        self.derivative && self.patch != NO_PATCH
    }
}

/// Views of one tile's working copies, see [`Layout`].
pub(in crate::nlm) struct TileView<'a> {
    pub layout: &'a Layout,
    pub passes: &'a [HotPass],
    /// Valid pixels of the tile, from its first.
    pub width: usize,
    /// Whether the frame that is searched is the one to filter.
    pub same_frame: bool,
    /// Guide of the frame to filter, and its variances scaled by k².
    pub here: &'a Plane,
    /// Guide of the frame that is searched.
    pub there: &'a Plane,
    /// Features, targets and penalty of the frame that is searched.
    pub area: &'a Plane,
    /// Features of the tile's own pixels, and perturbation steps.
    pub pixel: &'a Plane,
    pub sums: &'a mut Plane,
    pub columns: &'a mut Plane,
    /// What the steps for one vector of pixels hand on, see [`LOCAL`].
    pub local: &'a mut Plane,
    pub constants: Constants,
}

/// A few offsets of a block whose values are loaded together: dx, dx + 1, … at dy.
#[derive(Clone, Copy)]
pub(super) struct Group {
    pub dy: isize,
    pub dx: isize,
    /// How many of them count; those after have weight 0.
    pub count: usize,
    /// Place of offset (0, 0) in the frame to filter among them, or [`usize::MAX`].
    pub center: usize,
    /// Whether one of them is so small that p is a tap of its neighbour's patch, and that counts.
    pub near: bool,
}

impl Group {
    /// `size` offsets from the block's `first` on.
    #[inline(always)]
    pub fn new(tile: &TileView<'_>, block: &Block, first: usize, size: usize) -> Self {
        let (dy, dx) = (block.dy, block.dx + first as isize);
        let count = (block.count - first).min(size);
        let own = tile.same_frame && dy == 0 && (0..count as isize).contains(&-dx);
        let patch = tile.layout.patches.first().map_or(-1, |&f| f as isize);
        let counts = tile.constants.derivative && !tile.constants.joint && tile.same_frame;
        let last = dx + size as isize - 1;
        Self {
            dy,
            dx,
            count,
            center: if own { -dx as usize } else { usize::MAX },
            near: counts && dy.abs() <= patch && dx <= patch && last >= -patch,
        }
    }
}

/// Vectors that the steps for one vector of pixels hand on, one for each offset of a group: exponents for both τ, then
/// what moving each guide channel at p changes through p's own patch, then through q's. In memory and not in variables,
/// because the compiler copies such large variables at every branch.
pub(in crate::nlm) const LOCAL: usize = (KINDS + 3 + 3) * MAX_GROUP * MAX_LANES;
pub(super) const OWN: usize = KINDS;
pub(super) const EXCHANGED: usize = KINDS + 3;

/// Index of a vector of [`LOCAL`].
#[inline(always)]
pub(super) fn local(kind: usize, offset: usize) -> usize {
    (kind * MAX_GROUP + offset) * MAX_LANES
}

/// Numbers that are the same for all tiles.
#[derive(Clone, Copy, Debug)]
pub(in crate::nlm) struct Constants {
    /// −κ/k².
    pub cancellation: f32,
    /// ε.
    pub epsilon: f32,
    /// How often the variance of the pair's first pixel and that of its second stand in the denominator of Δ², beside
    /// once that of the first: (0, 1), or (1, 0) for twice the first. Numbers, not a choice: a branch here would stand
    /// in the innermost loop.
    pub first_again: f32,
    /// See `first_again`.
    pub second: f32,
    /// Largest Δ².
    pub largest: f32,
    /// Whether Φ² is divided by the sum of both pixels' D.
    pub pair: bool,
    /// The two τ.
    pub floors: [f32; KINDS],
    /// Number of different τ.
    pub floor_count: usize,
    /// Whether the pixel itself gets the largest of its neighbours' weights.
    pub largest_center: bool,
    /// Whether any pass wants the derivative.
    pub derivative: bool,
    /// Whether it moves all channels at once, and p only as the centre of its own patch.
    pub joint: bool,
    /// Factor of Φ²·D·channels to an exponent of 2, for pairs, one per feature: −log₂e/(k_f²·channels) is folded into
    /// the pixel planes otherwise.
    pub pair_scale: f32,
}

/// Places of one vector of pixels in the planes.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// In pixel planes.
    pub pixel: usize,
    /// In accumulator planes.
    pub sums: usize,
    /// Of the first neighbour, in area planes.
    pub area: usize,
    /// In guide planes.
    pub here: usize,
    /// Of the first neighbour, in guide planes.
    pub there: usize,
    /// Of the patch around the pixel, in column planes, for the first neighbour: its leftmost tap for the largest radius.
    pub columns: usize,
}
