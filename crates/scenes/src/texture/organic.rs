use glam::{Vec2, Vec3};

use super::noise::{fractal, smoothstep, split, value_noise};
use crate::hash::{lattice, unit};

/// Leaves with veins. The integer part of u numbers the leaf and picks its colour; its fraction runs across the
/// blade, v from 0 at the stalk to 1 at the tip.
#[derive(Debug, Clone, PartialEq)]
pub struct Leaf {
    /// Colours between which each leaf lies.
    pub colors: [Vec3; 2],
    /// Colour of veins.
    pub vein: Vec3,
    /// Which leaves.
    pub seed: u32,
}

impl Leaf {
    #[inline]
    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        let (index, x) = split(uv.x);
        let blade = self.colors[0].lerp(self.colors[1], unit(lattice(index, 0, self.seed)));
        let side = (x - 0.5).abs();
        // Side veins leave the midrib at an angle.
        let (_, phase) = split(7.0 * (uv.y - 0.9 * side));
        let rib = 1.0 - smoothstep(0.02, 0.06, side);
        let vein = 0.6 * (1.0 - smoothstep(0.0, 0.18, phase.min(1.0 - phase)));
        (blade * (1.0 - 0.3 * side)).lerp(self.vein, rib.max(vein))
    }
}

/// A slice of toast; the slice fills [−1, 1]² of the texture coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Bread {
    /// Crumb in the middle of the slice.
    pub crumb: Vec3,
    /// Where it was toasted.
    pub toasted: Vec3,
    /// Rim.
    pub crust: Vec3,
    /// Which slice.
    pub seed: u32,
}

impl Bread {
    #[inline]
    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        let patches = fractal(uv * 2.5, 2, self.seed);
        let pores = value_noise(uv * 17.0, self.seed ^ 9);
        // Near the rim of a square with round corners the slice is darker.
        let q = uv * uv;
        let rim = q.x * q.x + q.y * q.y + 0.3 * (patches - 0.5);
        let toasted = (0.2 + 0.7 * patches + 0.5 * smoothstep(0.2, 1.0, rim)).min(1.0);
        let face = self.crumb.lerp(self.toasted, toasted).lerp(self.crust, smoothstep(0.85, 1.0, rim));
        face * (1.0 - 0.45 * smoothstep(0.66, 0.8, pores))
    }
}
