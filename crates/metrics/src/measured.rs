//! What was measured, and of which pixels.

use std::collections::BTreeMap;

use crate::contribution::Contribution;
use crate::error::MetricError;

/// Metric id to value; `None` where it is undefined or not finite.
pub type Values = BTreeMap<String, Option<f64>>;

/// A class for every pixel.
#[derive(Debug, Clone, Copy)]
pub struct Classes<'a> {
    /// Names, indexed by the entries of `of_pixel`.
    pub names: &'a [String],
    /// Row-major: index into `names`.
    pub of_pixel: &'a [u8],
}

/// All metrics of one image.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Over all pixels.
    pub values: Values,
    /// Per class that has pixels.
    pub classes: BTreeMap<String, Values>,
    /// Metric id to the standard error that the reference's own noise contributes; only corrected metrics,
    /// and only where the reference tells.
    pub reference_se: BTreeMap<String, f64>,
    /// Metric id to what the reference does to its value beside that: the bias that was taken out, and the influence of
    /// its parts.
    pub reference: BTreeMap<String, Contribution>,
    /// The same per class that has pixels.
    pub class_reference: BTreeMap<String, BTreeMap<String, Contribution>>,
    /// Values of the image that are NaN or infinite.
    pub non_finite_values: usize,
    /// Pixels that took part: those where image and reference are finite. At least 1.
    pub pixels: usize,
    /// Pixels of the whole image: every number is over `pixels` of `pixels_of`.
    pub pixels_of: usize,
}

impl Classes<'_> {
    /// Whether there is a name for the class of every pixel.
    pub(crate) fn check(&self, pixels: usize) -> Result<(), MetricError> {
        if self.of_pixel.len() != pixels {
            return Err(MetricError::ClassMap { pixels, got: self.of_pixel.len() });
        }
        let names = self.names.len();
        match self.of_pixel.iter().position(|&c| c as usize >= names) {
            Some(pixel) => Err(MetricError::ClassIndex { pixel, index: self.of_pixel[pixel], names }),
            None => Ok(()),
        }
    }
}
