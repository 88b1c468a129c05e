use std::collections::BTreeMap;

use noisefloor_frame::{Image, Reference, SquaredError};

use crate::contribution::Contribution;
use crate::influence::contributions;
use crate::pixels::{LUMA, Pixels};
use crate::reference_noise::ReferenceNoise;
use crate::relative_bias::{RelativeBias, weight};
use crate::tone::tone;
use crate::trimmed::kept_positions;
use crate::{METRICS, Metric, MetricError};

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
    pub(crate) classes: Option<Classes<'a>>,
    metrics: Vec<&'static Metric>,
    pub(crate) noise: ReferenceNoise,
    pub(crate) bias: RelativeBias,
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
        let weight = mean.data().iter().map(|&r| weight(f64::from(r))).collect();
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
            metrics: METRICS.iter().collect(),
            noise: ReferenceNoise::default(),
            bias: RelativeBias::default(),
        };
        measurer.noise = ReferenceNoise::new(&measurer);
        measurer.bias = RelativeBias::new(&measurer);
        Ok(measurer)
    }

    /// Measures these too, beside [`METRICS`]; what is measured anyway stays as it is.
    #[must_use]
    pub fn with(mut self, metrics: &[&'static Metric]) -> Self {
        for metric in metrics {
            if self.metrics.iter().all(|other| other.id != metric.id) {
                self.metrics.push(metric);
            }
        }
        self
    }

    /// What is measured, in the order of display.
    #[must_use]
    pub fn metrics(&self) -> &[&'static Metric] {
        &self.metrics
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

    /// How the bias by the noisy denominator of relative errors is estimated, in words; empty where there is none to take
    /// out or nothing to estimate it with.
    #[must_use]
    pub fn bias_correction(&self) -> &'static str {
        match (self.bias.is_known(), self.parts_in_a()) {
            (false, _) => "",
            (true, Some(_)) => "jackknife over the reference's parts inside each half",
            (true, None) => "second-order expansion in the reference's variance",
        }
    }

    /// Parts that make up half A, if both halves have at least two.
    pub(crate) fn parts_in_a(&self) -> Option<usize> {
        let parts = self.reference.parts.len();
        (parts >= 4 && self.reference.frame.color.halves.is_some()).then(|| parts.div_ceil(2))
    }

    /// Computes all metrics.
    ///
    /// # Errors
    /// [`MetricError::Shape`] if the image has not the shape of the reference, [`MetricError::NoCommonPixel`] if no pixel is
    /// finite in both; what a metric on request fails with.
    pub fn measure(&self, test: &Image) -> Result<Measured, MetricError> {
        let errors = self.pixel_errors(test)?;
        let all: Vec<usize> = (0..test.pixels()).filter(|&p| errors.valid[p]).collect();
        let pixels = all.len();
        if pixels == 0 {
            return Err(MetricError::NoCommonPixel { pixels: test.pixels() });
        }
        let over = |members: &[usize]| -> Values {
            errors.over(members).map(|(metric, value)| (metric.id.to_owned(), value)).collect()
        };
        let values = over(&all);
        let mut classes = BTreeMap::new();
        if let Some(map) = &self.classes {
            let mut members = vec![Vec::new(); map.names.len()];
            all.iter().for_each(|&p| members[map.of_pixel[p] as usize].push(p));
            for (name, members) in map.names.iter().zip(members) {
                if !members.is_empty() {
                    classes.insert(name.clone(), over(&members));
                }
            }
        }
        let (reference, class_reference) = contributions(self, test, &errors, &kept(&errors));
        Ok(Measured {
            reference_se: self.noise.standard_errors(self, test, &errors, &values, &reference),
            values,
            classes,
            reference,
            class_reference,
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

    pub(crate) fn pixel_errors<'b>(&'b self, test: &'b Image) -> Result<Pixels<'b>, MetricError> {
        test.expect_shape("test image", self.mean.width(), self.mean.height(), 3)?;
        Pixels::new(self, test)
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

/// Pixels that the trimmed mean over all pixels keeps.
fn kept(errors: &Pixels<'_>) -> Vec<bool> {
    let all: Vec<usize> = (0..errors.valid.len()).filter(|&p| errors.valid[p]).collect();
    let plain: Vec<f64> = all.iter().map(|&p| errors.relative_plain[p]).collect();
    let mut kept = vec![false; errors.valid.len()];
    kept_positions(&plain).into_iter().for_each(|at| kept[all[at]] = true);
    kept
}
