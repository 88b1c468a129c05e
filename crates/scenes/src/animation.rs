//! What moves, and how.

use glam::{Affine3A, DMat3, DVec3, Quat, Vec3};

use crate::CameraSpec;

/// How a scene changes from frame to frame. The scene itself is frame 0 at the moment when the shutter opens.
///
/// Bodies move while the shutter is open and are blurred by it. The camera stands still during a frame and jumps between
/// frames.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Animation {
    /// Part of a frame's duration during which the shutter is open, from its beginning, in [0, 1]; 0 blurs nothing.
    pub shutter: f32,
    /// What moves in the scene.
    pub bodies: Vec<Body>,
    /// How the camera moves.
    pub camera: CameraMove,
}

/// Meshes that move together without changing their shape.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Body {
    /// Indices into [`crate::Scene::meshes`]; no mesh belongs to two bodies.
    pub meshes: Vec<usize>,
    /// Way per frame in scene units.
    pub translation: Vec3,
    /// Rotation, about a centre that takes part in the translation.
    pub spin: Option<Spin>,
}

/// A steady rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spin {
    /// A point of the axis in frame 0.
    pub center: Vec3,
    /// Unit direction of the axis; counter-clockwise when it points to the viewer.
    pub axis: Vec3,
    /// Angle per frame, within ±3600.
    pub degrees: f32,
}

/// A steady movement of the camera.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CameraMove {
    /// Degrees per frame, within ±360, by which the eye goes around the vertical through its target, counter-clockwise
    /// seen from above.
    pub orbit_degrees: f32,
    /// Way of eye and target per frame in scene units.
    pub translation: Vec3,
}

impl CameraMove {
    /// The camera after a time in frames.
    #[must_use]
    pub fn apply(&self, camera: &CameraSpec, frames: f32) -> CameraSpec {
        let turn = Quat::from_rotation_y((self.orbit_degrees * frames).to_radians());
        let shift = self.translation * frames;
        CameraSpec {
            eye: camera.target + turn * (camera.eye - camera.target) + shift,
            target: camera.target + shift,
            up: turn * camera.up,
            ..*camera
        }
    }
}

impl Body {
    /// From frame 0 to a time in frames: a rotation and a translation.
    #[must_use]
    pub fn at(&self, frames: f32) -> Affine3A {
        let way = self.translation.as_dvec3() * f64::from(frames);
        let Some(spin) = self.spin else {
            return Affine3A::from_translation(way.as_vec3());
        };
        // In f64, with an axis of exactly unit length and an angle within a turn: rays rely on a pure rotation.
        let angle = (f64::from(spin.degrees) * f64::from(frames)).rem_euclid(360.0).to_radians();
        let turn = DMat3::from_axis_angle(spin.axis.as_dvec3().normalize_or(DVec3::Y), angle);
        let center = spin.center.as_dvec3();
        let translation = (center + way - turn * center).as_vec3a();
        Affine3A { matrix3: turn.as_mat3().into(), translation }
    }

    /// The same movement from a later moment on.
    pub(crate) fn later(&self, frames: f32) -> Self {
        let spin = self.spin.map(|s| Spin { center: s.center + self.translation * frames, ..s });
        Self { spin, ..self.clone() }
    }
}

impl Animation {
    /// Whether the shutter sees something move.
    #[must_use]
    pub fn blurs(&self) -> bool {
        self.shutter > 0.0 && !self.bodies.is_empty()
    }
}

#[cfg(test)]
mod tests;
