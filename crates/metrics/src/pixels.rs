use noisefloor_frame::Image;

use crate::MetricError;
use crate::measurer::Measurer;
use crate::table::{Metric, Rule};
use crate::tone::tone;

/// Weights of Rec. 709 luma.
pub(crate) const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// An image beside its reference, as a metric's [`Rule`] sees them.
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
    /// What is measured.
    metrics: &'a [&'static Metric],
    /// The maps of those whose rule is [`Rule::Map`].
    maps: Vec<Option<Vec<f64>>>,
}

impl std::fmt::Debug for Pixels<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = (self.test.width(), self.test.height());
        f.debug_struct("Pixels").field("size", &size).finish_non_exhaustive()
    }
}

impl<'a> Pixels<'a> {
    pub(crate) fn new(measurer: &'a Measurer<'_>, test: &'a Image) -> Result<Self, MetricError> {
        let n = test.pixels();
        let mut valid = measurer.valid.clone();
        for plane in test.planes() {
            valid.iter_mut().zip(plane).for_each(|(flag, value)| *flag &= value.is_finite());
        }
        let mut pixels = Self {
            test,
            reference: measurer.mean,
            squared: vec![0.0; n],
            relative: vec![0.0; n],
            bias: vec![0.0; n],
            relative_plain: vec![0.0; n],
            toned: vec![0.0; n],
            value: vec![0.0; n],
            truth: vec![0.0; n],
            luma: vec![0.0; n],
            reference_luma: &measurer.luma,
            corrected: measurer.bias.is_known(),
            non_finite_values: test.count_non_finite(),
            valid,
            metrics: measurer.metrics(),
            maps: Vec::new(),
        };
        for (c, plane) in test.planes().enumerate() {
            let mean = measurer.mean.plane(c);
            let (weight, toned) = (&measurer.weight[c * n..], &measurer.toned[c * n..]);
            for p in (0..n).filter(|&p| pixels.valid[p]) {
                let x = f64::from(plane[p]);
                let e = x - f64::from(mean[p]);
                pixels.value[p] += x / 3.0;
                pixels.truth[p] += f64::from(mean[p]) / 3.0;
                let squared = measurer.numerator(c * n + p, x, e);
                pixels.squared[p] += squared / 3.0;
                let bias = measurer.bias.at(c * n + p, e);
                pixels.bias[p] += bias / 3.0;
                pixels.relative[p] += (squared * weight[p] - bias) / 3.0;
                pixels.relative_plain[p] += e * e * weight[p] / 3.0;
                let t = tone(plane[p]);
                let d = t - toned[p];
                pixels.toned[p] += d * d / 3.0;
                pixels.luma[p] += LUMA[c] * t;
            }
        }
        pixels.maps = pixels.metrics.iter().map(|metric| pixels.map_of(metric)).collect::<Result<_, _>>()?;
        Ok(pixels)
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

    fn map_of(&self, metric: &Metric) -> Result<Option<Vec<f64>>, MetricError> {
        // Where no pixel takes part there is nothing to map.
        let (Rule::Map(map), true) = (metric.rule, self.valid.contains(&true)) else { return Ok(None) };
        let map = map(self)?;
        match map.as_ref().map(Vec::len) {
            Some(got) if got != self.valid.len() => {
                Err(MetricError::Map { id: metric.id, pixels: self.valid.len(), got })
            }
            _ => Ok(map),
        }
    }

    /// What is measured, each with its number over some pixels; those have to take part, and may be there several times.
    pub(crate) fn over(&self, members: &[usize]) -> impl Iterator<Item = (&'static Metric, Option<f64>)> {
        self.metrics.iter().zip(&self.maps).map(move |(&metric, map)| {
            let value = match (metric.rule, map) {
                _ if members.is_empty() => None,
                (Rule::Over(number), _) => number(self, members),
                (Rule::Map(_), Some(map)) => Some(mean(map, members)),
                (Rule::Map(_), None) => None,
            };
            (metric, value.filter(|value| value.is_finite()))
        })
    }
}

/// Mean of the values at these places, of which there is at least one.
pub(crate) fn mean(values: &[f64], members: &[usize]) -> f64 {
    let mut sum = 0.0;
    members.iter().for_each(|&p| sum += values[p]);
    sum * (1.0 / members.len() as f64)
}
