use glam::Vec3;

use crate::{Color, Material, Scattering, Texture};

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
