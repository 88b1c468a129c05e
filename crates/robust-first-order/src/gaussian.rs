//! Gaussian means.

use rayon::prelude::*;

/// Standard deviations that the taps reach; ours.
const REACH: f64 = 3.0;

/// Gaussian mean of standard deviation `sigma` pixels over what of it lies in the image; rows of `width` values.
pub(crate) fn gaussian(values: &[f64], width: usize, sigma: f64) -> Vec<f64> {
    let radius = (REACH * sigma).ceil() as usize;
    if radius == 0 {
        return values.to_vec();
    }
    let taps: Vec<f64> = (0..=radius).map(|d| (-0.5 * (d as f64 / sigma).powi(2)).exp()).collect();
    let height = values.len() / width;
    let range = |at: usize, size: usize| at.saturating_sub(radius)..(at + radius + 1).min(size);
    // The pixel's own tap is 1: no sum is 0.
    let sums = |size: usize| -> Vec<f64> {
        (0..size).map(|at| range(at, size).map(|i| taps[i.abs_diff(at)]).sum()).collect()
    };
    let (wide, tall) = (sums(width), sums(height));
    let mut across = vec![0.0; values.len()];
    across.par_chunks_mut(width).zip(values.par_chunks(width)).for_each(|(out, row)| {
        for (x, out) in out.iter_mut().enumerate() {
            *out = range(x, width).map(|i| taps[i.abs_diff(x)] * row[i]).sum::<f64>() / wide[x];
        }
    });
    let mut out = vec![0.0; values.len()];
    out.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        for j in range(y, height) {
            let tap = taps[j.abs_diff(y)];
            for (sum, value) in out.iter_mut().zip(&across[j * width..]) {
                *sum += tap * value;
            }
        }
        out.iter_mut().for_each(|sum| *sum /= tall[y]);
    });
    out
}
