//! Procedural scenes, each declaring exactly what it models.
//!
//! A [`Scene`] is plain data; nothing here traces a ray. [`builtin`] lists the scenes by id and [`find`] looks one
//! up. [`shape`] and [`Texture`] are the building blocks, open to anybody who puts together a scene of their own;
//! [`analytic`] has the small scenes whose image is known in closed form.
//!
//! Scenes and textures use no random state: placement is hashed from indices ([`hash`]), so a scene is the same
//! every time it is built.

pub mod analytic;
mod animation;
mod assemble;
mod builtin;
mod camera;
mod catalog;
mod check;
mod environment;
pub mod hash;
mod known_mean;
mod light;
mod limits;
mod material;
mod medium;
mod mesh;
mod scene;
mod sequence;
pub mod shape;
pub mod texture;

pub use animation::{Animation, Body, CameraMove, Spin};
pub use camera::{CameraSpec, Lens};
pub use catalog::{SceneEntry, UnknownScene, builtin, find};
pub use check::SceneError;
pub use environment::EnvironmentMap;
pub use known_mean::{Rays, closed_form};
pub use light::{Sky, Sun};
pub use limits::MOST_RADIANCE;
pub use material::{Color, Material, Scattering};
pub use medium::Medium;
pub use mesh::{MaterialIndex, Mesh, Sphere};
pub use scene::{Models, Scene};
pub use texture::Texture;
