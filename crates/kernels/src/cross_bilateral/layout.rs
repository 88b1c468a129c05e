//! Sizes, factors, and a worker's memory.

use super::params::{BilateralParams, Spatial};
use crate::engine::{Grid, LINE, Scratch};

/// Pixels that are worked on together.
pub(super) const LANES: usize = 16;
pub(super) type Lanes = [f32; LANES];

/// Tile, (width, height) in pixels: wide, because loops run along its rows.
pub(super) const TILE: (usize, usize) = (128, 16);

/// One filter.
pub(super) struct Factors {
    pub reach: usize,
    /// exp(−d²/(2σ²)) for d = 0, 1, …
    pub table: Vec<f64>,
}

/// What all tiles share. Rows are read in whole lanes, beyond what counts.
pub(super) struct Layout {
    /// Guides.
    pub guides: usize,
    /// Planes to average.
    pub averaged: usize,
    /// Filters that look beyond the pixel itself.
    pub filters: Vec<Factors>,
    /// The largest of their windows.
    pub reach: usize,
    /// No window has more beside a pixel.
    side: usize,
    /// Guide values, their scaled variances, then what is averaged.
    pub area: Grid,
    /// Sums of a row that belong to one filter: of its planes, then of its weights.
    pub sums: usize,
}

impl Layout {
    pub fn new(params: &BilateralParams, guides: usize, averaged: usize, bank: &[Spatial]) -> Self {
        let side = params.width.max(params.height) - 1;
        let filters: Vec<Factors> = bank
            .iter()
            .filter(|spatial| spatial.reach().min(side) > 0)
            .map(|spatial| {
                let reach = spatial.reach().min(side);
                let over = 2.0 * f64::from(spatial.sigma).powi(2);
                Factors { reach, table: (0..=reach).map(|d| (-((d * d) as f64) / over).exp()).collect() }
            })
            .collect();
        let reach = filters.iter().map(|filter| filter.reach).max().unwrap_or(0);
        // A whole number of lines on the left, so that the tile's own pixels are aligned.
        let left = reach.next_multiple_of(LINE);
        let size = (left + TILE.0 + reach, TILE.1 + 2 * reach);
        let area = Grid::interleaved(2 * guides + averaged, (left, reach), size);
        Self { guides, averaged, filters, reach, side, area, sums: (averaged + 1) * TILE.0 }
    }

    /// Window radius of a filter, no more than the image has.
    pub fn reach(&self, spatial: &Spatial) -> usize {
        spatial.reach().min(self.side)
    }
}

/// A worker's memory.
pub(super) struct Work(Scratch);

impl Work {
    pub fn new(layout: &Layout) -> Self {
        Self(Scratch::new(Self::sizes(layout).iter().sum()))
    }

    /// Its parts: area, columns beyond the image, e^−D of a row of pixels at each offset, sums of a row, factors.
    pub fn parts(&mut self, layout: &Layout) -> [&mut [f32]; 5] {
        self.0.parts(Self::sizes(layout))
    }

    fn sizes(layout: &Layout) -> [usize; 5] {
        let offsets = 2 * layout.reach + 1;
        let area = layout.area.interleaved_size();
        [area, layout.area.plane, offsets * TILE.0, layout.filters.len() * layout.sums, offsets]
    }
}
