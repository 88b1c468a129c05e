//! What can be hit.

use glam::{Vec2, Vec3};

/// Index into [`crate::Scene::materials`].
pub type MaterialIndex = usize;

/// A triangle mesh with one material.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertices in world space.
    pub positions: Vec<Vec3>,
    /// Unit shading normals per vertex, or empty for flat shading.
    pub normals: Vec<Vec3>,
    /// Texture coordinates per vertex, or empty if no texture looks at them.
    pub uvs: Vec<Vec2>,
    /// Counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Material of all triangles.
    pub material: MaterialIndex,
}

/// An exact sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Centre in world space.
    pub center: Vec3,
    /// Radius, positive.
    pub radius: f32,
    /// Material.
    pub material: MaterialIndex,
}
