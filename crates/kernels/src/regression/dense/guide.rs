//! A tile's working copy of the guide, and what its border does to weights.

use super::params::Weighting;
use crate::engine::{Copies, Grid, LINE, MAX_LANES, Tile};
use crate::nlm::Channel;

/// Offsets whose patches are summed at a time.
pub(super) const GROUP: usize = 2;
/// Planes of each channel: values, variances, and those of the pixel in the middle.
const PLANES: usize = 3;
/// Exponent that leaves no weight.
const NONE: f32 = -1e30;
/// Least weight of a pixel for itself.
const LEAST_OWN: f32 = 1e-4;

/// One call's geometry, shared by all workers.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub weighting: Weighting,
    pub channels: usize,
    /// Whether a variance is NaN somewhere.
    pub unknown: bool,
    /// Copies of the guide: row by row, all planes beside each other.
    pub guide: Grid,
    /// Vertical sums: one plane per channel and offset of a group.
    pub sums: Grid,
    /// Values that a row of the tile takes.
    pub wide: usize,
}

impl Layout {
    pub fn new(weighting: Weighting, guides: &[&Channel<'_>], tile: (usize, usize)) -> Self {
        let channels = guides.len();
        let around = weighting.window + weighting.patch;
        let wide = tile.0.next_multiple_of(MAX_LANES);
        // Vectors start on the last columns, and a group of offsets and a vector beside them are read.
        let columns = wide + 2 * around + 3 * MAX_LANES;
        let rows = tile.1 + 2 * around;
        Self {
            weighting,
            channels,
            unknown: guides.iter().any(|guide| guide.variance.iter().any(|v| v.is_nan())),
            guide: Grid::interleaved(PLANES * channels, (around, around), (columns, rows)),
            sums: Grid::new(0, 0, wide + 3 * MAX_LANES, tile.1),
            wide,
        }
    }

    /// Where a channel's values, variances and own variances start.
    pub fn planes(&self, channel: usize) -> [usize; PLANES] {
        [0, 1, 2].map(|kind| (PLANES * channel + kind) * self.guide.plane)
    }

    pub fn guide_size(&self) -> usize {
        self.guide.interleaved_size() + 2 * MAX_LANES
    }

    pub fn sums_size(&self) -> usize {
        GROUP * self.channels * self.sums.plane + 2 * MAX_LANES
    }

    /// Values of [`Self::fill_border`].
    pub fn border_size(&self) -> usize {
        (2 * self.side() + 1) * self.wide
    }

    /// Pixels of a window's side.
    pub fn side(&self) -> usize {
        2 * self.weighting.window + 1
    }

    /// Where shares of the columns of a horizontal offset start in the border.
    pub fn share(&self, dx: isize) -> usize {
        (dx + self.weighting.window as isize) as usize * self.wide
    }

    /// Where penalties of a horizontal offset start in the border.
    pub fn penalty(&self, dx: isize) -> usize {
        self.side() * self.wide + self.share(dx)
    }

    /// Where the least weights of pixels for themselves start in the border.
    pub fn own(&self) -> usize {
        2 * self.side() * self.wide
    }

    /// Copies the guide. Beyond the image a pair has distance 0: as a neighbour the pixel's variance is infinite, and as a
    /// middle too, though not in what is taken off.
    pub fn fill_guide(&self, copies: &Copies, guide: &[(&Channel<'_>, &[f32])], to: &mut [f32]) {
        for (c, (channel, variance)) in guide.iter().enumerate() {
            let [value, there, own] = self.planes(c);
            copies.marked(&self.guide, channel.value, &mut to[value..], 0.0);
            copies.marked(&self.guide, variance, &mut to[there..], f32::INFINITY);
            copies.marked(&self.guide, variance, &mut to[own..], 0.0);
        }
    }

    /// Fills in, for every horizontal offset, one over the columns of the patch that count, and what takes weights away from
    /// pixels beyond the image.
    pub fn fill_border(&self, tile: Tile, to: &mut [f32]) {
        let (width, reach) = (self.weighting.width, self.weighting.window as isize);
        let inside = |x: isize| (0..width as isize).contains(&x);
        for dx in -reach..=reach {
            for i in 0..self.wide {
                let x = (tile.x + i) as isize;
                to[self.share(dx) + i] = 1.0 / self.taps(x, dx, width);
                let both = i < tile.width && inside(x + dx);
                to[self.penalty(dx) + i] = if both { 0.0 } else { NONE };
            }
        }
        for i in 0..self.wide {
            to[self.own() + i] = if i < tile.width { LEAST_OWN } else { 0.0 };
        }
    }

    /// Taps in one direction that lie in the image around a pixel and around its neighbour, at least 1.
    pub fn taps(&self, x: isize, dx: isize, size: usize) -> f32 {
        let (patch, last) = (self.weighting.patch as isize, size as isize - 1);
        let first = (x - patch).max(0).max(-dx);
        let end = (x + patch).min(last).min(last - dx);
        (end - first + 1).max(1) as f32
    }

    /// Factor from patch sums over one over the columns to an exponent of 2: a row of the tile and a vertical offset.
    pub fn row_factor(&self, y: usize, dy: isize, joined: usize) -> f32 {
        let terms = f64::from(self.taps(y as isize, dy, self.weighting.height)) * joined as f64;
        (-std::f64::consts::LOG2_E / terms) as f32
    }
}

/// Variances as denominators have them: times s·k².
pub(super) fn scaled_variances(weighting: &Weighting, guide: &[&Channel<'_>]) -> Vec<Vec<f32>> {
    let factor = weighting.scale * weighting.k * weighting.k;
    guide.iter().map(|channel| channel.variance.iter().map(|v| v * factor).collect()).collect()
}

/// Sizes of planes start at cache lines.
pub(super) fn lines(size: usize) -> usize {
    size.next_multiple_of(LINE)
}
