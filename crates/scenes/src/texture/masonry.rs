use glam::{Vec2, Vec3};

use super::noise::{smoothstep, split, value_noise};
use crate::hash::{lattice, mix, unit};

/// Running bond: every other course is shifted by half a brick.
#[derive(Debug, Clone, PartialEq)]
pub struct Bricks {
    /// Width and height of a brick with its joint.
    pub size: Vec2,
    /// Width of the joints.
    pub joint: f32,
    /// Colours between which each brick lies.
    pub colors: [Vec3; 2],
    /// Colour of the joints.
    pub mortar: Vec3,
    /// Which bricks.
    pub seed: u32,
}

impl Bricks {
    #[inline]
    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        let per = self.size.recip();
        // A joint is never quite straight.
        let wobble = (value_noise(uv * (5.0 * per.y), self.seed) - 0.5) * self.joint * 0.8;
        let (row, y) = split((uv.y + wobble) * per.y);
        let (column, x) = split((uv.x + wobble) * per.x + 0.5 * (row & 1) as f32);
        let edge = edge_distance(x, y, self.size);
        let grit = value_noise(uv * (16.0 * per.y), self.seed ^ 1);
        if edge < 0.5 * self.joint {
            return self.mortar * (0.75 + 0.25 * grit);
        }
        let brick = lattice(column, row, self.seed);
        let own = self.colors[0].lerp(self.colors[1], unit(brick));
        // Some bricks were fired darker.
        let fired = if unit(mix(brick)) < 0.12 { 0.6 } else { 1.0 };
        own * (fired * (0.72 + 0.28 * grit))
    }
}

/// A grid of tiles.
#[derive(Debug, Clone, PartialEq)]
pub struct Tiles {
    /// Width and height of a tile with its joint.
    pub size: Vec2,
    /// Width of the joints.
    pub joint: f32,
    /// Colours between which each tile lies.
    pub colors: [Vec3; 2],
    /// How much each tile is clouded, in [0, 1]; 0 for plain glaze.
    pub clouding: f32,
    /// Colour of the joints.
    pub grout: Vec3,
    /// Which tiles.
    pub seed: u32,
}

impl Tiles {
    #[inline]
    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        let per = self.size.recip();
        let (row, y) = split(uv.y * per.y);
        let (column, x) = split(uv.x * per.x);
        let edge = edge_distance(x, y, self.size);
        let half = 0.5 * self.joint;
        if edge < half {
            return self.grout;
        }
        let tile = lattice(column, row, self.seed);
        let own = self.colors[0].lerp(self.colors[1], unit(tile));
        let cloud = if self.clouding > 0.0 {
            let p = uv * (6.0 * per.y);
            1.0 - self.clouding * value_noise(p, tile)
        } else {
            1.0
        };
        // The rim is rounded off and dirty.
        own * (cloud * (0.8 + 0.2 * smoothstep(half, 3.0 * half + f32::MIN_POSITIVE, edge)))
    }
}

/// Distance to the nearest edge of a cell of `size` at the fractions `x` and `y` of it.
#[inline]
fn edge_distance(x: f32, y: f32, size: Vec2) -> f32 {
    (x.min(1.0 - x) * size.x).min(y.min(1.0 - y) * size.y)
}
