//! Everything that a renderer needs to know.

use std::borrow::Cow;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::{Animation, CameraSpec, Color, Material, Medium, Mesh, Scattering, Sky, Sphere, Sun};

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
