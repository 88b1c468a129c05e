//! Cameras.

use glam::Vec3;

/// A pinhole or thin-lens camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraSpec {
    /// Eye.
    pub eye: Vec3,
    /// Point in the middle of the image.
    pub target: Vec3,
    /// Approximate up direction.
    pub up: Vec3,
    /// Full vertical field of view in degrees.
    pub vertical_fov_degrees: f32,
    /// Thin lens, or none for a pinhole.
    pub lens: Option<Lens>,
}

/// A thin lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    /// Radius in scene units.
    pub radius: f32,
    /// Distance of the plane in focus, along the viewing direction.
    pub focus_distance: f32,
}
