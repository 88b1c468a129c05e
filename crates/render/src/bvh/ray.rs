//! Rays, and where they end.

use glam::Vec3A;

/// A ray with a unit direction.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Origin.
    pub origin: Vec3A,
    /// Unit direction.
    pub direction: Vec3A,
}

/// Nearest intersection.
#[derive(Debug, Clone, Copy)]
pub struct Hit {
    /// Distance.
    pub t: f32,
    /// Index of the primitive as given to [`super::Bvh::new`].
    pub primitive: u32,
    /// Barycentric coordinates of a triangle's second and third vertex; 0 on spheres.
    pub u: f32,
    /// See `u`.
    pub v: f32,
}
