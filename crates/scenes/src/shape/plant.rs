use glam::{Vec2, Vec3};

use crate::Mesh;

/// Where a leaf sits and how it is shaped.
#[derive(Debug, Clone, Copy)]
pub struct LeafShape {
    /// Where the blade leaves its stalk.
    pub base: Vec3,
    /// Direction from base to tip; any length above 0.
    pub along: Vec3,
    /// Direction to which the upper side looks, roughly; not parallel to `along`.
    pub up: Vec3,
    /// Length of the blade.
    pub length: f32,
    /// Largest width of the blade.
    pub width: f32,
    /// How far the tip hangs below the straight line, as a share of the length.
    pub droop: f32,
    /// Height of the rims over the midrib, as a share of the width.
    pub fold: f32,
}

impl LeafShape {
    /// Six triangles: a blade folded along its midrib and bent downwards. `number` becomes the integer part of u, so
    /// that [`Texture::Leaf`](crate::Texture::Leaf) gives each leaf its own colour.
    #[must_use]
    pub fn mesh(&self, number: u32) -> Mesh {
        let along = self.along.normalize();
        let side = along.cross(self.up).normalize();
        let up = side.cross(along);
        let at = |across: f32, t: f32| {
            let sag = self.droop * self.length * t * t;
            let lift = 2.0 * self.fold * self.width * across.abs();
            self.base + along * (self.length * t) + side * (self.width * across) + up * (lift - sag)
        };
        // Across the blade in [−1/2, 1/2], along it in [0, 1].
        let points =
            [[0.0, 0.0], [0.42, 0.3], [-0.42, 0.3], [0.0, 0.4], [0.38, 0.65], [-0.38, 0.65], [0.0, 1.0]];
        let triangles = vec![[0, 1, 3], [0, 3, 2], [1, 4, 3], [2, 3, 5], [3, 4, 6], [3, 6, 5]];
        let positions: Vec<Vec3> = points.iter().map(|p| at(p[0], p[1])).collect();
        let mut normals = vec![Vec3::ZERO; positions.len()];
        for t in &triangles {
            let [a, b, c] = t.map(|i: u32| positions[i as usize]);
            let normal = (b - a).cross(c - a);
            t.iter().for_each(|&i| normals[i as usize] += normal);
        }
        Mesh {
            normals: normals.iter().map(|n| n.normalize_or(up)).collect(),
            uvs: points.iter().map(|p| Vec2::new(number as f32 + 0.5 + p[0], p[1])).collect(),
            positions,
            triangles,
            material: 0,
        }
    }
}
