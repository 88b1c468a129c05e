//! Kernel radius per pixel from the variance of the mean (Listing, line 3).

use noisefloor_frame::{Frame, Image, Variance, luminance};
use rayon::prelude::*;

use crate::{CorrectedParams, FloorUnit, Spread, recurrence::Recurrence};

/// Trace over the channels of the variance of the mean, turned into the estimate that `form` stands for on average.
#[derive(Clone)]
struct Trace<'a> {
    frame: &'a Frame,
    variance: &'a Image,
    form: Recurrence,
    /// Count and factor of the previous pixel: neighbours mostly share them.
    cached: (u32, f64),
}

impl<'a> Trace<'a> {
    fn new(frame: &'a Frame, form: Recurrence) -> Option<Self> {
        let variance = frame.color.variance.as_ref().map(Variance::mean_variance)?;
        Some(Self { frame, variance, form, cached: (0, 0.0) })
    }

    fn of_mean(&mut self, pixel: usize) -> f64 {
        let n = self.frame.samples.at(pixel);
        if n != self.cached.0 {
            self.cached = (n, self.form.expected_factor(n));
        }
        let sum: f64 = self.variance.planes().map(|plane| f64::from(plane[pixel])).sum();
        sum.max(0.0) * self.cached.1 // `max` also turns a NaN into 0
    }

    fn of_sample(&mut self, pixel: usize) -> f64 {
        self.of_mean(pixel) * f64::from(self.frame.samples.at(pixel))
    }
}

/// Listing, line 3, mended: R in [0, radius_max_px]; a NaN becomes 0. `None` if the frame carries no variance.
pub(crate) fn corrected(frame: &Frame, params: &CorrectedParams) -> Option<Vec<f32>> {
    let trace = Trace::new(frame, params.variance_form)?;
    let floor = match (params.spread, params.floor_unit) {
        (Spread::Relative, FloorUnit::Median) => {
            // All black: any positive number, as no pixel has a spread either.
            let typical = frame.color.mean.median_luminance().map_or(f64::MIN_POSITIVE, f64::from);
            params.luminance_floor * typical
        }
        _ => params.luminance_floor,
    };
    let radius = |trace: &mut Trace<'_>, pixel: usize| {
        let spread = match params.spread {
            Spread::SampleVariance => trace.of_sample(pixel),
            Spread::StdOfMean => params.pixels_per_error * trace.of_mean(pixel).sqrt(),
            Spread::Relative => {
                // The floor is positive, so the divisor is; a negative luminance counts as black.
                let level = f64::from(luminance_at(&frame.color.mean, pixel)).max(0.0) + floor;
                params.pixels_per_error * trace.of_mean(pixel).sqrt() / level
            }
        };
        (params.multiplier * spread).max(0.0).min(params.radius_max_px) as f32
    };
    // Pixels that one thread takes at least, for speed; ours.
    let pixels = (0..frame.pixels()).into_par_iter().with_min_len(4096);
    Some(pixels.map_with(trace, radius).collect())
}

fn luminance_at(mean: &Image, pixel: usize) -> f32 {
    luminance([0, 1, 2].map(|c| mean.plane(c)[pixel]))
}

/// Listing, line 3, by the letter: R = multiplier·variance of one sample, in pixels; capped, which is ours. `None` if the frame carries no variance.
pub(crate) fn as_written(frame: &Frame, multiplier: f64, cap: f64, form: Recurrence) -> Option<Vec<f32>> {
    let mut trace = Trace::new(frame, form)?;
    let radius = |pixel: usize| (multiplier * trace.of_sample(pixel)).max(0.0).min(cap) as f32;
    Some((0..frame.pixels()).map(radius).collect())
}
