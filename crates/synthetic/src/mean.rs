use noisefloor_frame::Image;
use serde::{Deserialize, Serialize};

use crate::Classes;

/// Which pattern the mean image shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ImageKind {
    /// One value everywhere.
    Constant,
    /// Four by three patches of constant values.
    Flats,
    /// Linear ramps: across in red, down in green, both in blue.
    Ramps,
    /// A vertical step edge in the middle and a disc of the other side's value in each half.
    Edges,
    /// A checkerboard, a product of sines and a brick wall, side by side.
    Texture,
    /// The four patterns above, one per quadrant: flats, ramps, edges, texture.
    Mixed,
}

/// A mean image: a pattern of values between a dark and a bright level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanImage {
    /// Pattern.
    pub kind: ImageKind,
    /// Radiance where the pattern is 0.
    pub level: f64,
    /// Radiance difference between pattern 1 and 0 in the red channel; green has 0.8 and blue 0.6 of it.
    pub contrast: f64,
    /// Period of the texture in pixels, at least 2.
    pub period: usize,
}

/// What the pattern is at one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Spot {
    /// Pattern value per channel, [0, 1].
    value: [f64; 3],
    /// Surface the pixel belongs to: its material id.
    region: u8,
    /// Class if no edge is near.
    class: u8,
}

const FLAT: u8 = 0;
const EDGE: u8 = 1;
const RAMP: u8 = 2;
const TEXTURE: u8 = 3;
const CLASS_NAMES: [&str; 4] = ["flat", "edge", "ramp", "texture"];

/// Pixels this far (in the maximum norm) from another surface are of class `edge`.
const EDGE_DISTANCE: usize = 2;

/// Contrast of each channel relative to red, so that swapped channels are noticed.
const TINT: [f64; 3] = [1.0, 0.8, 0.6];

impl MeanImage {
    /// The pattern with level 0.5, contrast 0.5 and period 8.
    #[must_use]
    pub fn of(kind: ImageKind) -> Self {
        Self { kind, level: 0.5, contrast: 0.5, period: 8 }
    }

    /// The mean of every pixel and channel, 3 channels.
    #[must_use]
    pub fn image(&self, width: usize, height: usize) -> Image {
        Image::from_fn(width, height, 3, |c, x, y| {
            let value = self.spot(x, y, width, height).value[c];
            (self.level + self.contrast * TINT[c] * value) as f32
        })
    }

    /// Index of the surface that each pixel shows, row-major.
    pub(crate) fn regions(&self, width: usize, height: usize) -> Vec<u8> {
        pixels(width, height).map(|(x, y)| self.spot(x, y, width, height).region).collect()
    }

    /// Class of each pixel: `edge` within 2 pixels of another surface, else `flat`, `ramp` or `texture`.
    #[must_use]
    pub fn classes(&self, width: usize, height: usize) -> Classes {
        let regions = self.regions(width, height);
        let of_pixel = pixels(width, height)
            .map(|(x, y)| {
                let spot = self.spot(x, y, width, height);
                let range = |v: usize, limit: usize| {
                    v.saturating_sub(EDGE_DISTANCE)..(v + EDGE_DISTANCE + 1).min(limit)
                };
                let other = range(y, height)
                    .any(|j| regions[j * width..][range(x, width)].iter().any(|&r| r != spot.region));
                if other { EDGE } else { spot.class }
            })
            .collect();
        Classes { names: CLASS_NAMES.map(str::to_owned).to_vec(), of_pixel }
    }

    fn spot(&self, x: usize, y: usize, width: usize, height: usize) -> Spot {
        match self.kind {
            ImageKind::Constant => Spot { value: [0.0; 3], region: 0, class: FLAT },
            ImageKind::Flats => flats(x, y, width, height),
            ImageKind::Ramps => ramps(x, y, width, height),
            ImageKind::Edges => edges(x, y, width, height),
            ImageKind::Texture => texture(x, y, width, self.period),
            ImageKind::Mixed => {
                // The left and upper halves are the smaller ones, but never empty unless one pixel wide.
                let split = |v: usize, size: usize| {
                    let first = size.div_ceil(2);
                    if v < first { (0, v, first) } else { (1, v - first, size - first) }
                };
                let (right, x, w) = split(x, width);
                let (below, y, h) = split(y, height);
                let spot = match (below, right) {
                    (0, 0) => flats(x, y, w, h),
                    (0, _) => ramps(x, y, w, h),
                    (_, 0) => edges(x, y, w, h),
                    _ => texture(x, y, w, self.period),
                };
                // No pattern has more than 16 surfaces.
                Spot { region: spot.region + 16 * (2 * below + right), ..spot }
            }
        }
    }
}

