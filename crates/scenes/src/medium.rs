//! What light goes through.

use glam::Vec3;

/// A homogeneous participating medium. It fills all space outside glass, so the light of a scene that has one must come
/// from lamps: nothing reaches it from infinitely far away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Coefficient of absorption per scene unit, in [0, 1e6], by colour.
    pub absorption: Vec3,
    /// Coefficient of scattering per scene unit, in [0, 1e6], by colour.
    pub scattering: Vec3,
    /// Mean cosine of the angle by which scattering turns light (Henyey and Greenstein 1941), in [−0.95, 0.95]; 0
    /// scatters evenly, positive values scatter forwards.
    pub mean_cosine: f32,
}

impl Medium {
    /// Loss of light per scene unit: absorption and scattering together.
    #[must_use]
    pub fn extinction(&self) -> Vec3 {
        self.absorption + self.scattering
    }
}
