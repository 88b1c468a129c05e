//! The hierarchy as it is kept, and what a traversal needs.

use super::leaf::{Spheres, Triangles};
use super::node::Node;

/// Rays against triangles and spheres.
#[derive(Debug, Clone)]
pub struct Bvh {
    pub(super) nodes: Vec<Node>,
    pub(super) triangles: Vec<Triangles>,
    pub(super) spheres: Vec<Spheres>,
    pub(super) stack_size: usize,
}

/// What a thread needs to traverse; made once, so that no ray pays for clearing it.
#[derive(Debug, Clone)]
pub struct Stack(pub(super) Vec<(u32, f32)>);

impl Stack {
    /// Entries.
    pub fn size(&self) -> usize {
        self.0.len()
    }
}

impl Bvh {
    /// A stack that fits every ray.
    pub fn stack(&self) -> Stack {
        Stack(vec![(0, 0.0); self.stack_size])
    }
}
