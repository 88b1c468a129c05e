//! Does the stated variance agree with the halves?

use crate::{Estimate, Finding, FindingKind, Image, Moments, Samples, Variance};

use super::fidelity::Fidelity;
use super::precision::Precision;

/// Pixels below which the comparison says nothing.
const LEAST_PIXELS: u64 = 64;
/// Standard errors by which the mean ratio must differ from 1.
const LEAST_ERRORS: f64 = 5.0;
/// Relative disagreement that is never told: rounding.
const LEAST_RATIO: f64 = 0.005;
/// Factor that is not told where the halves' samples were weighted or their numbers follow what was seen.
const LEAST_FACTOR: f64 = 1.5;
/// Share of a pixel's variance that rounding of its buffers may make up.
const ROUNDING: f64 = 1e-3;
/// Fewest blocks whose spread is believed.
const LEAST_BLOCKS: usize = 16;

/// Compares the variance that a file states with what its half buffers show.
///
/// Programs write sample variance, variance of the mean or sums of squares under one name; the half buffers have no such
/// ambiguity. The statistic is the mean over pixels of (two-buffer variance / stated variance), both summed over the
/// channels. For independent samples the order within a pixel is arbitrary, and over all orders the two-buffer variance
/// (A−B)²·n_A·n_B/n² averages to s²/n exactly, which does not depend on the order: so the expected ratio is 1 for
/// every pixel and every distribution, and a firefly counts no more than any other pixel.
///
/// The standard error is the largest of three: from the spread over pixels, over blocks of pixels (a film filter
/// correlates neighbours), and that of normal samples, √(2(n−2)/(n+1)/N), because the first two are too small where
/// few pixels happen to lie close together. A mean more than 5 of them away from 1 is told. With `exact` unset
/// (weighted samples, or numbers of samples that follow what was seen) the expectation is only roughly 1, and factors
/// below 1.5 are not told.
///
/// `None` also if there is nothing to compare: no variance, no halves, fewer than 2 samples, or fewer than 64 pixels
/// with finite values and a variance that is positive and not made of rounding errors.
pub(super) fn against_halves(
    subject: &str,
    estimate: &Estimate,
    samples: &Samples,
    exact: bool,
) -> Option<Finding> {
    let n = samples.total().mean();
    let shown = two_buffer(estimate, samples).filter(|_| samples.total().least() >= 2)?;
    let stated = estimate.variance.as_ref()?.mean_variance();
    let halves = estimate.halves.as_ref()?;
    let rounded = Precision::of(halves[0].data()).coarser(Precision::of(halves[1].data()));
    let step = rounded.relative().max(0.5f64.powi(20));
    let least = Precision::of(stated.data()).absolute() * stated.channels() as f64 / ROUNDING;
    let sum = |image: &Image, pixel: usize| -> f64 { image.planes().map(|p| f64::from(p[pixel])).sum() };
    let width = stated.width();
    let side = if width.min(stated.height()) >= 256 { 32 } else { 8 };
    let columns = width.div_ceil(side);
    let mut blocks = vec![(0.0, 0u32); columns * stated.height().div_ceil(side)];
    let mut ratios = Moments::<1>::default();
    for pixel in 0..stated.pixels() {
        let known = stated.planes().all(|plane| plane[pixel] >= 0.0);
        let (variance, two_buffer) = (sum(stated, pixel), sum(&shown, pixel));
        // Rounding two values to multiples of 2·step·|x| adds (2·step·x)²/12 each.
        let (a, b) = samples.halves_at(pixel);
        let weight = f64::from(a) * f64::from(b) / (f64::from(a) + f64::from(b)).powi(2);
        let square: f64 = estimate.mean.planes().map(|p| f64::from(p[pixel]).powi(2)).sum();
        let rounding = (square * step.powi(2) + 3.0 * rounded.absolute().powi(2)) * 2.0 / 3.0 * weight;
        let usable = known && variance > least && rounding <= ROUNDING * variance;
        if usable && (two_buffer / variance).is_finite() {
            let ratio = two_buffer / variance;
            ratios.push([ratio]);
            let block = &mut blocks[pixel / width / side * columns + pixel % width / side];
            *block = (block.0 + ratio, block.1 + 1);
        }
    }
    let count = ratios.count();
    let [spread] = ratios.sample_variance().filter(|_| count >= LEAST_PIXELS)?;
    let [mean] = ratios.mean();
    blocks.retain(|(_, pixels)| *pixels > 0);
    let of_blocks: f64 = blocks.iter().map(|(sum, k)| (sum - f64::from(*k) * mean).powi(2)).sum();
    let of_blocks = if blocks.len() >= LEAST_BLOCKS { of_blocks / (count as f64).powi(2) } else { 0.0 };
    let of_normal = 2.0 * (n - 2.0) / (n + 1.0) / count as f64; // at least LEAST_PIXELS
    let error = (spread / count as f64).max(of_blocks).max(of_normal).sqrt();
    let factor = mean.max(1.0 / mean);
    let told =
        (mean - 1.0).abs() > (LEAST_ERRORS * error).max(LEAST_RATIO) && (exact || factor > LEAST_FACTOR);
    if !told {
        return None;
    }
    let text = format!("{}{}", words(mean, n), guess(mean, n));
    let found = Finding::new(FindingKind::VarianceAgainstHalves, subject, text);
    // n = 2 has no spread at all: the ratio of each pixel is exactly 1.
    Some(found.with_value(1.0 / mean).with_standard_errors((1.0 - mean) / error.max(1e-3 * LEAST_RATIO)))
}

