//! What counts as 1 of each feature in each window.

use super::params::Planes;
use crate::engine::Tile;

/// Least unit of a feature, as a share of its range in the image: one that is all but constant in a window is not blown up.
const LEAST: f64 = 1e-3;

/// Ranges of the features over the whole image.
pub(super) fn ranges(planes: &Planes<'_>) -> Vec<f64> {
    let range = |plane: &[f32]| {
        let least = plane.iter().copied().fold(f32::INFINITY, f32::min);
        let most = plane.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        f64::from(most) - f64::from(least)
    };
    planes.features.iter().map(|plane| range(plane)).collect()
}

/// Units of one feature for the pixels of a tile, in rows of `wide` values: its range in the window, or the least; 1 where it
/// is constant.
pub(super) fn fill(
    plane: &[f32],
    (width, height): (usize, usize),
    (tile, reach): (Tile, usize),
    range: f64,
    (to, wide): (&mut [f64], usize),
) {
    let columns = tile.x.saturating_sub(reach)..(tile.x + tile.width + reach).min(width);
    let mut least = vec![0.0f32; columns.len()];
    let mut most = least.clone();
    for j in 0..tile.height {
        least.fill(f32::INFINITY);
        most.fill(f32::NEG_INFINITY);
        let y = tile.y + j;
        for row in y.saturating_sub(reach)..=(y + reach).min(height - 1) {
            let values = &plane[row * width..][columns.clone()];
            for ((least, most), value) in least.iter_mut().zip(&mut most).zip(values) {
                *least = if *value < *least { *value } else { *least };
                *most = if *value > *most { *value } else { *most };
            }
        }
        for i in 0..tile.width {
            let x = tile.x + i;
            let first = x.saturating_sub(reach) - columns.start;
            let end = (x + reach).min(width - 1) - columns.start;
            let low = least[first..=end].iter().copied().fold(f32::INFINITY, f32::min);
            let high = most[first..=end].iter().copied().fold(f32::NEG_INFINITY, f32::max);
            let unit = (f64::from(high) - f64::from(low)).max(LEAST * range);
            to[j * wide + i] = if unit > 0.0 { unit } else { 1.0 };
        }
    }
}
