use std::borrow::Cow;

use glam::Vec3;

use crate::{CameraSpec, Material, MaterialIndex, Mesh, Scene, Sphere};

impl Scene {
    /// A scene with nothing in it and no light.
    #[must_use]
    pub fn empty(
        id: impl Into<Cow<'static, str>>,
        title: impl Into<Cow<'static, str>>,
        camera: CameraSpec,
    ) -> Self {
        let (id, title) = (id.into(), title.into());
        Self {
            id,
            title,
            camera,
            materials: vec![],
            meshes: vec![],
            spheres: vec![],
            sun: None,
            sky: None,
            medium: None,
            animation: None,
        }
    }

    /// Adds a material and returns the index by which meshes and spheres refer to it.
    pub fn add_material(&mut self, material: Material) -> MaterialIndex {
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// Adds a mesh made of `material`.
    pub fn add_mesh(&mut self, mut mesh: Mesh, material: MaterialIndex) {
        mesh.material = material;
        self.meshes.push(mesh);
    }

    /// Adds an exact sphere made of `material`.
    pub fn add_sphere(&mut self, center: Vec3, radius: f32, material: MaterialIndex) {
        self.spheres.push(Sphere { center, radius, material });
    }
}
