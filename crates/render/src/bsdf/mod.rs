//! Scattering models. Directions point away from the surface; normals are on the viewer's side.

pub mod conductor;
pub mod dielectric;
pub mod diffuse;
mod scattered;

use glam::Vec3A;

use crate::interaction::Interaction;
use crate::math::reflect;
use scattered::Scattered;

/// A model at a point, its textures looked up.
#[derive(Debug, Clone, Copy)]
pub enum Event {
    /// Scatters into a solid angle.
    Lobe(Lobe),
    /// Follows one direction.
    Specular(Specular),
}

/// Models with a density.
#[derive(Debug, Clone, Copy)]
pub enum Lobe {
    /// Lambertian.
    Diffuse {
        /// Reflectance.
        albedo: Vec3A,
    },
    /// GGX.
    Conductor {
        /// Reflectance at normal incidence.
        f0: Vec3A,
        /// Roughness.
        alpha: f32,
    },
}

impl Lobe {
    /// Scattering function times cosine, and density, towards `to`; zero below the horizon of either normal.
    #[inline(always)]
    pub fn eval(&self, at: &Interaction, out: Vec3A, to: Vec3A) -> (Vec3A, f32) {
        let cos = to.dot(at.normal);
        if cos <= 0.0 || to.dot(at.geometric) <= 0.0 {
            return (Vec3A::ZERO, 0.0);
        }
        match *self {
            Self::Diffuse { albedo } => diffuse::eval(albedo, cos),
            Self::Conductor { f0, alpha } => conductor::eval(f0, alpha, at.normal, out, to),
        }
    }

    /// A direction above the horizon of both normals.
    #[inline(always)]
    pub fn sample(&self, at: &Interaction, out: Vec3A, u: f32, v: f32) -> Option<Scattered> {
        let scattered = match *self {
            Self::Diffuse { albedo } => diffuse::sample(albedo, at.normal, u, v),
            Self::Conductor { f0, alpha } => conductor::sample(f0, alpha, at.normal, out, u, v),
        }?;
        // Densities that underflow are excluded, so that no later quotient is infinite or NaN.
        (scattered.density > 1e-30 && scattered.direction.dot(at.geometric) > 0.0).then_some(scattered)
    }
}

/// Models without a density.
#[derive(Debug, Clone, Copy)]
pub enum Specular {
    /// Mirror with its reflectance.
    Mirror(Vec3A),
    /// Glass with its refractive index.
    Glass(f32),
}

impl Specular {
    /// Factor on radiance of all its directions.
    #[inline(always)]
    pub fn tint(&self) -> Vec3A {
        match *self {
            Self::Mirror(reflectance) => reflectance,
            Self::Glass(_) => Vec3A::ONE,
        }
    }

    /// The next direction, the square of this side's index over that side's, and the normal that was used. Where an
    /// interpolated normal would send light through the wrong side, that is the flat one.
    #[inline(always)]
    pub fn follow(&self, at: &Interaction, out: Vec3A, u: f32) -> (Vec3A, f32, Vec3A) {
        let about = |normal: Vec3A| match *self {
            Self::Mirror(_) => (reflect(out, normal), 1.0, true),
            Self::Glass(ior) => dielectric::sample(ior, normal, at.front, out, u),
        };
        let (direction, scale, reflected) = about(at.normal);
        if (direction.dot(at.geometric) > 0.0) == reflected {
            return (direction, scale, at.normal);
        }
        let (direction, scale, _) = about(at.geometric);
        (direction, scale, at.geometric)
    }
}
