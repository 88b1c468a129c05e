//! Sampling an environment map in proportion to its luminance and solid angle.

use std::f32::consts::{FRAC_1_PI, PI, TAU};
use std::sync::Arc;

use glam::Vec3A;
use noisefloor_scenes::EnvironmentMap;

use crate::math::{luminance, turn};

/// An environment map with the running sums that sampling needs.
#[derive(Debug, Clone)]
pub struct Environment {
    map: Arc<EnvironmentMap>,
    /// Running share of the rows; the last is 1.
    rows: Vec<f32>,
    /// Per row, running share of its columns; the last is 1.
    columns: Vec<f32>,
    /// Density per solid angle of each texel.
    densities: Vec<f32>,
    /// Mean luminance over the sphere.
    mean: f32,
}

/// Running shares of non-negative weights, whose sum is returned. Without weight every entry is equally likely.
fn running(weights: impl Iterator<Item = f64> + Clone) -> (Vec<f32>, f64) {
    let (count, total) = (weights.clone().count(), weights.clone().sum::<f64>());
    let mut sum = 0.0;
    let mut shares: Vec<f32> = weights
        .map(|w| {
            sum += if total > 0.0 { w / total } else { 1.0 / count as f64 };
            sum as f32
        })
        .collect();
    // From the last entry with weight on: rounding must leave no gap below 1.
    if let Some(last) = shares.last().copied() {
        shares.iter_mut().filter(|s| **s == last).for_each(|s| *s = 1.0);
    }
    (shares, total)
}

/// The entry that a number in [0, 1) falls into, and where in it, in [0, 1).
#[inline]
fn pick(shares: &[f32], u: f32) -> (usize, f32) {
    let index = shares.partition_point(|&share| share <= u).min(shares.len() - 1);
    let low = if index == 0 { 0.0 } else { shares[index - 1] };
    let width = shares[index] - low; // positive: equal neighbours are never found
    (index, ((u - low) / width.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0 - f32::EPSILON))
}

impl Environment {
    /// From a map that was checked.
    pub fn new(map: Arc<EnvironmentMap>) -> Self {
        let (width, height) = (map.width, map.height);
        // Solid angle of a texel of each row: the difference of cosines, written without cancellation.
        let step = std::f64::consts::PI / height as f64;
        let angle = |row: usize| {
            let middle = (row as f64 + 0.5) * step;
            2.0 * (0.5 * step).sin() * middle.sin() * std::f64::consts::TAU / width as f64
        };
        let weight = |row: usize, column: usize| {
            f64::from(luminance(map.texels[row * width + column].into())).max(0.0)
        };
        let mut columns = Vec::with_capacity(width * height);
        let mut row_weights = Vec::with_capacity(height);
        for row in 0..height {
            let (shares, total) = running((0..width).map(|column| weight(row, column)));
            columns.extend(shares);
            row_weights.push(total * angle(row));
        }
        let (rows, total) = running(row_weights.iter().copied());
        let densities = (0..width * height)
            .map(|at| if total > 0.0 { (weight(at / width, at % width) / total) as f32 } else { 0.0 })
            .collect();
        let mean = (total / (4.0 * std::f64::consts::PI)) as f32;
        Self { map, rows, columns, densities, mean }
    }

    /// Mean luminance over all directions.
    pub fn mean_luminance(&self) -> f32 {
        self.mean
    }

    /// The texel seen along the unit vector `w`.
    #[inline]
    fn texel(&self, w: Vec3A) -> usize {
        let (width, height) = (self.map.width, self.map.height);
        let v = w.y.clamp(-1.0, 1.0).acos() * FRAC_1_PI;
        // 0 at −Z, growing towards +X; shifted so that −Z is the middle. Casts saturate.
        let u = w.x.atan2(-w.z) * (1.0 / TAU) + 0.5;
        let column = ((u * width as f32) as usize).min(width - 1);
        let row = ((v * height as f32) as usize).min(height - 1);
        row * width + column
    }

    /// Radiance along `w`, and the density with which [`Environment::sample`] gives it.
    #[inline]
    pub fn look(&self, w: Vec3A) -> (Vec3A, f32) {
        let at = self.texel(w);
        (self.map.texels[at].into(), self.densities[at])
    }

