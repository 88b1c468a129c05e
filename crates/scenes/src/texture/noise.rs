use glam::{Vec2, Vec3};

use crate::hash::mix;

/// 0 below `low`, 1 above `high`, smooth between; `high > low`.
#[inline]
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Integer part (rounded down) and remainder in [0, 1). Saturates beyond ±2³¹.
///
/// Not `f32::floor`: without SSE4.1, which the default target lacks, that is a function call.
#[inline]
pub fn split(x: f32) -> (i32, f32) {
    let truncated = x as i32;
    let floor = truncated.saturating_sub(i32::from(x < truncated as f32));
    // The clamp only matters where x is so large that it has no fraction left.
    (floor, (x - floor as f32).clamp(0.0, 1.0))
}

/// The values 0 to 255 in an order shuffled once and for all.
const ORDER: [u8; 256] = {
    let mut order = [0; 256];
    let mut i = 0;
    while i < 256 {
        order[i] = i as u8;
        i += 1;
    }
    while i > 1 {
        i -= 1;
        let j = (mix(i as u32) % (i as u32 + 1)) as usize;
        (order[i], order[j]) = (order[j], order[i]);
    }
    order
};

/// Evenly spaced values in (0, 1) in that order.
const VALUES: [f32; 256] = {
    let mut values = [0.0; 256];
    let mut i = 0;
    while i < 256 {
        values[i] = (ORDER[i] as f32 + 0.5) / 256.0;
        i += 1;
    }
    values
};

/// Smoothed noise in (0, 1): values on the integer lattice, blended by a cubic (after Perlin 1985).
///
/// The lattice is hashed by table, twice as fast as by arithmetic, and repeats after 256 cells; a seed moves to another
/// part of it.
#[inline]
#[must_use]
pub fn value_noise(p: Vec2, seed: u32) -> f32 {
    let place = seed.wrapping_mul(0x9e37_79b1);
    let (x, fx) = split(p.x);
    let (y, fy) = split(p.y);
    let x = (x as u32).wrapping_add(place >> 24);
    let y = (y as u32).wrapping_add(place >> 16);
    let left = u32::from(ORDER[(x & 255) as usize]).wrapping_add(y);
    let right = u32::from(ORDER[(x.wrapping_add(1) & 255) as usize]).wrapping_add(y);
    let at = |i: u32| VALUES[(i & 255) as usize];
    let (sx, sy) = (fx * fx * (3.0 - 2.0 * fx), fy * fy * (3.0 - 2.0 * fy));
    let bottom = at(left) * (1.0 - sx) + at(right) * sx;
    let top = at(left.wrapping_add(1)) * (1.0 - sx) + at(right.wrapping_add(1)) * sx;
    bottom * (1.0 - sy) + top * sy
}

/// Sum of `octaves` (at least 1) of [`value_noise`], each with twice the frequency and half the weight of the one
/// before; in (0, 1).
#[inline]
#[must_use]
pub fn fractal(p: Vec2, octaves: u32, seed: u32) -> f32 {
    let (mut sum, mut weight, mut total, mut q) = (0.0, 1.0, 0.0, p);
    for octave in 0..octaves.max(1) {
        sum += weight * value_noise(q, seed.wrapping_add(octave));
        total += weight;
        weight *= 0.5;
        // The offset keeps the octaves' lattices from lining up at the origin.
        q = q * 2.0 + Vec2::splat(0.37);
    }
    sum / total
}

/// Two colours mixed by fractal noise: plaster, terracotta, crust.
#[derive(Debug, Clone, PartialEq)]
pub struct Clouds {
    /// Lattice cells per unit of u and v in the first octave.
    pub frequency: Vec2,
    /// Octaves, 1 to 4.
    pub octaves: u32,
    /// Colour where the noise is low.
    pub a: Vec3,
    /// Colour where the noise is high.
    pub b: Vec3,
    /// Which noise.
    pub seed: u32,
}

impl Clouds {
    #[inline]
    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        // Averaging octaves crowds the values around one half; spread them again.
        let spread = 1.7 * (fractal(uv * self.frequency, self.octaves, self.seed) - 0.5) + 0.5;
        self.a.lerp(self.b, spread.clamp(0.0, 1.0))
    }
}

/// Fine lines along u: brushed metal.
#[derive(Debug, Clone, PartialEq)]
pub struct Streaks {
    /// Width of the finest line.
    pub width: f32,
    /// Length over which a line fades into another.
    pub length: f32,
    /// Darkest colour.
    pub dark: Vec3,
    /// Brightest colour.
    pub bright: Vec3,
    /// Which noise.
    pub seed: u32,
}

impl Streaks {
    #[inline]
    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        let p = Vec2::new(uv.x / self.length, uv.y / self.width);
        let fine = value_noise(p, self.seed);
        let coarse = value_noise(p * Vec2::new(0.5, 0.19), self.seed ^ 1);
        self.dark.lerp(self.bright, 0.5 * (fine + coarse))
    }
}
