use std::collections::BTreeMap;

use noisefloor_frame::{Image, Reference, SquaredError};

use crate::pixels::{LUMA, PixelErrors};
use crate::reference_noise::ReferenceNoise;
use crate::tone::tone;
use crate::trimmed::trimmed_mean;
use crate::{EPSILON, METRICS, MetricError};

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
    /// Values of the image that are NaN or infinite.
    pub non_finite_values: usize,
    /// Pixels that took part: those where image and reference are finite. At least 1.
    pub pixels: usize,
    /// Pixels of the whole image: every number is over `pixels` of `pixels_of`.
    pub pixels_of: usize,
}

/// Compares images with one reference.
#[derive(Debug)]
pub struct Measurer<'a> {
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
    classes: Option<Classes<'a>>,
    noise: ReferenceNoise,
}

impl<'a> Measurer<'a> {
    /// Prepares a reference; `classes` asks for the metrics per class too.
    ///
    /// # Errors
    /// [`MetricError::Shape`] if the reference is inconsistent or has not 3 channels, [`MetricError::ClassMap`] or
    /// [`MetricError::ClassIndex`] if the class map does not fit, [`MetricError::NoReferencePixel`] if no pixel of the
    /// reference is finite.
    pub fn new(reference: &'a Reference, classes: Option<Classes<'a>>) -> Result<Self, MetricError> {
        reference.frame.check()?;
        let mean = reference.mean();
        let (w, h) = (mean.width(), mean.height());
        for (k, part) in reference.parts.iter().enumerate() {
            part.expect_shape(&format!("part{k}"), w, h, 3)?;
        }
        if let Some(classes) = &classes {
            check_classes(classes, w * h)?;
        }
        let valid = finite_pixels(reference);
        if !valid.contains(&true) {
            return Err(MetricError::NoReferencePixel { pixels: w * h });
        }
        let weight = mean
            .data()
            .iter()
            .map(|&r| 1.0 / (f64::from(r).max(0.0).powi(2) + EPSILON)) // ε > 0
            .collect();
        let toned: Vec<f64> = mean.data().iter().map(|&r| tone(r)).collect();
        let n = w * h;
        let luma = (0..n).map(|p| (0..3).map(|c| LUMA[c] * toned[c * n + p]).sum()).collect();
        let mut measurer = Self {
            reference,
            mean,
            kind: reference.squared_error(),
            valid,
            weight,
            toned,
            luma,
            classes,
            noise: ReferenceNoise::default(),
        };
        measurer.noise = ReferenceNoise::new(&measurer);
        Ok(measurer)
    }

    /// How the reference's noise is taken out of squared errors.
    #[must_use]
    pub fn squared_error(&self) -> SquaredError {
        self.kind
    }

