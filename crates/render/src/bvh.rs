//! Four-wide bounding volume hierarchy. `obvhs` builds a binary tree; it is collapsed so that one step tests four
//! boxes, and one leaf four triangles or four spheres, side by side.

mod build;
mod lanes;
mod leaf;
mod node;
mod ray;
mod traverse;
mod tree;

pub use build::Primitive;
pub use ray::{Hit, Ray};
pub use tree::{Bvh, Stack};
