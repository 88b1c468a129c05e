//! Statistics of pixels, made into an estimate.

use noisefloor_frame::{Estimate, Image, Variance};
use rayon::prelude::*;

/// Statistics of one pixel.
pub(crate) struct Sampled<const C: usize> {
    pub(crate) mean: [f64; C],
    /// Of the mean; ignored below 2 samples, like the halves.
    pub(crate) variance: [f64; C],
    pub(crate) halves: [[f64; C]; 2],
}

/// An estimate from the statistics of each pixel, rows in parallel.
pub(crate) fn estimate<const C: usize>(
    width: usize,
    height: usize,
    spp: u32,
    pixel: impl Fn(usize) -> Sampled<C> + Sync,
) -> Estimate {
    let rows: Vec<Vec<Sampled<C>>> =
        (0..height).into_par_iter().map(|y| (0..width).map(|x| pixel(y * width + x)).collect()).collect();
    let gather = |value: &dyn Fn(&Sampled<C>, usize) -> f64| {
        Image::from_fn(width, height, C, |c, x, y| value(&rows[y][x], c) as f32)
    };
    let mean = gather(&|s, c| s.mean[c]);
    if spp < 2 {
        return Estimate::from_mean(mean);
    }
    Estimate {
        mean,
        variance: Some(Variance::of_mean(gather(&|s, c| s.variance[c]))),
        halves: Some([0, 1].map(|half| gather(&|s, c| s.halves[half][c]))),
    }
}