    /// The same in words.
    #[must_use]
    pub fn correction(&self) -> &'static str {
        match self.kind {
            SquaredError::Exact => "the truth is exact: nothing to take out",
            SquaredError::Halves => {
                "squared error = product of the residuals to two independent halves of the reference"
            }
            SquaredError::SubtractVariance => {
                "variance of the reference subtracted from the squared residual"
            }
            SquaredError::Uncorrected => {
                "none: the reference states no noise, which therefore counts as error"
            }
        }
    }

    /// Metric id to the standard error that the reference would contribute even for a perfect image: no
    /// smaller error can be shown with it. Only corrected metrics of a reference whose noise is known.
    #[must_use]
    pub fn floor(&self) -> BTreeMap<String, f64> {
        self.noise.floor(self)
    }

    /// Metric id to a figure that bounds the remaining bias: for `relmse` the mean of var(r)/(r²+ε), the
    /// second-order term of the noisy denominator, relative to the metric. Empty if the reference's variance
    /// is unknown.
    #[must_use]
    pub fn bias(&self) -> BTreeMap<String, f64> {
        self.noise.bias(self)
    }

    /// Computes all metrics.
    ///
    /// # Errors
    /// [`MetricError::Shape`] if the image has not the shape of the reference, [`MetricError::NoCommonPixel`] if no pixel is
    /// finite in both.
    pub fn measure(&self, test: &Image) -> Result<Measured, MetricError> {
        let errors = self.pixel_errors(test)?;
        let all = (0..test.pixels()).filter(|&p| errors.valid[p]);
        let pixels = all.clone().count();
        if pixels == 0 {
            return Err(MetricError::NoCommonPixel { pixels: test.pixels() });
        }
        let values = aggregate(&errors, all.clone());
        let mut classes = BTreeMap::new();
        if let Some(map) = &self.classes {
            let mut members = vec![Vec::new(); map.names.len()];
            all.clone().for_each(|p| members[map.of_pixel[p] as usize].push(p));
            for (name, members) in map.names.iter().zip(members) {
                if !members.is_empty() {
                    classes.insert(name.clone(), aggregate(&errors, members.into_iter()));
                }
            }
        }
        let mse = values["mse"].unwrap_or(0.0);
        Ok(Measured {
            reference_se: self.noise.standard_errors(self, test, &errors.valid, mse),
            values,
            classes,
            non_finite_values: errors.non_finite_values,
            pixels,
            pixels_of: test.pixels(),
        })
    }

    /// Squared error of every pixel and channel as `mse` averages it, with the reference's noise taken out where the
    /// reference allows; planar like the image, NaN in pixels that do not take part. Single values may be negative.
    ///
    /// # Errors
    /// [`MetricError::Shape`] if the image has not the shape of the reference.
    pub fn squared_errors(&self, test: &Image) -> Result<Vec<f64>, MetricError> {
        test.expect_shape("test image", self.mean.width(), self.mean.height(), 3)?;
        let mut valid = self.valid.clone();
        for plane in test.planes() {
            valid.iter_mut().zip(plane).for_each(|(flag, value)| *flag &= value.is_finite());
        }
        let values = test.data().iter().zip(self.mean.data()).zip(valid.iter().cycle());
        let squared = values.enumerate().map(|(i, ((&x, &r), &ok))| {
            let x = f64::from(x);
            if ok { self.numerator(i, x, x - f64::from(r)) } else { f64::NAN }
        });
        Ok(squared.collect())
    }

    pub(crate) fn pixel_errors(&self, test: &Image) -> Result<PixelErrors, MetricError> {
        test.expect_shape("test image", self.mean.width(), self.mean.height(), 3)?;
        Ok(PixelErrors::new(self, test))
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

fn check_classes(classes: &Classes<'_>, pixels: usize) -> Result<(), MetricError> {
    if classes.of_pixel.len() != pixels {
        return Err(MetricError::ClassMap { pixels, got: classes.of_pixel.len() });
    }
    let names = classes.names.len();
    match classes.of_pixel.iter().position(|&c| c as usize >= names) {
        Some(pixel) => Err(MetricError::ClassIndex { pixel, index: classes.of_pixel[pixel], names }),
        None => Ok(()),
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

/// All metrics over some pixels, by id.
pub(crate) fn aggregate(errors: &PixelErrors, pixels: impl Iterator<Item = usize>) -> Values {
    let (mut squared, mut relative, mut toned, mut ssim) = (0.0, 0.0, 0.0, 0.0);
    let mut plain = Vec::new();
    for p in pixels {
        squared += errors.squared[p];
        relative += errors.relative[p];
        toned += errors.toned[p];
        ssim += errors.ssim[p];
        plain.push(errors.relative_plain[p]);
    }
    if plain.is_empty() {
        return METRICS.iter().map(|m| (m.id.to_owned(), None)).collect();
    }
    let inverse = 1.0 / plain.len() as f64; // not empty
    let mse = squared * inverse;
    let psnr = -10.0 * (toned * inverse).log10();
    [
        ("mse", Some(mse)),
        ("rmse", Some(mse.max(0.0).sqrt())),
        ("relmse", Some(relative * inverse)),
        ("relmse_trimmed", trimmed_mean(&mut plain)),
        ("psnr", Some(psnr)),
        ("ssim", Some(ssim * inverse)),
    ]
    .map(|(id, value)| (id.to_owned(), value.filter(|v| v.is_finite())))
    .into()
}
