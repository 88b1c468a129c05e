//! The filter in the order of the paper.

use noisefloor_frame::{Estimate, Far, FeatureId, Frame, Image, UnitRange, luminance};
use rayon::prelude::*;

use super::params::{Halving, Params};

/// B3 spline: the taps of the à-trous algorithm, in each direction (Sec. 2).
const TAPS: [f32; 5] = [1.0 / 16.0, 1.0 / 4.0, 3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];
/// Mean luminance at which the width for the colour is meant; ours.
const EXPOSURE: f64 = 0.5;
/// Least albedo that is divided by; ours.
const LEAST_ALBEDO: f32 = 1e-3;

/// Filters a frame that has a normal and a depth.
pub(super) fn filter(frame: &Frame, params: &Params) -> Image {
    // The colour at one exposure, so that one width fits every frame, and without the albedo where asked for.
    let scale = exposure(&frame.color.mean);
    let albedo = params.demodulate.then(|| frame.feature(&FeatureId::Albedo)).flatten();
    let albedo = albedo.map(|albedo| albedo.mean.map(|v| v.max(LEAST_ALBEDO)));
    let mut color = frame.color.mean.map(|v| (f64::from(v) * scale) as f32);
    if let Some(albedo) = &albedo {
        color = color.zip_map(albedo, |c, a| c / a);
    }
    let edges = Edges::new(frame);

    // Level i: taps 2^i pixels apart, weights from the colour of this level, the normal and the depth (Sec. 2.2).
    for level in 0..params.levels {
        let fall = match params.halve {
            Halving::Divisor => 0.5f64,
            Halving::Sigma => 0.25,
        };
        let divisor = params.sigma_color * fall.powi(level as i32);
        let widths = Widths {
            color: (level >= params.color_from_level).then_some(divisor as f32),
            normal: (params.sigma_normal * f64::from(1u32 << level).powi(2)) as f32,
            depth: params.sigma_depth as f32,
        };
        color = pass(&color, &edges, 1 << level, &widths);
    }

    // The last, smoothest image; the details of the levels are dropped.
    if let Some(albedo) = &albedo {
        color = color.zip_map(albedo, |c, a| c * a);
    }
    color.map(|v| (f64::from(v) / scale) as f32)
}

/// What brings the mean luminance to [`EXPOSURE`]; 1 for a black frame.
fn exposure(color: &Image) -> f64 {
    let pixel = |p: usize| f64::from(luminance([0, 1, 2].map(|c| color.plane(c)[p])));
    let mean = (0..color.pixels()).map(pixel).sum::<f64>() / color.pixels() as f64; // an image is never empty
    if mean > 0.0 && mean.is_finite() { EXPOSURE / mean } else { 1.0 }
}

/// What squared differences are divided by at one level.
struct Widths {
    color: Option<f32>,
    normal: f32,
    depth: f32,
}

/// Normals, and depth in place of the paper's positions, in units of its 99th percentile.
struct Edges {
    normal: Image,
    depth: Image,
    background: Vec<bool>,
}

impl Edges {
    fn new(frame: &Frame) -> Self {
        let image = |id: FeatureId, channels: usize| match frame.feature(&id) {
            Some(Estimate { mean, .. }) if mean.channels() == channels => mean.clone(),
            _ => Image::new(frame.width(), frame.height(), channels),
        };
        let (normal, depth) = (image(FeatureId::Normal, 3), image(FeatureId::Depth, 1));
        let nowhere = |p: usize| !(depth.data()[p] > 0.0 && depth.data()[p].is_finite());
        let background = (0..depth.pixels()).map(nowhere).collect();
        let unit = UnitRange::of(&FeatureId::Depth, &depth, Far::Common);
        let depth = unit.apply(&Estimate::from_mean(depth)).mean;
        Self { normal, depth, background }
    }

    /// Exponent of both weights; none where one of the two pixels alone is background.
    fn distance(&self, p: usize, q: usize, widths: &Widths) -> Option<f32> {
        match (self.background[p], self.background[q]) {
            (true, true) => return Some(0.0),
            (false, false) => {}
            _ => return None,
        }
        let normal: f32 = self.normal.planes().map(|n| (n[p] - n[q]).powi(2)).sum();
        let depth = (self.depth.data()[p] - self.depth.data()[q]).powi(2);
        Some(normal / widths.normal + depth / widths.depth)
    }
}

/// c_{i+1}(p) = Σ h·w·c_i(q) / Σ h·w over 5×5 taps `gap` pixels apart, clipped at the border.
fn pass(color: &Image, edges: &Edges, gap: usize, widths: &Widths) -> Image {
    let (width, height) = (color.width(), color.height());
    let planes = [0, 1, 2].map(|c| color.plane(c));
    let mut rows: Vec<Vec<[f32; 3]>> = Vec::new();
    (0..height)
        .into_par_iter()
        .map(|y| {
            let pixel = |x: usize| {
                let p = y * width + x;
                let (mut sum, mut weights) = ([0.0f32; 3], 0.0f32);
                for (j, tap_y) in TAPS.iter().enumerate() {
                    let Some(row) = (y + j * gap).checked_sub(2 * gap).filter(|row| *row < height) else { continue };
                    for (i, tap_x) in TAPS.iter().enumerate() {
                        let column = (x + i * gap).checked_sub(2 * gap).filter(|column| *column < width);
                        let Some(column) = column else { continue };
                        let q = row * width + column;
                        let Some(mut distance) = edges.distance(p, q, widths) else { continue };
                        if let Some(divisor) = widths.color {
                            distance += planes.iter().map(|c| (c[p] - c[q]).powi(2)).sum::<f32>() / divisor;
                        }
                        let weight = tap_x * tap_y * (-distance).exp();
                        sum.iter_mut().zip(planes).for_each(|(sum, c)| *sum += weight * c[q]);
                        weights += weight;
                    }
                }
                // The pixel itself has a weight of 9/64.
                sum.map(|v| v / weights)
            };
            (0..width).map(pixel).collect()
        })
        .collect_into_vec(&mut rows);
    Image::from_fn(width, height, 3, |c, x, y| rows[y][x][c])
}

/// One level without edges, for tests of the plain transform.
#[cfg(test)]
pub(super) fn plain(color: &Image, level: usize) -> Image {
    let nowhere = Edges {
        normal: Image::new(color.width(), color.height(), 3),
        depth: Image::new(color.width(), color.height(), 1),
        background: vec![true; color.pixels()],
    };
    pass(color, &nowhere, 1 << level, &Widths { color: None, normal: 1.0, depth: 1.0 })
}
