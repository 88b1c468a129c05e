//! Copies of what a tile looks at, mirrored at the border of the image.

use super::layout::{Layout, row};
use super::squares::Row;
use crate::engine::Copies;
use crate::nlm::Planes;

/// A frame's planes around a tile.
#[derive(Clone, Debug)]
pub(super) struct Around {
    guide: Vec<f32>,
    area: Vec<f32>,
}

impl Around {
    /// Room for the planes of one frame.
    pub fn new(layout: &Layout) -> Self {
        Self { guide: vec![0.0; layout.guide_size()], area: vec![0.0; layout.area_size()] }
    }

    /// Copies a frame's planes.
    pub fn fill(&mut self, layout: &Layout, copies: &Copies, frame: &Planes<'_>) {
        let grid = &layout.guide;
        for (c, channel) in frame.guide.iter().enumerate().take(layout.channels) {
            copies.mirrored(grid, channel.value, &mut self.guide[c * grid.plane..], 1.0);
            copies.mirrored(
                grid,
                channel.variance,
                &mut self.guide[(layout.channels + c) * grid.plane..],
                1.0,
            );
        }
        let grid = &layout.area;
        for (c, channel) in frame.features.iter().flatten().enumerate() {
            for (kind, plane) in [channel.value, channel.variance, channel.spread].into_iter().enumerate() {
                let to = (kind * layout.feature_channels + c) * grid.plane;
                copies.mirrored(grid, plane, &mut self.area[to..], 1.0);
            }
        }
        for (k, target) in frame.targets.iter().enumerate() {
            copies.mirrored(grid, target, &mut self.area[layout.target(k) * grid.plane..], 1.0);
        }
    }

    /// A row of a guide channel, from a place counted from the tile's first pixel on.
    #[inline(always)]
    pub fn guide(&self, layout: &Layout, channel: usize, at: (isize, isize), length: usize) -> Row<'_> {
        let plane = |c: usize| row(&self.guide[c * layout.guide.plane..], &layout.guide, at, length);
        Row { value: plane(channel), variance: plane(layout.channels + channel) }
    }

    /// A row of a feature channel's values (kind 0), variances (1) or spreads (2).
    #[inline(always)]
    pub fn feature(
        &self,
        layout: &Layout,
        (kind, channel): (usize, usize),
        at: (isize, isize),
        length: usize,
    ) -> &[f32] {
        let plane = kind * layout.feature_channels + channel;
        row(&self.area[plane * layout.area.plane..], &layout.area, at, length)
    }

    /// A row of a target.
    #[inline(always)]
    pub fn target(&self, layout: &Layout, target: usize, at: (isize, isize), length: usize) -> &[f32] {
        row(&self.area[layout.target(target) * layout.area.plane..], &layout.area, at, length)
    }
}
