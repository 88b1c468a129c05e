//! The filter as nested loops in `f64`, straight from the equations: the oracle of the tests.

use super::params::{JointChannel, JointParams};
use crate::KernelError;
use crate::engine::mirror;

/// [`super::filter`], one neighbour after another.
///
/// # Errors
/// As [`JointParams::check`].
pub fn filter_f64(params: &JointParams, channels: &[JointChannel<'_>]) -> Result<Vec<Vec<f64>>, KernelError> {
    params.check(channels)?;
    let (width, height, r) = (params.width, params.height, params.window_radius);
    let spatial = 2.0 * f64::from(params.spatial_sigma).powi(2);
    let range = 2.0 * f64::from(params.range_sigma).powi(2);
    let filtered = |m: &JointChannel<'_>, x: usize, y: usize| {
        let (mut sum, mut weights) = (0.0, 0.0);
        for j in y.saturating_sub(r)..(y + r + 1).min(height) {
            for i in x.saturating_sub(r)..(x + r + 1).min(width) {
                let (p, q) = (y * width + x, j * width + i);
                let mut exponent = (x.abs_diff(i).pow(2) + y.abs_diff(j).pow(2)) as f64 / spatial;
                exponent += patch_distance(params, m, (x, y), (i, j)) / range;
                for l in channels {
                    let d = f64::from(l.value[p]) - f64::from(l.value[q]);
                    exponent += d * d / (2.0 * f64::from(l.sigma).powi(2));
                }
                let w = (-exponent).exp();
                weights += w;
                sum += w * f64::from(m.value[q]);
            }
        }
        sum / weights
    };
    let plane = |m| (0..width * height).map(|p| filtered(m, p % width, p / width)).collect();
    Ok(channels.iter().map(plane).collect())
}

/// P of Eq. 4, with d of Eq. 5.
fn patch_distance(
    params: &JointParams,
    channel: &JointChannel<'_>,
    (x, y): (usize, usize),
    (i, j): (usize, usize),
) -> f64 {
    let f = params.patch_radius as isize;
    let at = |x: usize, y: usize, (dx, dy): (isize, isize)| {
        let p = mirror(y as isize + dy, params.height) * params.width + mirror(x as isize + dx, params.width);
        (f64::from(channel.value[p]), f64::from(channel.variance[p]))
    };
    let mut sum = 0.0;
    for tap in (-f..=f).flat_map(|dy| (-f..=f).map(move |dx| (dx, dy))) {
        let ((a, va), (b, vb)) = (at(x, y, tap), at(i, j, tap));
        let (difference, noise) = ((a - b).powi(2), f64::from(params.k).powi(2) * (va + vb));
        sum += if noise > 0.0 {
            ((difference - (va + va.min(vb))) / noise).min(1e4)
        } else if difference > 0.0 {
            1e4
        } else {
            0.0
        };
    }
    (sum / (2 * f + 1).pow(2) as f64).max(0.0)
}
