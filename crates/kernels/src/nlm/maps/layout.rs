//! Where a tile's maps lie, and which of their pixels are in the image.

use std::ops::Range;

use crate::engine::{Grid, Tile};
use crate::nlm::{NlmInputs, NlmParams, Pass, Taps};

/// Grids of a call, for the largest tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// Image width in pixels.
    pub width: usize,
    /// Image height in pixels.
    pub height: usize,
    /// Guide copies: the tile and what windows, patches and smoothing reach around it. Values, then variances.
    pub guide: Grid,
    /// What is read at neighbours: the tile and the window around it. Values, variances and spreads of all feature
    /// channels, then the targets.
    pub area: Grid,
    /// Maps of distances and weights of the guide: the tile and what patches and smoothing reach.
    pub map: Grid,
    /// What belongs to the tile's own pixels.
    pub pixel: Grid,
    /// Guide channels, 0 if no pass looks at them.
    pub channels: usize,
    /// Channels of all features.
    pub feature_channels: usize,
    /// Planes to filter.
    pub targets: usize,
    /// Pixels around the tile that maps have.
    pub margin: usize,
    /// Window radius.
    pub reach: usize,
}

impl Layout {
    pub fn new(
        params: &NlmParams,
        passes: &[Pass],
        inputs: &NlmInputs<'_>,
        (tile_width, tile_height): (usize, usize),
    ) -> Self {
        let reach = params.window_radius;
        let patches = passes.iter().filter_map(|pass| pass.patch);
        let margin = patches.clone().map(|f| f + params.rules.smoothing.radius(f)).max().unwrap_or(0);
        let around = |by: usize| Grid::new(by, by, tile_width + 2 * by, tile_height + 2 * by);
        Self {
            width: params.width,
            height: params.height,
            guide: around(reach + margin),
            area: around(reach),
            map: around(margin),
            pixel: around(0),
            channels: if patches.count() > 0 { inputs.frame.guide.len() } else { 0 },
            feature_channels: inputs.frame.features.iter().map(Vec::len).sum(),
            targets: inputs.frame.targets.len(),
            margin,
            reach,
        }
    }

    /// Values of one frame's guide planes.
    pub fn guide_size(&self) -> usize {
        2 * self.channels * self.guide.plane
    }

    /// Area plane of a target.
    pub fn target(&self, target: usize) -> usize {
        3 * self.feature_channels + target
    }

    /// Values of one frame's area planes.
    pub fn area_size(&self) -> usize {
        self.target(self.targets) * self.area.plane
    }
}

/// `length` values of a plane from column `x` of row `y` on, both counted from the tile's first pixel.
#[inline(always)]
pub(super) fn row<'a>(plane: &'a [f32], grid: &Grid, (x, y): (isize, isize), length: usize) -> &'a [f32] {
    &plane[start(grid, (x, y))..][..length]
}

/// The same to write to.
#[inline(always)]
pub(super) fn row_mut<'a>(
    plane: &'a mut [f32],
    grid: &Grid,
    (x, y): (isize, isize),
    length: usize,
) -> &'a mut [f32] {
    &mut plane[start(grid, (x, y))..][..length]
}

#[inline(always)]
fn start(grid: &Grid, (x, y): (isize, isize)) -> usize {
    grid.origin().wrapping_add_signed(y * grid.pitch as isize + x)
}

/// A tile and the image around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub tile: Tile,
    pub width: usize,
    pub height: usize,
}

impl Place {
    /// Which of `length` columns, the first at `x` from the tile's first, lie in the image; as places among them.
    #[inline(always)]
    pub fn columns(&self, x: isize, length: usize) -> Range<usize> {
        inside(self.tile.x as isize + x, length, self.width)
    }

    /// Whether the row at `y` from the tile's first lies in the image.
    #[inline(always)]
    pub fn has_row(&self, y: isize) -> bool {
        (0..self.height as isize).contains(&(self.tile.y as isize + y))
    }

    /// Pixels of a box of this radius that lie in the image, in its row and in its column, around the place (x, y) from the
    /// tile's first pixel; at least 1 each.
    #[inline(always)]
    pub fn count(&self, (x, y): (isize, isize), radius: usize) -> (usize, usize) {
        let line = |at: isize, size: usize| inside(at - radius as isize, 2 * radius + 1, size).len().max(1);
        (line(self.tile.x as isize + x, self.width), line(self.tile.y as isize + y, self.height))
    }

    /// Taps of a patch as [`Place::count`] counts them.
    #[inline(always)]
    pub fn taps(&self, at: (isize, isize), patch: usize, rule: Taps) -> (usize, usize) {
        match rule {
            Taps::Clipped => self.count(at, patch),
            Taps::Mirrored => (2 * patch + 1, 2 * patch + 1),
        }
    }
}

/// Which of `length` places from `first` on lie in 0..`size`.
#[inline(always)]
fn inside(first: isize, length: usize, size: usize) -> Range<usize> {
    let start = (-first).clamp(0, length as isize);
    let end = (size as isize - first).clamp(start, length as isize);
    start as usize..end as usize
}
