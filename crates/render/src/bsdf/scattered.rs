//! What sampling a model gives.

use glam::Vec3A;

/// A direction sampled from a model that is not perfectly specular.
#[derive(Debug, Clone, Copy)]
pub struct Scattered {
    /// Unit direction.
    pub direction: Vec3A,
    /// Scattering function times cosine over density.
    pub weight: Vec3A,
    /// Density per solid angle, positive.
    pub density: f32,
}
