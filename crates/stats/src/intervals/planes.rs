//! What a family gets of a frame, and what it gives.

use crate::observed::expect;
use crate::{Observed, ShapeError};

/// Planes of one frame; planar, all channels one after the other, as the means.
#[derive(Debug, Clone, Copy)]
pub struct SamplePlanes<'a> {
    /// Means, variances of the means, counts of samples.
    pub observed: Observed<'a>,
    /// Pixels of a row.
    pub width: usize,
    /// Unbiased third central moment of one sample, n·Σ(x − x̄)³/((n − 1)(n − 2)), in cubed units of the means.
    pub third_moment: Option<&'a [f32]>,
    /// Least sample of each pixel and channel.
    pub least: Option<&'a [f32]>,
    /// Greatest sample of each pixel and channel.
    pub greatest: Option<&'a [f32]>,
}

impl SamplePlanes<'_> {
    pub(crate) fn check(&self) -> Result<(), ShapeError> {
        self.observed.check()?;
        let pixels = self.observed.pixels;
        let whole_rows = pixels.checked_div(self.width).unwrap_or(0) * self.width;
        expect("rows of the image's width together", whole_rows, pixels)?;
        for (what, plane) in [
            ("third moment", self.third_moment),
            ("least samples", self.least),
            ("greatest samples", self.greatest),
        ] {
            plane.map_or(Ok(()), |plane| expect(what, plane.len(), self.observed.mean.len()))?;
        }
        Ok(())
    }
}

/// Ends per channel and pixel, in the order and the units of the means. One end is infinite where the family or the level
/// limits only the other; both are where there is no interval: fewer than 2 samples, or numbers that are not finite.
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalPlanes {
    /// Lower ends, −∞ for none; never above the upper ones, never NaN.
    pub low: Vec<f64>,
    /// Upper ends, ∞ for none.
    pub high: Vec<f64>,
}