fn words(mean: f64, n: f64) -> String {
    if mean <= 0.0 {
        return "the half buffers show no noise at all where a variance is stated".into();
    }
    let ratio = 1.0 / mean;
    let times = if ratio >= 1.0 { format!("{ratio:.2} times") } else { format!("1/{mean:.2} of") };
    let n = (n * 100.0).round() / 100.0;
    format!("the stated variance is {times} what the half buffers show, at {n} samples per pixel")
}

/// What looks lost, where the ratio is nearer to n or 1/n than to 1.
fn guess(mean: f64, n: f64) -> &'static str {
    match mean.max(f64::MIN_POSITIVE).ln() / n.ln() {
        _ if mean <= 0.0 => "",
        power if (-1.5..-0.5).contains(&power) => ": it may be the variance of one sample, not of the mean",
        power if (0.5..1.5).contains(&power) => ": it may have been divided by the sample count twice",
        _ => "",
    }
}

/// Pixels with a channel of zero variance in which the halves differ.
pub(super) fn zero(
    subject: &str,
    estimate: &Estimate,
    samples: &Samples,
    fidelity: Fidelity,
) -> Option<Finding> {
    let stated = estimate.variance.as_ref()?.mean_variance();
    let [a, b] = estimate.halves.as_ref()?;
    let shown = two_buffer(estimate, samples).filter(|_| fidelity == Fidelity::Rounded)?;
    let precision = Precision::of(a.data()).coarser(Precision::of(b.data()));
    let relative = 4.0 * precision.relative() + 1e-5;
    let mut pixels = vec![false; stated.pixels()];
    for c in 0..stated.channels() {
        let (v, a, b, shown) = (stated.plane(c), a.plane(c), b.plane(c), shown.plane(c));
        for p in (0..pixels.len()).filter(|&p| v[p] == 0.0 && shown[p].is_finite()) {
            let size = f64::from(a[p].abs().max(b[p].abs()));
            let differ = f64::from((a[p] - b[p]).abs()) > relative * size + 4.0 * precision.absolute();
            // Smaller squares have no place in a float.
            pixels[p] |= differ && shown[p] > f32::MIN_POSITIVE;
        }
    }
    let count = pixels.iter().filter(|&&p| p).count();
    if count == 0 {
        return None;
    }
    let half = Precision::of(stated.data()).is_half() && stated.data().iter().any(|&v| v > 0.0);
    let why = if half { "; small ones may have vanished in half precision" } else { "" };
    let text = format!("{count} pixels state a variance of zero although their halves differ{why}");
    Some(Finding::new(FindingKind::ZeroVariance, subject, text).with_value(count as f64))
}

fn two_buffer(estimate: &Estimate, samples: &Samples) -> Option<Image> {
    Some(Variance::from_halves(estimate.halves.as_ref()?, samples).ok()?.into_mean_variance())
}
