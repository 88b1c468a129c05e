//! Inner nodes, and how they name what is below them.

use glam::Vec4;

/// Marks a leaf among [`Node::children`].
pub const LEAF: u32 = 1 << 31;
/// Marks a leaf of spheres.
pub const SPHERES: u32 = 1 << 30;
/// The part of a link that is an index.
pub const INDEX: u32 = SPHERES - 1;
/// No child, no primitive.
pub const NOTHING: u32 = u32::MAX;

/// Four children.
#[derive(Debug, Clone)]
pub struct Node {
    /// Lower x, y, z and upper x, y, z of the children's boxes.
    pub bounds: [Vec4; 6],
    /// Links: an inner node, or [`LEAF`] with an index.
    pub children: [u32; 4],
}

impl Node {
    /// Boxes that no ray meets.
    pub fn empty() -> Self {
        let (inside_out, children) = (Vec4::INFINITY, [NOTHING; 4]);
        Self { bounds: [inside_out, inside_out, inside_out, -inside_out, -inside_out, -inside_out], children }
    }
}
