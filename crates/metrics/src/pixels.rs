//! An image beside its reference, pixel by pixel.

use noisefloor_frame::Image;

use crate::constants::LUMA;
use crate::relative_bias::RelativeBias;
use crate::tone::tone;
use crate::truth::Truth;

/// An image beside its reference, as a metric's [rule](crate::Rule) sees them.
pub struct Pixels<'a> {
    pub(crate) test: &'a Image,
    pub(crate) reference: &'a Image,
    /// Pixels that take part: finite in the test image and in the reference.
    pub(crate) valid: Vec<bool>,
    /// Squared error, corrected for the reference's noise; this and what follows are means over the three channels.
    pub(crate) squared: Vec<f64>,
    /// The same over max(r,0)²+ε, less the bias by that denominator.
    pub(crate) relative: Vec<f64>,
    /// That bias.
    pub(crate) bias: Vec<f64>,
    /// Uncorrected squared error over max(r,0)²+ε.
    pub(crate) relative_plain: Vec<f64>,
    /// Squared error after tone mapping.
    pub(crate) toned: Vec<f64>,
    /// The image itself.
    pub(crate) value: Vec<f64>,
    /// The reference.
    pub(crate) truth: Vec<f64>,
    /// Luma after tone mapping, of the image.
    pub(crate) luma: Vec<f64>,
    /// And of the reference.
    pub(crate) reference_luma: &'a [f64],
    /// Values of the test image that are NaN or infinite.
    pub(crate) non_finite_values: usize,
    /// Whether `relative` and `relative_plain` differ at all.
    pub(crate) corrected: bool,
}

impl std::fmt::Debug for Pixels<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = (self.test.width(), self.test.height());
        f.debug_struct("Pixels").field("size", &size).finish_non_exhaustive()
    }
}

impl<'a> Pixels<'a> {
    pub(crate) fn new(truth: &'a Truth<'_>, bias: &RelativeBias, test: &'a Image) -> Self {
        let n = test.pixels();
        let mut valid = truth.valid.clone();
        for plane in test.planes() {
            valid.iter_mut().zip(plane).for_each(|(flag, value)| *flag &= value.is_finite());
        }
        let mut pixels = Self {
            test,
            reference: truth.mean,
            squared: vec![0.0; n],
            relative: vec![0.0; n],
            bias: vec![0.0; n],
            relative_plain: vec![0.0; n],
            toned: vec![0.0; n],
            value: vec![0.0; n],
            truth: vec![0.0; n],
            luma: vec![0.0; n],
            reference_luma: &truth.luma,
            corrected: bias.is_known(),
            non_finite_values: test.count_non_finite(),
            valid,
        };
        for (c, plane) in test.planes().enumerate() {
            let mean = truth.mean.plane(c);
            let (weight, toned) = (&truth.weight[c * n..], &truth.toned[c * n..]);
            for p in (0..n).filter(|&p| pixels.valid[p]) {
                let x = f64::from(plane[p]);
                let e = x - f64::from(mean[p]);
                pixels.value[p] += x / 3.0;
                pixels.truth[p] += f64::from(mean[p]) / 3.0;
                let squared = truth.numerator(c * n + p, x, e);
                pixels.squared[p] += squared / 3.0;
                let off = bias.at(c * n + p, e);
                pixels.bias[p] += off / 3.0;
                pixels.relative[p] += (squared * weight[p] - off) / 3.0;
                pixels.relative_plain[p] += e * e * weight[p] / 3.0;
                let t = tone(plane[p]);
                let d = t - toned[p];
                pixels.toned[p] += d * d / 3.0;
                pixels.luma[p] += LUMA[c] * t;
            }
        }
        pixels
    }

    /// The image that is measured, three planes.
    #[must_use]
    pub fn test(&self) -> &Image {
        self.test
    }

    /// The mean of the reference.
    #[must_use]
    pub fn reference(&self) -> &Image {
        self.reference
    }

    /// Whether a pixel takes part, row-major: those that are finite in image and reference.
    #[must_use]
    pub fn take_part(&self) -> &[bool] {
        &self.valid
    }
}

/// Mean of the values at these places, of which there is at least one.
pub(crate) fn mean(values: &[f64], members: &[usize]) -> f64 {
    let mut sum = 0.0;
    members.iter().for_each(|&p| sum += values[p]);
    sum * (1.0 / members.len() as f64)
}
