//! glTF 2.0 files as scenes.
//!
//! [`load`] reads a `.gltf` or `.glb` file with its buffers and PNG images. Whatever the file has and a scene cannot
//! show is named in [`Loaded::notices`], never dropped in silence.
//!
//! # Materials
//!
//! A metallic factor of at least 0.5 makes a rough conductor with the base colour as reflectance at normal incidence
//! and α = roughness², at least 0.001; below that the surface is diffuse with the base colour as albedo. Emission is
//! the emissive factor times the strength of `KHR_materials_emissive_strength`, on the front side only. A scene's
//! surfaces emit the same everywhere, so an emissive texture of one colour is multiplied in, and with any other the
//! whole emission is left out: a factor without its texture would make a lamp of every surface that has one lit texel.
//! Vertex colours are multiplied into the base colour, except on surfaces that have a texture, too.
//!
//! # Hostile files
//!
//! Every reference and size is checked before anything is read or allocated, buffers and images have limits of their
//! own and together, and a panic of the parser becomes an error.

mod data;
mod error;
mod geometry;
mod image;
mod images;
mod load;
mod material;
mod parse;
#[cfg(test)]
mod tests;
mod tint;
mod uri;

pub use error::GltfError;
pub use load::{Loaded, load};
