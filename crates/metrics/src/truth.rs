//! The reference, prepared for all images that are measured against it.

use noisefloor_frame::{Image, Reference, SquaredError};

use crate::constants::LUMA;
use crate::error::MetricError;
use crate::measured::Classes;
use crate::tone::tone;
use crate::weight::{weight, weight_slope};

/// A reference with what every metric needs of it.
#[derive(Debug)]
pub(crate) struct Truth<'a> {
    pub(crate) reference: &'a Reference,
    pub(crate) mean: &'a Image,
    kind: SquaredError,
    /// Pixels where the reference is finite.
    pub(crate) valid: Vec<bool>,
    /// 1/(max(r,0)²+ε), all planes.
    pub(crate) weight: Vec<f64>,
    /// Tone-mapped reference, all planes.
    pub(crate) toned: Vec<f64>,
    /// Its luma.
    pub(crate) luma: Vec<f64>,
    pub(crate) classes: Option<Classes<'a>>,
}

impl<'a> Truth<'a> {
    pub(crate) fn new(reference: &'a Reference, classes: Option<Classes<'a>>) -> Result<Self, MetricError> {
        reference.frame.check()?;
        let mean = reference.mean();
        let (w, h) = (mean.width(), mean.height());
        for (k, part) in reference.parts.iter().enumerate() {
            part.expect_shape(&format!("part{k}"), w, h, 3)?;
        }
        if let Some(classes) = &classes {
            classes.check(w * h)?;
        }
        let valid = finite_pixels(reference);
        if !valid.contains(&true) {
            return Err(MetricError::NoReferencePixel { pixels: w * h });
        }
        let weight = mean.data().iter().map(|&r| weight(f64::from(r))).collect();
        let toned: Vec<f64> = mean.data().iter().map(|&r| tone(r)).collect();
        let n = w * h;
        let luma = (0..n).map(|p| (0..3).map(|c| LUMA[c] * toned[c * n + p]).sum()).collect();
        Ok(Self { reference, mean, kind: reference.squared_error(), valid, weight, toned, luma, classes })
    }

    /// How the reference's noise is taken out of squared errors.
    pub(crate) fn squared_error(&self) -> SquaredError {
        self.kind
    }

    /// Parts that make up half A, if both halves have at least two.
    pub(crate) fn parts_in_a(&self) -> Option<usize> {
        let parts = self.reference.parts.len();
        (parts >= 4 && self.reference.frame.color.halves.is_some()).then(|| parts.div_ceil(2))
    }

    /// Squared error of value `x` at planar index `i`, where `e` is its residual to the reference mean.
    #[inline]
    pub(crate) fn numerator(&self, i: usize, x: f64, e: f64) -> f64 {
        let color = &self.reference.frame.color;
        match (self.kind, &color.halves, &color.variance) {
            (SquaredError::Halves, Some([a, b]), _) => {
                (x - f64::from(a.data()[i])) * (x - f64::from(b.data()[i]))
            }
            (SquaredError::SubtractVariance, _, Some(v)) => e * e - f64::from(v.mean_variance().data()[i]),
            _ => e * e,
        }
    }
}

/// Pixels where mean, variance, halves and parts of the reference are all finite.
fn finite_pixels(reference: &Reference) -> Vec<bool> {
    let color = &reference.frame.color;
    let mut valid = vec![true; color.mean.pixels()];
    let variance = color.variance.as_ref().map(noisefloor_frame::Variance::mean_variance);
    let images = std::iter::once(&color.mean)
        .chain(variance)
        .chain(color.halves.iter().flatten())
        .chain(&reference.parts);
    for plane in images.flat_map(Image::planes) {
        valid.iter_mut().zip(plane).for_each(|(flag, value)| *flag &= value.is_finite());
    }
    valid
}

/// (A−B) times what a shift of both halves against each other does to the relative squared error: it has the spread of
/// what their noise does.
pub(crate) fn halves_term(truth: &Truth<'_>, i: usize, x: f64, a: f64, b: f64) -> f64 {
    let r = f64::from(truth.mean.data()[i]);
    let linear = (x - 0.5 * (a + b)) * truth.weight[i];
    (linear - 0.5 * (x - a) * (x - b) * weight_slope(r)) * (a - b)
}
