use std::borrow::Cow;
use std::sync::Arc;

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use crate::{Animation, EnvironmentMap, Medium, Texture};

/// Index into [`Scene::materials`].
pub type MaterialIndex = usize;

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

/// A triangle mesh with one material.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertices in world space.
    pub positions: Vec<Vec3>,
    /// Unit shading normals per vertex, or empty for flat shading.
    pub normals: Vec<Vec3>,
    /// Texture coordinates per vertex, or empty if no texture looks at them.
    pub uvs: Vec<Vec2>,
    /// Counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Material of all triangles.
    pub material: MaterialIndex,
}

/// An exact sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Centre in world space.
    pub center: Vec3,
    /// Radius, positive.
    pub radius: f32,
    /// Material.
    pub material: MaterialIndex,
}

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

/// What a scene models: nothing else is built, traced or stored for it.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Models {
    /// Thin lens.
    pub depth_of_field: bool,
    /// Textures.
    pub textures: bool,
    /// Perfectly specular surfaces.
    pub specular: bool,
    /// Glossy surfaces.
    pub glossy: bool,
    /// Area lights.
    pub area_lights: bool,
    /// A sun disc.
    pub sun: bool,
    /// A sky.
    pub sky: bool,
    /// A sky that is an image, sampled by importance.
    pub environment_map: bool,
    /// A participating medium.
    pub medium: bool,
    /// Bodies that move while the shutter is open.
    pub motion_blur: bool,
}

/// Everything a renderer needs to know, and nothing about how it renders.
#[derive(Clone, PartialEq)]
pub struct Scene {
    /// Stable name.
    pub id: Cow<'static, str>,
    /// Title for people.
    pub title: Cow<'static, str>,
    /// Camera.
    pub camera: CameraSpec,
    /// Surfaces.
    pub materials: Vec<Material>,
    /// Meshes.
    pub meshes: Vec<Mesh>,
    /// Exact spheres.
    pub spheres: Vec<Sphere>,
    /// Distant light.
    pub sun: Option<Sun>,
    /// Background light; black if none.
    pub sky: Option<Sky>,
    /// What light goes through outside glass; nothing if none.
    pub medium: Option<Medium>,
    /// What moves; everything stands still if none.
    pub animation: Option<Animation>,
}

/// By hand: hashes of this text name rendered frames, so a capability that a scene does not use must not show in it.
impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { id, title, camera, materials, meshes, spheres, sun, sky, medium, animation } = self;
        let mut out = f.debug_struct("Scene");
        out.field("id", id).field("title", title).field("camera", camera).field("materials", materials);
        out.field("meshes", meshes).field("spheres", spheres).field("sun", sun).field("sky", sky);
        if let Some(medium) = medium {
            out.field("medium", medium);
        }
        if let Some(animation) = animation {
            out.field("animation", animation);
        }
        out.finish()
    }
}

impl Scene {
    /// Derived from the contents, so that it cannot disagree with them.
    #[must_use]
    pub fn models(&self) -> Models {
        let any = |f: &dyn Fn(&Material) -> bool| self.materials.iter().any(f);
        let textured = |color: &Color| matches!(color, Color::Texture(_));
        Models {
            depth_of_field: self.camera.lens.is_some(),
            textures: any(&|m| match &m.scattering {
                Scattering::Diffuse { albedo: c } | Scattering::Conductor { f0: c, .. } => textured(c),
                _ => false,
            }),
            specular: any(&|m| matches!(m.scattering, Scattering::Mirror { .. } | Scattering::Glass { .. })),
            glossy: any(&|m| matches!(m.scattering, Scattering::Conductor { .. })),
            area_lights: any(&|m| m.emission != Vec3::ZERO),
            sun: self.sun.is_some(),
            sky: self.sky.is_some(),
            environment_map: matches!(self.sky, Some(Sky::Map(_))),
            medium: self.medium.is_some(),
            motion_blur: self.animation.as_ref().is_some_and(Animation::blurs),
        }
    }

    /// Number of triangles and spheres.
    #[must_use]
    pub fn primitives(&self) -> usize {
        self.meshes.iter().map(|m| m.triangles.len()).sum::<usize>() + self.spheres.len()
    }
}
