//! All metrics of any number of images against one reference.

use std::collections::BTreeMap;

use noisefloor_frame::{Image, Reference, SquaredError};

use crate::asked::Asked;
use crate::error::MetricError;
use crate::influence::contributions;
use crate::measured::{Classes, Measured, Values};
use crate::metric::Metric;
use crate::pixels::Pixels;
use crate::reference_noise::ReferenceNoise;
use crate::relative_bias::RelativeBias;
use crate::table::METRICS;
use crate::trimmed::kept_positions;
use crate::truth::Truth;

/// Compares images with one reference.
#[derive(Debug)]
pub struct Measurer<'a> {
    pub(crate) truth: Truth<'a>,
    metrics: Vec<&'static Metric>,
    noise: ReferenceNoise,
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
        let truth = Truth::new(reference, classes)?;
        let (noise, bias) = (ReferenceNoise::new(&truth), RelativeBias::new(&truth));
        Ok(Self { truth, metrics: METRICS.iter().collect(), noise, bias })
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
        self.truth.squared_error()
    }

    /// The same in words.
    #[must_use]
    pub fn correction(&self) -> &'static str {
        match self.squared_error() {
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
        self.noise.floor(&self.truth)
    }

    /// How the bias by the noisy denominator of relative errors is estimated, in words; empty where there is none to take
    /// out or nothing to estimate it with.
    #[must_use]
    pub fn bias_correction(&self) -> &'static str {
        match (self.bias.is_known(), self.truth.parts_in_a()) {
            (false, _) => "",
            (true, Some(_)) => "jackknife over the reference's parts inside each half",
            (true, None) => "second-order expansion in the reference's variance",
        }
    }

    /// Computes all metrics.
    ///
    /// # Errors
    /// [`MetricError::Shape`] if the image has not the shape of the reference, [`MetricError::NoCommonPixel`] if no pixel is
    /// finite in both; what a metric on request fails with.
    pub fn measure(&self, test: &Image) -> Result<Measured, MetricError> {
        let asked = self.asked(test)?;
        let errors = &asked.pixels;
        let all: Vec<usize> = (0..test.pixels()).filter(|&p| errors.valid[p]).collect();
        let pixels = all.len();
        if pixels == 0 {
            return Err(MetricError::NoCommonPixel { pixels: test.pixels() });
        }
        let over = |members: &[usize]| -> Values {
            asked.over(members).map(|(metric, value)| (metric.id.to_owned(), value)).collect()
        };
        let values = over(&all);
        let mut classes = BTreeMap::new();
        if let Some(map) = &self.truth.classes {
            let mut members = vec![Vec::new(); map.names.len()];
            all.iter().for_each(|&p| members[map.of_pixel[p] as usize].push(p));
            for (name, members) in map.names.iter().zip(members) {
                if !members.is_empty() {
                    classes.insert(name.clone(), over(&members));
                }
            }
        }
        let (reference, class_reference) =
            contributions((&self.truth, &self.noise), test, errors, &kept(errors));
        Ok(Measured {
            reference_se: self.noise.standard_errors(&self.truth, test, errors, &values, &reference),
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
        test.expect_shape("test image", self.truth.mean.width(), self.truth.mean.height(), 3)?;
        let mut valid = self.truth.valid.clone();
        for plane in test.planes() {
            valid.iter_mut().zip(plane).for_each(|(flag, value)| *flag &= value.is_finite());
        }
        let values = test.data().iter().zip(self.truth.mean.data()).zip(valid.iter().cycle());
        let squared = values.enumerate().map(|(i, ((&x, &r), &ok))| {
            let x = f64::from(x);
            if ok { self.truth.numerator(i, x, x - f64::from(r)) } else { f64::NAN }
        });
        Ok(squared.collect())
    }

    pub(crate) fn asked<'b>(&'b self, test: &'b Image) -> Result<Asked<'b>, MetricError> {
        let mean = self.truth.mean;
        test.expect_shape("test image", mean.width(), mean.height(), 3)?;
        Asked::new(Pixels::new(&self.truth, &self.bias, test), &self.metrics)
    }
}

/// Pixels that the trimmed mean over all pixels keeps.
fn kept(errors: &Pixels<'_>) -> Vec<bool> {
    let all: Vec<usize> = (0..errors.valid.len()).filter(|&p| errors.valid[p]).collect();
    let plain: Vec<f64> = all.iter().map(|&p| errors.relative_plain[p]).collect();
    let mut kept = vec![false; errors.valid.len()];
    kept_positions(&plain).into_iter().for_each(|at| kept[all[at]] = true);
    kept
}
