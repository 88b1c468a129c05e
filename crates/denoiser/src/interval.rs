use std::collections::BTreeMap;

use noisefloor_frame::{Counts, Frame, Image, Samples, Variance};
use noisefloor_stats::{Level, Observed, SampleCounts, SamplePlanes, TTable};

/// What families of intervals ask of a frame's colour; `None` without a variance. All pixels take part.
#[must_use]
pub fn sample_planes(frame: &Frame) -> Option<SamplePlanes<'_>> {
    let counts = match frame.samples.total() {
        Counts::Uniform(n) => SampleCounts::Uniform(*n),
        Counts::PerPixel(map) => SampleCounts::PerPixel(map),
    };
    let variance = frame.color.variance.as_ref().map(Variance::mean_variance)?.data();
    let mean = frame.color.mean.data();
    Some(SamplePlanes {
        observed: Observed { mean, variance, counts, pixels: frame.pixels(), valid: None },
        width: frame.width(),
        third_moment: frame.optional.third_moment().map(Image::data),
        least: frame.optional.least().map(Image::data),
        greatest: frame.optional.greatest().map(Image::data),
    })
}

/// Half-width t·s/√n of the confidence interval of each pixel's mean, per channel, at `level`.
///
/// `variance` is the variance of the mean, s²/n, row by row as many pixels as `samples` describes; t has the pixel's n−1
/// degrees of freedom. A pixel with fewer than 2 samples has no interval: its half-width is infinite. Negative variances count
/// as 0.
#[must_use]
pub fn half_widths(variance: &Image, samples: &Samples, level: Level) -> Image {
    into_half_widths(variance.clone(), samples, level)
}

/// [`half_widths`] in the place of the variance.
#[must_use]
pub fn into_half_widths(variance: Image, samples: &Samples, level: Level) -> Image {
    let table = TTable::new(level, 2);
    let half_width = |t: f64, variance: f32| (t * f64::from(variance.max(0.0)).sqrt()) as f32;
    let mut out = variance;
    if let Some(n) = samples.total().uniform().filter(|&n| n >= 2) {
        // The usual case, in a loop without decisions.
        let t = table.at(n);
        out.data_mut().iter_mut().for_each(|value| *value = half_width(t, *value));
        return out;
    }
    // Few different counts occur, and computing a critical value costs far more than finding it again.
    let mut known = BTreeMap::new();
    let mut last = (0, f64::INFINITY);
    for plane in out.planes_mut() {
        for (pixel, value) in plane.iter_mut().enumerate() {
            let n = samples.at(pixel);
            if n != last.0 {
                last = (n, *known.entry(n).or_insert_with(|| table.at(n)));
            }
            *value = if n < 2 { f32::INFINITY } else { half_width(last.1, *value) };
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_width_is_t_times_the_standard_error_at_each_pixels_count() {
        let counts = vec![1, 2, 4, 16, 64, 4, 20_000];
        let variance = Image::filled(7, 1, 1, 0.25);
        let widths = half_widths(&variance, &Samples::per_pixel(counts), Level::TWO_SIDED_998);
        let t = [318.3088, 10.2145, 3.7328, 3.2247, 10.2145, 3.0902];
        assert_eq!(widths.data()[0], f32::INFINITY);
        for (width, t) in widths.data()[1..].iter().zip(t) {
            assert!((width / 0.5 - t).abs() < 1e-4 * t, "{width} for t = {t}");
        }
    }

    #[test]
    fn zero_and_negative_variance_have_zero_width_if_there_is_an_interval() {
        let variance = Image::from_vec(2, 1, 1, vec![0.0, -1.0]).unwrap();
        let widths = |n| half_widths(&variance, &Samples::uniform(n), Level::TWO_SIDED_99);
        assert_eq!(widths(2).data(), [0.0, 0.0]);
        assert_eq!(widths(1).data(), [f32::INFINITY, f32::INFINITY]);
    }
}
