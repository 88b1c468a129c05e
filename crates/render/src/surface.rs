//! Materials ready for shading.

use glam::{Vec2, Vec3A};
use noisefloor_scenes::{Color, Texture};

use crate::bsdf::{Event, Lobe, Specular};

/// A colour whose textures are set apart, so that constant ones are read without a branch on size.
#[derive(Debug, Clone)]
pub enum Tint {
    /// The same everywhere.
    Constant(Vec3A),
    /// By surface coordinates.
    Texture(Box<Texture>),
}

impl Tint {
    /// From the scene description.
    pub fn new(color: &Color) -> Self {
        match color {
            Color::Constant(c) => Self::Constant((*c).into()),
            Color::Texture(t) => Self::Texture(Box::new(t.clone())),
        }
    }

    /// Colour at surface coordinates.
    #[inline(always)]
    pub fn at(&self, uv: Vec2) -> Vec3A {
        match self {
            Self::Constant(c) => *c,
            Self::Texture(texture) => texture_at(texture, uv),
        }
    }
}

/// Kept out of line: textures are dear and rare, and the loop around them should stay small.
#[inline(never)]
fn texture_at(texture: &Texture, uv: Vec2) -> Vec3A {
    texture.eval(uv).into()
}

/// How a surface scatters.
#[derive(Debug, Clone)]
pub enum Scatter {
    /// Lambertian on both sides.
    Diffuse(Tint),
    /// Perfect mirror.
    Mirror(Vec3A),
    /// Smooth dielectric with this refractive index.
    Glass(f32),
    /// GGX with reflectance at normal incidence and α.
    Conductor(Tint, f32),
}

impl Scatter {
    /// The model at surface coordinates.
    #[inline(always)]
    pub fn at(&self, uv: Vec2) -> Event {
        match self {
            Self::Diffuse(tint) => Event::Lobe(Lobe::Diffuse { albedo: tint.at(uv) }),
            Self::Conductor(tint, alpha) => Event::Lobe(Lobe::Conductor { f0: tint.at(uv), alpha: *alpha }),
            Self::Mirror(reflectance) => Event::Specular(Specular::Mirror(*reflectance)),
            Self::Glass(ior) => Event::Specular(Specular::Glass(*ior)),
        }
    }
}

impl Event {
    /// The reflectance that is recorded as albedo.
    #[inline(always)]
    pub fn albedo(&self) -> Vec3A {
        match *self {
            Self::Lobe(Lobe::Diffuse { albedo: tint } | Lobe::Conductor { f0: tint, .. }) => tint,
            Self::Specular(specular) => specular.tint(),
        }
    }
}

/// A material ready for shading.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Scattering.
    pub scatter: Scatter,
    /// Radiance on the front side.
    pub emission: Vec3A,
    /// Whether `emission` is not zero.
    pub emits: bool,
}
