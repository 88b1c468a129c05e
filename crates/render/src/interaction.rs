//! What a ray meets: a point and its normals.

use glam::{Vec2, Vec3A};

/// A hit, seen from the side that the ray came from.
#[derive(Debug, Clone, Copy)]
pub struct Interaction {
    /// Point on the surface.
    pub point: Vec3A,
    /// Geometric normal on the viewer's side.
    pub geometric: Vec3A,
    /// Shading normal on the viewer's side: its cosine with the direction to the viewer is positive.
    pub normal: Vec3A,
    /// Whether the viewer is on the side to which the primitive's own geometric normal points.
    pub front: bool,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Distance that clears the rounding error of the hit.
    pub clearance: f32,
}

impl Interaction {
    /// Where a ray that leaves in direction `w` starts, clear of the surface.
    #[inline(always)]
    pub fn leave(&self, w: Vec3A) -> Vec3A {
        self.point + self.geometric * self.clearance.copysign(w.dot(self.geometric))
    }
}
