//! Lambertian reflection.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3A;

use super::scattered::Scattered;
use crate::math::cosine_hemisphere;

/// Scattering function times cosine, and the density of [`sample`], for a cosine above 0.
#[inline(always)]
pub fn eval(albedo: Vec3A, cos: f32) -> (Vec3A, f32) {
    let density = cos * FRAC_1_PI;
    (albedo * density, density)
}

/// A direction with density cos/π.
#[inline(always)]
pub fn sample(albedo: Vec3A, normal: Vec3A, u: f32, v: f32) -> Option<Scattered> {
    let (direction, cos) = cosine_hemisphere(normal, u, v);
    (cos > 0.0).then_some(Scattered { direction, weight: albedo, density: cos * FRAC_1_PI })
}
