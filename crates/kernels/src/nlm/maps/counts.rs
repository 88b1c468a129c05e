//! How many pixels boxes have: fewer at the border of the image.

use super::boxes::Region;
use super::layout::Place;
use crate::nlm::Taps;

/// Pixels of the boxes around each pixel of a region, by column and by row.
#[derive(Clone, Debug)]
pub(super) struct Counts {
    /// Columns of the box, for each column of the region.
    pub columns: Vec<f32>,
    rows: Vec<f32>,
    around: isize,
}

impl Counts {
    /// Boxes of `radius`; with [`Taps::Clipped`] what lies in the image of them.
    pub fn new(place: &Place, region: Region, radius: usize, taps: Taps) -> Self {
        let at = |x: isize, y: isize| place.taps((x, y), radius, taps);
        let columns = (0..region.columns() as isize).map(|i| at(i + region.left(), 0).0 as f32).collect();
        let rows = region.rows().map(|y| at(0, y).1 as f32).collect();
        Self { columns, rows, around: region.around as isize }
    }

    /// Rows of the boxes in row `y` from the tile's first.
    #[inline(always)]
    pub fn rows(&self, y: isize) -> f32 {
        self.rows[(y + self.around) as usize]
    }

    /// Columns of the boxes of the tile's own pixels.
    #[inline(always)]
    pub fn own_columns(&self) -> &[f32] {
        &self.columns[self.around as usize..]
    }
}
