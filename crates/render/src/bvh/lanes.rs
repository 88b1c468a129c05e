//! One ray against four boxes.

use glam::Vec4;

use super::node::Node;
use super::ray::Ray;

/// A ray spread over lanes.
pub struct Lanes {
    pub origin: [Vec4; 3],
    pub direction: [Vec4; 3],
    inverse: [Vec4; 3],
    /// Rows of [`Node::bounds`] that the ray meets first; the others are `(near + 3) % 6`.
    near: [usize; 3],
}

impl Lanes {
    #[inline(always)]
    pub fn new(ray: &Ray) -> Self {
        // A tiny component becomes a tiny one of the same sign: its inverse stays finite, so no 0·∞ appears.
        let inverse = |d: f32| if d.abs() > 1e-12 { 1.0 / d } else { 1e12f32.copysign(d) };
        let (o, d) = (ray.origin, ray.direction);
        let i = [inverse(d.x), inverse(d.y), inverse(d.z)];
        let near = |k: usize| if i[k] < 0.0 { k + 3 } else { k };
        Self {
            origin: [Vec4::splat(o.x), Vec4::splat(o.y), Vec4::splat(o.z)],
            direction: [Vec4::splat(d.x), Vec4::splat(d.y), Vec4::splat(d.z)],
            inverse: [Vec4::splat(i[0]), Vec4::splat(i[1]), Vec4::splat(i[2])],
            near: [near(0), near(1), near(2)],
        }
    }

    /// Distances at which the four boxes are entered, and which of them are hit before `limit`.
    #[inline(always)]
    pub fn boxes(&self, node: &Node, limit: f32) -> (Vec4, u32) {
        let b = &node.bounds;
        let [x, y, z] = self.near;
        let far = |k: usize| if k < 3 { k + 3 } else { k - 3 };
        let slab = |row: usize, axis: usize| (b[row] - self.origin[axis]) * self.inverse[axis];
        let enter = slab(x, 0).max(slab(y, 1)).max(slab(z, 2)).max(Vec4::ZERO);
        let leave = slab(far(x), 0).min(slab(far(y), 1)).min(slab(far(z), 2));
        // Three roundings of a half ulp each on both sides.
        let leave = (leave * 1.000_000_4).min(Vec4::splat(limit));
        (enter, enter.cmple(leave).bitmask())
    }
}
