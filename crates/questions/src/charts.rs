//! Axes and points as several questions draw them.

use noisefloor_study::exhibit::{Axis, Point, Scale};
use noisefloor_study::summary::Interval;

/// Samples per pixel, from left to right.
pub(crate) fn levels_axis(levels: &[u32]) -> Axis {
    Axis {
        title: "samples per pixel".into(),
        scale: Scale::Levels,
        values: levels.iter().map(|&spp| f64::from(spp)).collect(),
    }
}

/// A logarithmic axis as long as these values ask for; those that a logarithm has no place for ask for nothing.
pub(crate) fn log_axis(title: impl Into<String>, values: impl IntoIterator<Item = f64>) -> Axis {
    let values = values.into_iter().filter(|v| *v > 0.0 && v.is_finite()).collect();
    Axis { title: title.into(), scale: Scale::Log, values }
}

/// The values that a logarithmic axis must cover for these points. A lower end near zero would stretch it over empty
/// decades: at most a factor of 4 below the points.
pub(crate) fn heights<'a>(points: impl Iterator<Item = &'a Point> + Clone) -> (Vec<f64>, f64) {
    let least = points.clone().map(|p| p.y).fold(f64::INFINITY, f64::min) / 4.0;
    let ends = points.flat_map(|p| [Some(p.y), p.high, p.low]).flatten();
    (ends.filter(|v| *v >= least).collect(), least)
}

/// The point of an interval on a logarithmic axis, or nothing where that has no place for it. An estimate below its floor
/// is drawn as its limit.
pub(crate) fn point(x: f64, interval: &Interval, about: String) -> Option<Point> {
    let y = interval.below.unwrap_or(interval.value);
    (y > 0.0 && y.is_finite() && x.is_finite()).then(|| Point {
        x,
        y,
        low: interval.low,
        high: interval.high,
        limit: interval.below.is_some(),
        about,
        ..Point::default()
    })
}

/// Levels in ascending order, once each.
pub(crate) fn distinct(levels: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut levels: Vec<u32> = levels.collect();
    levels.sort_unstable();
    levels.dedup();
    levels
}

/// Numbers in ascending order, once each.
pub(crate) fn distinct_values(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lower_end_near_zero_does_not_stretch_the_axis() {
        let point = |y: f64, low: f64| Point { y, low: Some(low), ..Point::default() };
        let points = [point(1.0, 1e-9), point(0.5, 0.2)];
        assert_eq!(heights(points.iter()).0, [1.0, 0.5, 0.2]);
    }

    #[test]
    fn a_logarithm_has_no_place_for_zero() {
        assert_eq!(log_axis("x", [0.0, 2.0, f64::NAN, -1.0, f64::INFINITY]).values, [2.0]);
    }
}
