//! Procedural scenes, each declaring exactly what it models.
//!
//! A [`Scene`] is plain data; nothing here traces a ray. [`builtin`] lists the scenes by id.

mod scene;
mod texture;

pub use scene::{
    CameraSpec, Color, Lens, Material, MaterialIndex, Mesh, Models, Scattering, Scene, Sky, Sphere, Sun,
};
pub use texture::Texture;

/// A scene that can be built by name.
#[derive(Debug, Clone, Copy)]
pub struct SceneEntry {
    /// Stable name.
    pub id: &'static str,
    /// What it shows and which figure it stands in for.
    pub about: &'static str,
    /// Builds it; deterministic.
    pub build: fn() -> Scene,
}

/// All built-in scenes in display order.
#[must_use]
pub fn builtin() -> &'static [SceneEntry] {
    &[]
}
