//! Where a tile's working copies lie in a worker's scratch memory.
//!
//! The copies make borders vanish: guides are mirrored, neighbours outside the image carry a penalty that makes their
//! weight zero, and rows start where the caches like them.

use super::params::NlmInputs;
use crate::engine::{Grid, LINE, MAX_LANES};

/// Most horizontal offsets whose values are loaded together.
pub(super) const MAX_GROUP: usize = 7;

/// Groups of offsets in a block: what one step over a tile does before it moves on.
const GROUPS: usize = 3;

/// Most different patch radii, and most different τ, that one sweep serves.
pub(super) const KINDS: usize = 2;

/// Sizes and distances, in values.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// Window radius r.
    pub reach: usize,
    /// Horizontal offsets whose values are loaded together.
    pub group: usize,
    /// Horizontal offsets of a block.
    pub block: usize,
    /// Patch radii in use, the largest first.
    pub patches: Vec<usize>,
    /// Guide channels.
    pub channels: usize,
    /// Channels of each feature.
    pub features: Vec<usize>,
    /// Channels of all features.
    pub feature_channels: usize,
    /// Planes to filter.
    pub targets: usize,
    /// Guide copies: the tile and r + f pixels around it. Values, then variances.
    pub guide: Grid,
    /// What is read at neighbours: the tile and r pixels around it. See the methods for the order.
    pub area: Grid,
    /// What belongs to the tile's own pixels.
    pub pixel: Grid,
    /// Accumulators of the tile's own pixels.
    pub sums: Grid,
    /// Vertical patch sums: the tile and f columns on both sides; for each radius one plane per offset of a block.
    pub columns: Grid,
}

impl Layout {
    /// `patches` are the radii in use, the largest first, at most [`KINDS`].
    pub fn new(
        (tile_width, tile_height): (usize, usize),
        reach: usize,
        patches: Vec<usize>,
        passes: usize,
        inputs: &NlmInputs<'_>,
    ) -> Self {
        let group = group(2 * reach + 1);
        debug_assert!(tile_width.is_multiple_of(MAX_LANES) && tile_width > 0 && tile_height > 0);
        let patch = patches.first().copied().unwrap_or(0);
        // A whole number of lines on the left, so that the loads of the tile's own pixels are aligned.
        let left = reach.next_multiple_of(LINE);
        let with_patch = (tile_width + 2 * patch).next_multiple_of(MAX_LANES);
        // The last block of a row may look at offsets beyond the window; their weights are zero.
        let right = reach + MAX_GROUP;
        let block = (GROUPS * group).min((2 * reach + 1).next_multiple_of(group));
        let channels = if patches.is_empty() { 0 } else { inputs.frame.guide.len() };
        let targets = inputs.frame.targets.len();
        let features: Vec<usize> = inputs.frame.features.iter().map(Vec::len).collect();
        let feature_channels = features.iter().sum::<usize>();
        Self {
            reach,
            group,
            block,
            channels,
            feature_channels,
            features,
            targets,
            guide: Grid::interleaved(
                2 * channels,
                (left + patch, reach + patch),
                (left + with_patch + right, tile_height + 2 * (reach + patch)),
            ),
            area: Grid::interleaved(
                3 * feature_channels + targets + 1,
                (left, reach),
                (left + tile_width + right, tile_height + 2 * reach),
            ),
            pixel: Grid::interleaved(4 * feature_channels + 3, (0, 0), (tile_width, tile_height)),
            sums: Grid::interleaved(passes * (targets + SUMS), (0, 0), (tile_width, tile_height)),
            columns: Grid::interleaved(patches.len() * block, (patch, 0), (with_patch, tile_height)),
            patches,
        }
    }

    /// Area plane of a feature channel's values; variances and spreads follow after one and two times all channels.
    pub fn area_feature(&self, kind: usize, channel: usize) -> usize {
        (kind * self.feature_channels + channel) * self.area.plane
    }

    /// Area plane of a target.
    pub fn area_target(&self, target: usize) -> usize {
        (3 * self.feature_channels + target) * self.area.plane
    }

    /// Area plane that holds 0 inside the image and a penalty outside.
    pub fn area_penalty(&self) -> usize {
        self.area_target(self.targets)
    }

    /// Pixel plane of a feature channel: 0 its values, 1 their negative variances, 2 and 3 what differences are scaled
    /// by for each τ.
    pub fn pixel_feature(&self, kind: usize, channel: usize) -> usize {
        (kind * self.feature_channels + channel) * self.pixel.plane
    }

    /// Pixel plane of a perturbation step.
    pub fn pixel_step(&self, channel: usize) -> usize {
        (4 * self.feature_channels + channel) * self.pixel.plane
    }

    /// Accumulator planes of pass `pass`: the targets' weighted sums first.
    pub fn sums(&self, pass: usize) -> usize {
        pass * (self.targets + SUMS) * self.sums.plane
    }
}

/// Horizontal offsets per group for a window of `side` columns: the number that wastes the least.
fn group(side: usize) -> usize {
    let waste = |g: usize| side.div_ceil(g) * g - side;
    // Wider groups first: they load each pixel's own values less often.
    [7, 6, 3].into_iter().min_by_key(|&g| waste(g)).unwrap_or(7)
}

/// Accumulators of a pass after those of its targets.
pub(super) const SUMS: usize = 14;
/// Sum of weights.
pub(super) const WEIGHT: usize = 0;
/// Largest weight of a neighbour.
pub(super) const LARGEST: usize = 1;
/// Sums of w·(g(q) − g(p)), three channels.
pub(super) const STEP: usize = 2;
/// The same with the weights after moving g(p), three channels.
pub(super) const MOVED_STEP: usize = 5;
/// Sums of the moved weights, three channels.
pub(super) const MOVED_WEIGHT: usize = 8;
/// Largest moved weights, three channels.
pub(super) const MOVED_LARGEST: usize = 11;
