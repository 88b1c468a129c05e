use glam::{Vec2, Vec3};

use crate::Mesh;

/// The parallelogram `origin`, `origin + u`, `origin + u + v`, `origin + v`; its front is where `u × v` points.
#[must_use]
pub fn quad(origin: Vec3, u: Vec3, v: Vec3) -> Mesh {
    let normal = u.cross(v).normalize();
    let (w, h) = (u.length(), v.length());
    Mesh {
        positions: vec![origin, origin + u, origin + u + v, origin + v],
        normals: vec![normal; 4],
        uvs: vec![Vec2::ZERO, Vec2::new(w, 0.0), Vec2::new(w, h), Vec2::new(0.0, h)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material: 0,
    }
}

/// A convex polygon as a fan around its first corner, flat, without texture coordinates; corners are
/// counter-clockwise seen from the front.
#[must_use]
pub fn polygon(corners: &[Vec3]) -> Mesh {
    Mesh {
        positions: corners.to_vec(),
        triangles: (2..corners.len() as u32).map(|i| [0, i - 1, i]).collect(),
        ..Mesh::default()
    }
}

/// Axis-aligned box.
#[must_use]
pub fn cuboid(min: Vec3, max: Vec3) -> Mesh {
    let d = max - min;
    let (x, y, z) = (Vec3::X * d.x, Vec3::Y * d.y, Vec3::Z * d.z);
    Mesh::joined([
        quad(min + z, x, y),
        quad(min + x, -x, y),
        quad(min, z, y),
        quad(max - y, -z, y),
        quad(min + y + z, x, -z),
        quad(min, x, z),
    ])
}
