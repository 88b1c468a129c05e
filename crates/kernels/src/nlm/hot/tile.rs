//! What the inner loops see of a tile.

use crate::engine::{Block, MAX_LANES, Plane};
use crate::nlm::layout::{KINDS, Layout, MAX_BLOCK};
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

impl TileView<'_> {
    /// Place of offset (0, 0) in the frame to filter among the block's, or [`usize::MAX`].
    #[inline(always)]
    pub(super) fn center(&self, block: &Block) -> usize {
        if self.same_frame && block.dy == 0 && (0..block.count as isize).contains(&-block.dx) {
            -block.dx as usize
        } else {
            usize::MAX
        }
    }

    /// Whether some of `group` offsets is so small that p is a tap of its neighbour's patch, and that counts.
    #[inline(always)]
    pub(super) fn near(&self, block: &Block, group: usize) -> bool {
        let patch = self.layout.patches.first().map_or(-1, |&f| f as isize);
        let last = block.dx + group as isize - 1;
        let counts = self.constants.derivative && !self.constants.joint && self.same_frame;
        counts && block.dy.abs() <= patch && block.dx <= patch && last >= -patch
    }
}

/// Vectors that the steps for one vector of pixels hand on, one for each offset of a block: exponents for both τ, then
/// what moving each guide channel at p changes through p's own patch, then through q's. In memory and not in variables,
/// because the compiler copies such large variables at every branch.
pub(in crate::nlm) const LOCAL: usize = (KINDS + 3 + 3) * MAX_BLOCK * MAX_LANES;
pub(super) const OWN: usize = KINDS;
pub(super) const EXCHANGED: usize = KINDS + 3;

/// Index of a vector of [`LOCAL`].
#[inline(always)]
pub(super) fn local(kind: usize, offset: usize) -> usize {
    (kind * MAX_BLOCK + offset) * MAX_LANES
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

/// Places of one vector of pixels in the planes, and of the block in the window.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// See [`TileView::center`].
    pub center: usize,
    /// See [`TileView::near`].
    pub near: bool,
    /// In pixel and accumulator planes.
    pub pixel: usize,
    /// Of the first neighbour, in area planes.
    pub area: usize,
    /// In guide planes.
    pub here: usize,
    /// Of the first neighbour, in guide planes.
    pub there: usize,
    /// Of the patch around the pixel, in column planes: its leftmost tap for the largest radius.
    pub columns: usize,
}
