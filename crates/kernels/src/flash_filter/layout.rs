//! Where a tile's working copies lie in a worker's scratch memory.
//!
//! A worker copies what one tile needs into planes of its own: the copy is small beside the arithmetic (4 % of the
//! time for the small window, less for the large), it makes borders vanish (the guide is mirrored and the source
//! marked as outside while copying), keeps memory use independent of the image, and lets rows start where the
//! caches like them: aligned, at a distance of an odd number of cache lines, planes staggered.

use crate::engine::{Grid, LINE, MAX_LANES};

/// Most horizontal offsets that one pass over a tile handles together.
pub(super) const BLOCK: usize = 16;

/// Planes of one frame on the source's grid: three of values, the tested one, ...
pub(super) const TESTED: usize = 3;
/// ... the range factor, ...
pub(super) const FACTOR: usize = 4;
/// ... and three that are carried along.
pub(super) const CARRIED: usize = 5;
/// All of them.
pub(super) const FRAME_PLANES: usize = 8;

/// Sizes and distances, in values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// Window radius r.
    pub reach: usize,
    /// Patch radius f.
    pub patch: usize,
    /// Frames, the target first.
    pub frames: usize,
    /// Copies of the source, of range factors and of carried planes: the tile and r pixels around it.
    pub source: Grid,
    /// Guide copies: the tile and r + f pixels around it.
    pub guide: Grid,
    /// Half-widths and accumulators: the tile alone.
    pub pixel: Grid,
    /// Vertical patch sums: the tile and f columns on both sides, one plane for each offset of a block.
    pub columns: Grid,
}

impl Layout {
    pub fn new((tile_width, tile_height): (usize, usize), reach: usize, patch: usize, frames: usize) -> Self {
        debug_assert!(tile_width.is_multiple_of(MAX_LANES) && tile_width > 0 && tile_height > 0);
        // A whole number of lines on the left, so that the centre's loads are aligned.
        let left = reach.next_multiple_of(LINE);
        let with_patch = (tile_width + 2 * patch).next_multiple_of(MAX_LANES);
        Self {
            reach,
            patch,
            frames,
            source: Grid::new(left, reach, left + tile_width + reach, tile_height + 2 * reach),
            guide: Grid::new(
                left + patch,
                reach + patch,
                left + with_patch + reach,
                tile_height + 2 * (reach + patch),
            ),
            pixel: Grid::new(0, 0, tile_width, tile_height),
            columns: Grid::new(patch, 0, with_patch, tile_height),
        }
    }

    /// Values between the copies of one frame and those of the next, all on the source's grid.
    pub fn frame(&self) -> usize {
        FRAME_PLANES * self.source.plane
    }

    /// Values between the guides of frames.
    pub fn guide_frame(&self) -> usize {
        3 * self.guide.plane
    }
}
