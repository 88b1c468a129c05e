//! Surfaces: colours, and how they scatter.

use glam::Vec3;

use crate::Texture;

/// A colour that may vary over a surface; linear RGB reflectance.
#[derive(Debug, Clone, PartialEq)]
pub enum Color {
    /// The same everywhere.
    Constant(Vec3),
    /// Looked up by surface coordinates.
    Texture(Texture),
}

/// How a surface scatters light.
#[derive(Debug, Clone, PartialEq)]
pub enum Scattering {
    /// Lambertian on both sides.
    Diffuse {
        /// Reflectance in [0, 1].
        albedo: Color,
    },
    /// Perfect mirror.
    Mirror {
        /// Reflectance in [0, 1].
        reflectance: Vec3,
    },
    /// Smooth dielectric; the surface must be closed.
    Glass {
        /// Refractive index inside over outside, above 1.
        ior: f32,
    },
    /// Rough conductor: GGX with Smith masking and Schlick's Fresnel term.
    Conductor {
        /// Reflectance at normal incidence in [0, 1].
        f0: Color,
        /// GGX α in (0, 1].
        alpha: f32,
    },
}

/// A surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name for people.
    pub name: String,
    /// How it scatters.
    pub scattering: Scattering,
    /// Radiance emitted on the front side (the side its geometric normal points to); zero for none.
    pub emission: Vec3,
}

impl From<Vec3> for Color {
    fn from(constant: Vec3) -> Self {
        Self::Constant(constant)
    }
}

impl From<Texture> for Color {
    fn from(texture: Texture) -> Self {
        Self::Texture(texture)
    }
}

impl Material {
    /// Lambertian on both sides; reflectance in [0, 1].
    #[must_use]
    pub fn diffuse(name: &str, albedo: impl Into<Color>) -> Self {
        Self::dark(name, Scattering::Diffuse { albedo: albedo.into() })
    }

    /// Perfect mirror; reflectance in [0, 1].
    #[must_use]
    pub fn mirror(name: &str, reflectance: Vec3) -> Self {
        Self::dark(name, Scattering::Mirror { reflectance })
    }

    /// Smooth dielectric with refractive index `ior` above 1.
    #[must_use]
    pub fn glass(name: &str, ior: f32) -> Self {
        Self::dark(name, Scattering::Glass { ior })
    }

    /// Rough conductor with reflectance `f0` at normal incidence and GGX `alpha` in (0, 1].
    #[must_use]
    pub fn conductor(name: &str, f0: impl Into<Color>, alpha: f32) -> Self {
        Self::dark(name, Scattering::Conductor { f0: f0.into(), alpha })
    }

    /// Light: reflects nothing and emits `radiance` on its front side.
    #[must_use]
    pub fn emitter(name: &str, radiance: Vec3) -> Self {
        Self { emission: radiance, ..Self::diffuse(name, Vec3::ZERO) }
    }

    /// Scatters without emitting.
    #[must_use]
    pub fn dark(name: &str, scattering: Scattering) -> Self {
        Self { name: name.to_owned(), scattering, emission: Vec3::ZERO }
    }
}