    /// A direction, its radiance, and its density per solid angle.
    #[inline]
    pub fn sample(&self, u: f32, v: f32) -> (Vec3A, Vec3A, f32) {
        let (width, height) = (self.map.width, self.map.height);
        let (row, down) = pick(&self.rows, v);
        let (column, along) = pick(&self.columns[row * width..(row + 1) * width], u);
        // Uniform in the cosine, as the solid angle is.
        let edge = |row: usize| (PI * row as f32 / height as f32).cos();
        let (top, bottom) = (edge(row), edge(row + 1));
        let y = (top + (bottom - top) * down).clamp(-1.0, 1.0);
        let sin = (1.0 - y * y).max(0.0).sqrt();
        let (s, c) = turn((column as f32 + along) / width as f32);
        // The angle is counted from the left edge, which looks along +Z.
        let w = Vec3A::new(-s * sin, y, c * sin);
        let at = row * width + column;
        (w, self.map.texels[at].into(), self.densities[at])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::{Independent, Sampler};
    use glam::Vec3;

    fn uniforms(n: u32) -> impl Iterator<Item = (f32, f32)> {
        (0..n).map(|k| Independent::new(5, k).group(0)).map(|u| (u[0], u[1]))
    }

    fn spotted() -> Environment {
        let (width, height) = (16, 8);
        let mut texels: Vec<Vec3> =
            (0..width * height).map(|i| Vec3::new(0.1, 0.2, 0.05) * (i % 5) as f32).collect();
        texels[2 * width + 11] = Vec3::new(50.0, 40.0, 30.0);
        Environment::new(Arc::new(EnvironmentMap { width, height, texels }))
    }

    #[test]
    fn sampled_directions_look_at_their_texel() {
        let sky = spotted();
        for (u, v) in uniforms(20_000) {
            let (w, radiance, density) = sky.sample(u, v);
            assert!((w.length() - 1.0).abs() < 1e-5);
            // Directions on the edge of a texel may round to its neighbour.
            let inside = |x: f32| (x - x.round()).abs() > 1e-3;
            let (column, row) = ((w.x.atan2(-w.z) / TAU + 0.5) * 16.0, w.y.acos() * FRAC_1_PI * 8.0);
            if inside(column) && inside(row) {
                assert_eq!(sky.look(w), (radiance, density), "{w}");
            }
            assert!(density > 0.0, "black texels are never chosen");
        }
    }

    #[test]
    fn the_density_integrates_to_one_and_the_estimate_is_exact() {
        let sky = spotted();
        // Uniform directions: the mean of the density is 1/4π.
        let (mut sum, mut squares, n) = (0.0f64, 0.0f64, 400_000u32);
        for (u, v) in uniforms(n) {
            let y = 1.0 - 2.0 * u;
            let (s, c) = turn(v);
            let sin = (1.0 - y * y).max(0.0).sqrt();
            let value = f64::from(sky.look(Vec3A::new(s * sin, y, c * sin)).1) * 4.0 * std::f64::consts::PI;
            sum += value;
            squares += value * value;
        }
        let mean = sum / f64::from(n);
        let error = ((squares / f64::from(n) - mean * mean) / f64::from(n)).sqrt();
        assert!(error < 0.02 && (mean - 1.0).abs() < 4.5 * error, "{mean} ± {error}");
        // Luminance over density is the same for every sample: four pi times the mean.
        for (u, v) in uniforms(1000) {
            let (_, radiance, density) = sky.sample(u, v);
            let whole = 4.0 * PI * sky.mean_luminance();
            assert!((luminance(radiance) / density - whole).abs() < 1e-4 * whole);
        }
    }

    #[test]
    fn a_black_map_and_a_single_texel_are_defined() {
        let map = |texels: Vec<Vec3>| {
            Environment::new(Arc::new(EnvironmentMap { width: texels.len(), height: 1, texels }))
        };
        let black = map(vec![Vec3::ZERO; 3]);
        assert_eq!(black.mean_luminance(), 0.0);
        assert_eq!(black.sample(0.5, 0.5).2, 0.0);
        let white = map(vec![Vec3::ONE]);
        assert!((white.sample(0.3, 0.8).2 - 1.0 / (4.0 * PI)).abs() < 1e-6);
    }
}
