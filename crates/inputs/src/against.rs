//! A reference, ready to have frames held against it.

use noisefloor_frame::{Image, Reference, SquaredError};
use noisefloor_stats::instrument::{Blocks, smooth_weights};

use crate::Planes;

/// A reference with what all frames need of it.
#[derive(Debug)]
pub struct Against<'a> {
    pub(crate) reference: &'a Reference,
    /// Samples per pixel of the reference, if known.
    pub(crate) spp: Option<f64>,
    pub(crate) exact: bool,
    pub(crate) blocks: Blocks,
    /// [`smooth_weights`] of the channels' mean, per block.
    pub(crate) weights: Vec<f64>,
    finite: Vec<bool>,
    pub(crate) planes: Planes,
}

impl<'a> Against<'a> {
    /// `spp` are the samples per pixel of the reference, where they are known.
    #[must_use]
    pub fn new(reference: &'a Reference, spp: Option<f64>) -> Self {
        let mean = reference.mean();
        let blocks = Blocks::new(mean.width(), mean.height());
        let finite: Vec<bool> =
            (0..mean.pixels()).map(|p| mean.planes().all(|plane| plane[p].is_finite())).collect();
        let weights = smooth_weights(&blocks, |p| finite[p].then(|| f64::from(grey(mean, p))));
        let planes = Planes::of(&reference.frame.color).with_parts(&reference.parts);
        let exact = reference.squared_error() == SquaredError::Exact;
        Self { reference, spp: spp.filter(|n| *n >= 1.0), exact, blocks, weights, finite, planes }
    }

    /// Whether a pixel takes part: finite in the reference and not flagged.
    pub(crate) fn usable(&self, pixel: usize, invalid: &[bool]) -> bool {
        self.finite[pixel] && !invalid.get(pixel).is_some_and(|bad| *bad)
    }

    /// Σ w·g over the reference.
    pub(crate) fn light(&self) -> f64 {
        let mean = self.reference.mean();
        let one = |p: usize| self.weights[self.blocks.of(p)] * f64::from(grey(mean, p));
        (0..mean.pixels()).filter(|&p| self.finite[p]).map(one).sum()
    }
}

/// Mean of the three channels.
pub(crate) fn grey(image: &Image, pixel: usize) -> f32 {
    (image.plane(0)[pixel] + image.plane(1)[pixel] + image.plane(2)[pixel]) / 3.0
}
