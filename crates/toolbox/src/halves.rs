//! Half buffers: two images of the same picture from disjoint samples, whose difference tells the noise of their mean.

use noisefloor_frame::{Image, Samples};
use rayon::prelude::*;

use crate::box_mean;

/// Radius of the box over which the two variances are compared, pixels: 21×21 (rousselle2013rdfc, Sec. 4).
const BOX_RADIUS: usize = 10;
/// Guards the ratio of both box means against 0/0 where nothing is noisy.
const GUARD: f64 = 1e-10;
/// Outer taps of the smoothing of squared half differences: a Gaussian of standard deviation 0.5 pixels, its middle 1.
const TAP: f64 = 0.1353;

/// How much of a pixel's mean comes from half A, and the factor of (A−B)² that makes it the variance of the mean.
#[derive(Debug, Clone, Copy)]
pub struct Shares {
    /// n_A/n.
    pub a: f64,
    /// n_A·n_B/n².
    pub square: f64,
}

/// Shares of pixel `p`: n_A/n and n_A·n_B/n², 1/2 and 1/4 for equal halves.
#[must_use]
pub fn shares(samples: &Samples, p: usize) -> Shares {
    let (a, b) = samples.halves_at(p);
    let (a, b) = (f64::from(a), f64::from(b));
    let n = a + b;
    if n == 0.0 {
        // A pixel without samples: both halves are whatever they are.
        return Shares { a: 0.5, square: 0.25 };
    }
    Shares { a: a / n, square: a * b / (n * n) }
}

/// Mean of both halves, weighted by their samples.
#[must_use]
pub fn mean_of_halves(halves: &[Image; 2], samples: &Samples) -> Image {
    let [a, b] = halves;
    let mut out = a.clone();
    for c in 0..a.channels() {
        let plane = out.plane_mut(c);
        for (p, (value, (a, b))) in plane.iter_mut().zip(a.plane(c).iter().zip(b.plane(c))).enumerate() {
            let share = shares(samples, p).a;
            *value = (share * f64::from(*a) + (1.0 - share) * f64::from(*b)) as f32;
        }
    }
    out
}

/// Variance of the mean in one channel from one squared difference of the halves: right on average, as noisy as one sample.
#[must_use]
pub fn half_variance(halves: &[Image; 2], samples: &Samples, channel: usize) -> Vec<f64> {
    let (a, b) = (halves[0].plane(channel), halves[1].plane(channel));
    let square = |p: usize| {
        let d = f64::from(a[p]) - f64::from(b[p]);
        shares(samples, p).square * d * d
    };
    (0..a.len()).into_par_iter().map(square).collect()
}

/// Sample variance of the mean scaled to the level of the two-buffer variance, per channel: the first has the
/// structure, the second the right level under low-discrepancy sampling (rousselle2013rdfc, Sec. 4). At least 0 and at most `most`;
/// NaN where the sample variance is, which takes no part in the level of others.
#[must_use]
pub fn scaled_sample_variance(variance: &Image, halves: &[Image; 2], samples: &Samples, most: f32) -> Image {
    let (width, height, channels) = (variance.width(), variance.height(), variance.channels());
    let mut out = Image::new(width, height, channels);
    for c in 0..channels {
        let two = box_mean(&half_variance(halves, samples, c), width, BOX_RADIUS);
        let plane: Vec<f64> = variance.plane(c).iter().copied().map(f64::from).collect();
        let sample = mean_of_known(&plane, width);
        for (p, value) in out.plane_mut(c).iter_mut().enumerate() {
            let scaled = plane[p] * two[p] / (GUARD + sample[p]);
            *value = scaled.clamp(0.0, f64::from(most)) as f32;
        }
    }
    out
}

/// Means over the boxes around pixels of what is a number there; any number for a box without one.
fn mean_of_known(plane: &[f64], width: usize) -> Vec<f64> {
    if !plane.iter().any(|v| v.is_nan()) {
        return box_mean(plane, width, BOX_RADIUS);
    }
    let known: Vec<f64> = plane.iter().map(|v| if v.is_nan() { 0.0 } else { 1.0 }).collect();
    let values: Vec<f64> = plane.iter().map(|v| if v.is_nan() { 0.0 } else { *v }).collect();
    let means = box_mean(&values, width, BOX_RADIUS).into_iter().zip(box_mean(&known, width, BOX_RADIUS));
    // The least share of a box is that of one pixel.
    let least = 0.5 / ((2 * BOX_RADIUS + 1) * (2 * BOX_RADIUS + 1)) as f64;
    means.map(|(mean, share)| mean / share.max(least)).collect()
}

/// Two-buffer variance of the mean, smoothed over 3×3 pixels with a Gaussian of standard deviation 0.5 pixels, clipped
/// at the border: the residual variance of something filtered (rousselle2013rdfc, Sec. 5). At most `most`.
#[must_use]
pub fn smoothed_half_variance(halves: &[Image; 2], samples: &Samples, most: f32) -> Image {
    let (width, height, channels) = (halves[0].width(), halves[0].height(), halves[0].channels());
    let mut out = Image::new(width, height, channels);
    for c in 0..channels {
        let raw = half_variance(halves, samples, c);
        let mut rows = vec![0.0; raw.len()];
        rows.par_chunks_mut(width).zip(raw.par_chunks(width)).for_each(|(out, row)| {
            for (x, value) in out.iter_mut().enumerate() {
                let left = x.checked_sub(1).map(|i| row[i]);
                *value = three(left, row[x], row.get(x + 1).copied());
            }
        });
        let plane = out.plane_mut(c);
        plane.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
            for (x, value) in out.iter_mut().enumerate() {
                let p = y * width + x;
                let above = y.checked_sub(1).map(|_| rows[p - width]);
                let below = rows.get(p + width).copied();
                *value = three(above, rows[p], below).min(f64::from(most)) as f32;
            }
        });
    }
    out
}

/// Weighted mean of a value and those beside it, as far as they exist.
fn three(before: Option<f64>, middle: f64, after: Option<f64>) -> f64 {
    let (mut sum, mut weight) = (middle, 1.0);
    for beside in [before, after].into_iter().flatten() {
        sum += TAP * beside;
        weight += TAP;
    }
    sum / weight
}
