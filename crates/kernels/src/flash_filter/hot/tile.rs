//! What the inner loops see of a tile.

use crate::engine::{Block, Plane};
use crate::flash_filter::layout::{BLOCK, Layout};
use crate::flash_filter::params::MAX_PATCH_RADIUS;

/// All channels share one set; each channel has a test.
pub(in crate::flash_filter) const JOINT: usize = 0;
/// Each channel has a set and a weight sum of its own.
pub(in crate::flash_filter) const SEPARATE: usize = 1;
/// All channels share one set with a single test, on a value plane of its own.
pub(in crate::flash_filter) const SINGLE: usize = 2;

/// Views of one tile's working copies, see [`Layout`].
pub(in crate::flash_filter) struct TileView<'a> {
    pub layout: &'a Layout,
    /// Valid pixels of the tile, from its first.
    pub width: usize,
    /// Three planes of source values, and for [`SINGLE`] a fourth with the tested values. The target's; those of other frames
    /// follow at multiples of [`Layout::frame`], here as in `factor` and `carried`.
    pub source: &'a Plane,
    /// Three guide planes for each frame.
    pub guide: Option<&'a Plane>,
    /// Half-widths of the tests: one plane for [`SINGLE`], else three.
    pub half_width: &'a Plane,
    /// Each pixel's factor from patch sums to an exponent of 2, on the source's grid, finite and at most 0; the lower
    /// of a pair's two counts. Read with a guide only.
    pub factor: &'a Plane,
    /// Three planes that are summed along, on the source's grid.
    pub carried: Option<&'a Plane>,
    /// Whether carried planes are summed with squared weights.
    pub squared: bool,
    /// Accumulators: three sums of weighted differences, then three weight sums for [`SEPARATE`], else one, and from
    /// the seventh on three sums of carried planes.
    pub sums: &'a mut Plane,
    /// Vertical patch sums.
    pub columns: &'a mut Plane,
    /// Patch weights relative to the middle one: g(i)/g(0).
    pub taps: [f32; MAX_PATCH_RADIUS + 1],
}

/// Two guides that are compared: one frame of a pixel's patch and one of its neighbour's.
#[derive(Clone, Copy, Debug)]
pub(in crate::flash_filter) struct GuidePair {
    /// Where the guide planes of the pixel's frame start, in values.
    pub here: usize,
    /// The same of the neighbour's frame.
    pub there: usize,
    /// Share in the distance.
    pub weight: f32,
}

/// A block of at most [`BLOCK`] offsets to one frame, with their spatial weights.
pub(in crate::flash_filter) struct Offsets {
    pub block: Block,
    /// Values from the target's copies to those of the neighbours' frame.
    pub frame: usize,
    /// For each offset, with a guide: the spatial weight's exponent of 2. Without: the weight itself.
    pub spatial: [f32; BLOCK],
}
