//! The metrics that are asked of an image, and their numbers over any of its pixels.

use crate::error::MetricError;
use crate::metric::{Metric, Rule};
use crate::pixels::{Pixels, mean};

/// An image with what is measured of it.
#[derive(Debug)]
pub(crate) struct Asked<'a> {
    pub(crate) pixels: Pixels<'a>,
    metrics: &'a [&'static Metric],
    /// The maps of those whose rule is [`Rule::Map`].
    maps: Vec<Option<Vec<f64>>>,
}

impl<'a> Asked<'a> {
    pub(crate) fn new(pixels: Pixels<'a>, metrics: &'a [&'static Metric]) -> Result<Self, MetricError> {
        let maps = metrics.iter().map(|metric| map_of(&pixels, metric)).collect::<Result<_, _>>()?;
        Ok(Self { pixels, metrics, maps })
    }

    /// What is measured, each with its number over some pixels; those have to take part, and may be there several times.
    pub(crate) fn over(&self, members: &[usize]) -> impl Iterator<Item = (&'static Metric, Option<f64>)> {
        self.metrics.iter().zip(&self.maps).map(move |(&metric, map)| {
            let value = match (metric.rule, map) {
                _ if members.is_empty() => None,
                (Rule::Over(number), _) => number(&self.pixels, members),
                (Rule::Map(_), Some(map)) => Some(mean(map, members)),
                (Rule::Map(_), None) => None,
            };
            (metric, value.filter(|value| value.is_finite()))
        })
    }
}

fn map_of(pixels: &Pixels<'_>, metric: &Metric) -> Result<Option<Vec<f64>>, MetricError> {
    // Where no pixel takes part there is nothing to map.
    let (Rule::Map(map), true) = (metric.rule, pixels.valid.contains(&true)) else { return Ok(None) };
    let map = map(pixels)?;
    match map.as_ref().map(Vec::len) {
        Some(got) if got != pixels.valid.len() => {
            Err(MetricError::Map { id: metric.id, pixels: pixels.valid.len(), got })
        }
        _ => Ok(map),
    }
}