fn pixels(width: usize, height: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

fn flats(x: usize, y: usize, width: usize, height: usize) -> Spot {
    let patch = (y * 3 / height) * 4 + x * 4 / width;
    // Steps of 5 modulo 12 visit all patches, so that neighbours differ clearly.
    let value = ((patch * 5) % 12) as f64 / 11.0;
    Spot { value: [value; 3], region: patch as u8, class: FLAT }
}

fn ramps(x: usize, y: usize, width: usize, height: usize) -> Spot {
    let (u, v) = ((x as f64 + 0.5) / width as f64, (y as f64 + 0.5) / height as f64);
    Spot { value: [u, v, 0.5 * (u + v)], region: 0, class: RAMP }
}

fn edges(x: usize, y: usize, width: usize, height: usize) -> Spot {
    let right = 2 * x >= width;
    let centre = if right { 0.75 } else { 0.25 } * width as f64;
    let (dx, dy) = (x as f64 + 0.5 - centre, y as f64 + 0.5 - 0.5 * height as f64);
    let radius = 0.125 * (width as f64).min(2.0 * height as f64);
    let inside = dx * dx + dy * dy < radius * radius;
    let value = if right == inside { 0.0 } else { 1.0 };
    Spot { value: [value; 3], region: u8::from(right) + 2 * u8::from(inside), class: FLAT }
}

fn texture(x: usize, y: usize, width: usize, period: usize) -> Spot {
    let half = (period / 2).max(1);
    let third = (x * 3 / width) as u8;
    let value = match third {
        0 => ((x / half + y / half) % 2) as f64,
        1 => {
            let wave = |v: usize| (std::f64::consts::TAU * v as f64 / period as f64).sin();
            0.5 + 0.5 * wave(x) * wave(y)
        }
        _ => {
            // Bricks of two periods by one, every other course shifted by half a brick, joints one pixel
            // wide.
            let course = y / period;
            let along = x + (course % 2) * period;
            if y.is_multiple_of(period) || along.is_multiple_of(2 * period) { 1.0 } else { 0.25 }
        }
    };
    Spot { value: [value; 3], region: third, class: TEXTURE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn step_edge_has_the_stated_contrast() {
        let image = MeanImage { kind: ImageKind::Edges, level: 2.0, contrast: 3.0, period: 8 }.image(40, 20);
        assert_eq!((image.get(0, 19, 0), image.get(0, 20, 0)), (2.0, 5.0));
        assert!((image.get(2, 20, 0) - image.get(2, 19, 0) - 1.8).abs() < 1e-6);
        assert_eq!(
            (image.get(0, 10, 10), image.get(0, 30, 10)),
            (5.0, 2.0),
            "the discs have the other value"
        );
    }

    #[test]
    fn values_stay_between_the_levels() {
        use ImageKind::{Constant, Edges, Flats, Mixed, Ramps, Texture};
        for kind in [Constant, Flats, Ramps, Edges, Texture, Mixed] {
            for (w, h) in [(1, 1), (3, 1), (1, 5), (33, 17), (160, 120)] {
                let image = MeanImage::of(kind).image(w, h);
                assert!(image.data().iter().all(|v| (0.5..=1.0).contains(v)), "{kind:?} {w}×{h}");
                let classes = MeanImage::of(kind).classes(w, h);
                assert_eq!(classes.of_pixel.len(), w * h);
            }
        }
    }

    #[test]
    fn every_class_occurs_in_the_mixed_image() {
        let classes = MeanImage::of(ImageKind::Mixed).classes(64, 48);
        for class in 0..CLASS_NAMES.len() as u8 {
            assert!(classes.of_pixel.iter().filter(|&&c| c == class).count() > 50, "{class}");
        }
    }

    #[test]
    fn pixels_beside_the_step_are_edges_and_others_are_not() {
        let classes = MeanImage::of(ImageKind::Edges).classes(40, 20);
        let row = &classes.of_pixel[..40];
        let expected: Vec<u8> = (0..40).map(|x| if (18..22).contains(&x) { EDGE } else { FLAT }).collect();
        assert_eq!(row, expected);
    }
}
