//! glTF 2.0 files as scenes.
//!
//! [`load`] reads a `.gltf` or `.glb` file with its buffers and PNG images. Whatever the file has and a scene cannot
//! show is named in [`Loaded::notices`], never dropped in silence.
//!
//! # Materials
//!
//! A metallic factor of at least 0.5 makes a rough conductor with the base colour as reflectance at normal incidence
//! and α = roughness², at least 0.001; below that the surface is diffuse with the base colour as albedo. Emission is
//! the emissive factor times the strength of `KHR_materials_emissive_strength`, on the front side only.

mod data;
mod error;
mod geometry;
mod image;
mod load;
mod material;
#[cfg(test)]
mod tests;

pub use error::GltfError;
pub use load::{Loaded, load};
