//! Building: a binary tree, collapsed.

use std::time::Duration;

use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;

use super::leaf::{Spheres, Triangles};
use super::node::{LEAF, Node, SPHERES};
use super::tree::Bvh;

/// What can be hit.
#[derive(Debug, Clone, Copy)]
pub enum Primitive {
    /// Vertices; not degenerate.
    Triangle([Vec3A; 3]),
    /// Centre and radius.
    Sphere(Vec3A, f32),
}

impl Primitive {
    /// Bounding box.
    pub fn bounds(&self) -> Aabb {
        match *self {
            Self::Triangle([a, b, c]) => Aabb::new(a.min(b).min(c), a.max(b).max(c)),
            Self::Sphere(center, radius) => Aabb::new(center - radius, center + radius),
        }
    }
}

/// Members of a leaf.
const WIDTH: usize = 4;

/// Triangles and spheres in a subtree of the binary tree.
#[derive(Clone, Copy, Default)]
struct Contents {
    triangles: usize,
    spheres: usize,
}

impl Contents {
    fn fit_one_leaf(self) -> bool {
        self.triangles + self.spheres <= WIDTH && (self.triangles == 0 || self.spheres == 0)
    }
}

struct Collapse<'a> {
    tree: &'a Bvh2,
    contents: Vec<Contents>,
    primitives: &'a [Primitive],
    out: Bvh,
}

impl Bvh {
    /// Builds the hierarchy; hits name primitives by their index here. Nothing is hit if there are none.
    pub fn new(primitives: &[Primitive]) -> Self {
        if primitives.is_empty() {
            return Self { nodes: vec![Node::empty()], triangles: vec![], spheres: vec![], stack_size: 4 };
        }
        let boxes: Vec<Aabb> = primitives.iter().map(Primitive::bounds).collect();
        let params = BvhBuildParams {
            max_prims_per_leaf: 1,
            reinsertion_batch_ratio: 0.2,
            // The tree keeps one primitive per leaf here, so a second pass would only repeat the first.
            post_collapse_reinsertion_batch_ratio_multiplier: 0.0,
            ..BvhBuildParams::medium_build()
        };
        let tree = build_bvh2(&boxes, params, &mut Duration::default());
        let mut contents = vec![Contents::default(); tree.nodes.len()];
        // Iterative post-order: a hostile scene may give a tree as deep as it has primitives.
        let mut stack = vec![(0usize, false)];
        while let Some((index, expanded)) = stack.pop() {
            let node = &tree.nodes[index];
            let first = node.first_index as usize;
            if node.is_leaf() {
                for &primitive in &tree.primitive_indices[first..first + node.prim_count as usize] {
                    match primitives[primitive as usize] {
                        Primitive::Triangle(_) => contents[index].triangles += 1,
                        Primitive::Sphere(..) => contents[index].spheres += 1,
                    }
                }
            } else if expanded {
                let (a, b) = (contents[first], contents[first + 1]);
                contents[index] =
                    Contents { triangles: a.triangles + b.triangles, spheres: a.spheres + b.spheres };
            } else {
                stack.extend([(index, true), (first, false), (first + 1, false)]);
            }
        }
        let out = Self { nodes: Vec::new(), triangles: Vec::new(), spheres: Vec::new(), stack_size: 0 };
        Collapse { tree: &tree, contents, primitives, out }.run()
    }
}

impl Collapse<'_> {
    fn run(mut self) -> Bvh {
        // (binary node, wide node to fill in, its depth)
        self.out.nodes.push(Node::empty());
        let mut pending = vec![(0usize, 0usize, 1usize)];
        let mut deepest = 1;
        while let Some((binary, wide, depth)) = pending.pop() {
            deepest = deepest.max(depth);
            for (lane, child) in self.children(binary).into_iter().enumerate() {
                let link = if self.contents[child].fit_one_leaf() {
                    self.leaf(child)
                } else {
                    self.out.nodes.push(Node::empty());
                    pending.push((child, self.out.nodes.len() - 1, depth + 1));
                    (self.out.nodes.len() - 1) as u32
                };
                let aabb = self.tree.nodes[child].aabb();
                let node = &mut self.out.nodes[wide];
                node.children[lane] = link;
                for axis in 0..3 {
                    node.bounds[axis][lane] = aabb.min[axis];
                    node.bounds[axis + 3][lane] = aabb.max[axis];
                }
            }
        }
        self.out.stack_size = 3 * deepest + 1;
        self.out
    }

    /// Up to four descendants of a binary node that cover it.
    fn children(&self, binary: usize) -> Vec<usize> {
        let area = |index: usize| self.tree.nodes[index].aabb().half_area();
        let mut members = vec![binary];
        while members.len() < WIDTH {
            // Open the largest one that is no leaf; else a leaf whose parts are smaller together than itself.
            let gain = |index: usize| {
                let node = &self.tree.nodes[index];
                if node.is_leaf() {
                    return 0.0;
                }
                let first = node.first_index as usize;
                if self.contents[index].fit_one_leaf() && index != 0 {
                    (area(index) - area(first) - area(first + 1)).max(0.0) * 1e-3
                } else {
                    area(index).max(f32::MIN_POSITIVE)
                }
            };
            let Some((slot, _)) = members
                .iter()
                .enumerate()
                .map(|(slot, &index)| (slot, gain(index)))
                .filter(|(_, gain)| *gain > 0.0)
                .max_by(|a, b| a.1.total_cmp(&b.1))
            else {
                break;
            };
            let first = self.tree.nodes[members[slot]].first_index as usize;
            members[slot] = first;
            members.push(first + 1);
        }
        members
    }

    /// Makes a leaf of everything below a binary node.
    fn leaf(&mut self, binary: usize) -> u32 {
        let (mut triangles, mut spheres) = (Vec::new(), Vec::new());
        let mut pending = vec![binary];
        while let Some(index) = pending.pop() {
            let node = &self.tree.nodes[index];
            let first = node.first_index as usize;
            if !node.is_leaf() {
                pending.extend([first + 1, first]);
                continue;
            }
            for &primitive in &self.tree.primitive_indices[first..first + node.prim_count as usize] {
                match self.primitives[primitive as usize] {
                    Primitive::Triangle(vertices) => triangles.push((primitive, vertices)),
                    Primitive::Sphere(center, radius) => spheres.push((primitive, center, radius)),
                }
            }
        }
        if spheres.is_empty() {
            self.out.triangles.push(Triangles::new(&triangles));
            LEAF | (self.out.triangles.len() - 1) as u32
        } else {
            self.out.spheres.push(Spheres::new(&spheres));
            LEAF | SPHERES | (self.out.spheres.len() - 1) as u32
        }
    }
}
