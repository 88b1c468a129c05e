//! Four-wide bounding volume hierarchy. `obvhs` builds a binary tree; it is collapsed so that one step tests four
//! boxes, and one leaf four triangles or four spheres, side by side.

mod build;
mod leaf;

use glam::{Vec3A, Vec4};

pub use build::Primitive;
use leaf::{Spheres, Triangles};

/// A ray with a unit direction.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Origin.
    pub origin: Vec3A,
    /// Unit direction.
    pub direction: Vec3A,
}

/// Nearest intersection.
#[derive(Debug, Clone, Copy)]
pub struct Hit {
    /// Distance.
    pub t: f32,
    /// Index of the primitive as given to [`Bvh::new`].
    pub primitive: u32,
    /// Barycentric coordinates of a triangle's second and third vertex; 0 on spheres.
    pub u: f32,
    /// See `u`.
    pub v: f32,
}

const LEAF: u32 = 1 << 31;
const SPHERES: u32 = 1 << 30;
const INDEX: u32 = SPHERES - 1;
const NOTHING: u32 = u32::MAX;

/// Four children.
#[derive(Debug, Clone)]
struct Node {
    /// Lower x, y, z and upper x, y, z of the children's boxes.
    bounds: [Vec4; 6],
    children: [u32; 4],
}

/// Rays against triangles and spheres.
#[derive(Debug, Clone)]
pub struct Bvh {
    nodes: Vec<Node>,
    triangles: Vec<Triangles>,
    spheres: Vec<Spheres>,
    stack_size: usize,
}

/// What a thread needs to traverse; made once, so that no ray pays for clearing it.
#[derive(Debug, Clone)]
pub struct Stack(Vec<(u32, f32)>);

impl Stack {
    /// Entries.
    pub fn size(&self) -> usize {
        self.0.len()
    }
}

/// A ray spread over lanes.
struct Lanes {
    origin: [Vec4; 3],
    direction: [Vec4; 3],
    inverse: [Vec4; 3],
    /// Rows of [`Node::bounds`] that the ray meets first; the others are `(near + 3) % 6`.
    near: [usize; 3],
}

impl Lanes {
    #[inline(always)]
    fn new(ray: &Ray) -> Self {
        // A tiny component becomes a tiny one of the same sign: its inverse stays finite, so no 0·∞ appears.
        let inverse = |d: f32| if d.abs() > 1e-12 { 1.0 / d } else { 1e12f32.copysign(d) };
        let (o, d) = (ray.origin, ray.direction);
        let i = [inverse(d.x), inverse(d.y), inverse(d.z)];
        let near = |k: usize| if i[k] < 0.0 { k + 3 } else { k };
        Self {
            origin: [Vec4::splat(o.x), Vec4::splat(o.y), Vec4::splat(o.z)],
            direction: [Vec4::splat(d.x), Vec4::splat(d.y), Vec4::splat(d.z)],
            inverse: [Vec4::splat(i[0]), Vec4::splat(i[1]), Vec4::splat(i[2])],
            near: [near(0), near(1), near(2)],
        }
    }

    /// Distances at which the four boxes are entered, and which of them are hit before `limit`.
    #[inline(always)]
    fn boxes(&self, node: &Node, limit: f32) -> (Vec4, u32) {
        let b = &node.bounds;
        let [x, y, z] = self.near;
        let far = |k: usize| if k < 3 { k + 3 } else { k - 3 };
        let slab = |row: usize, axis: usize| (b[row] - self.origin[axis]) * self.inverse[axis];
        let enter = slab(x, 0).max(slab(y, 1)).max(slab(z, 2)).max(Vec4::ZERO);
        let leave = slab(far(x), 0).min(slab(far(y), 1)).min(slab(far(z), 2));
        // Three roundings of a half ulp each on both sides.
        let leave = (leave * 1.000_000_4).min(Vec4::splat(limit));
        (enter, enter.cmple(leave).bitmask())
    }
}

impl Bvh {
    /// A stack that fits every ray.
    pub fn stack(&self) -> Stack {
        Stack(vec![(0, 0.0); self.stack_size])
    }

    /// Nearest hit at a positive distance below `limit`.
    pub fn closest(&self, ray: &Ray, limit: f32, stack: &mut Stack) -> Option<Hit> {
        let lanes = Lanes::new(ray);
        let mut best = Hit { t: limit, primitive: NOTHING, u: 0.0, v: 0.0 };
        let stack = &mut stack.0;
        let mut top = 0;
        let mut current = 0u32;
        loop {
            if current & LEAF == 0 {
                let node = &self.nodes[current as usize];
                let (enter, mut mask) = lanes.boxes(node, best.t);
                let enter = enter.to_array();
                if mask != 0 {
                    // Follow the nearest child; push the others so that the nearer ones come off first.
                    let first = mask.trailing_zeros() as usize & 3;
                    mask &= mask - 1;
                    let mut nearest = (node.children[first], enter[first]);
                    let base = top;
                    while mask != 0 {
                        let next = mask.trailing_zeros() as usize & 3;
                        mask &= mask - 1;
                        let mut other = (node.children[next], enter[next]);
                        if other.1 < nearest.1 {
                            std::mem::swap(&mut other, &mut nearest);
                        }
                        let mut at = top;
                        while at > base && stack[at - 1].1 < other.1 {
                            stack[at] = stack[at - 1];
                            at -= 1;
                        }
                        stack[at] = other;
                        top += 1;
                    }
                    current = nearest.0;
                    continue;
                }
            } else if current & SPHERES == 0 {
                self.triangles[(current & INDEX) as usize].closest(&lanes, &mut best);
            } else {
                self.spheres[(current & INDEX) as usize].closest(&lanes, &mut best);
            }
            loop {
                if top == 0 {
                    return (best.primitive != NOTHING).then_some(best);
                }
                top -= 1;
                let (child, enter) = stack[top];
                if enter < best.t {
                    current = child;
                    break;
                }
            }
        }
    }

    /// Whether anything lies at a positive distance below `limit`.
    pub fn occluded(&self, ray: &Ray, limit: f32, stack: &mut Stack) -> bool {
        let lanes = Lanes::new(ray);
        let stack = &mut stack.0;
        let mut top = 0;
        let mut current = 0u32;
        loop {
            if current & LEAF == 0 {
                let node = &self.nodes[current as usize];
                let (_, mut mask) = lanes.boxes(node, limit);
                if mask != 0 {
                    current = node.children[mask.trailing_zeros() as usize & 3];
                    mask &= mask - 1;
                    while mask != 0 {
                        stack[top] = (node.children[mask.trailing_zeros() as usize & 3], 0.0);
                        mask &= mask - 1;
                        top += 1;
                    }
                    continue;
                }
            } else {
                let index = (current & INDEX) as usize;
                let blocked = if current & SPHERES == 0 {
                    self.triangles[index].any(&lanes, limit)
                } else {
                    self.spheres[index].any(&lanes, limit)
                };
                if blocked {
                    return true;
                }
            }
            if top == 0 {
                return false;
            }
            top -= 1;
            current = stack[top].0;
        }
    }
}
