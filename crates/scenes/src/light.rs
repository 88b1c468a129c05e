//! Light from infinitely far away.

use std::sync::Arc;

use glam::Vec3;

use crate::EnvironmentMap;

/// A distant disc light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sun {
    /// Unit direction from the scene towards the sun.
    pub direction: Vec3,
    /// Half the apparent angle in degrees, in (0, 10].
    pub half_angle_degrees: f32,
    /// Irradiance on a surface that faces the sun.
    pub irradiance: Vec3,
}

/// Light from infinitely far away, seen wherever nothing is hit.
#[derive(Debug, Clone, PartialEq)]
pub enum Sky {
    /// The same radiance from everywhere.
    Constant(Vec3),
    /// Blends from the horizon to the zenith with the cosine; the ground colour below the horizon.
    Gradient {
        /// Radiance at the horizon.
        horizon: Vec3,
        /// Radiance overhead (+Y).
        zenith: Vec3,
        /// Radiance from below.
        ground: Vec3,
    },
    /// An image by direction, sampled in proportion to its luminance.
    Map(Arc<EnvironmentMap>),
}
