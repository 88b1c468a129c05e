//! Following a ray through the hierarchy.

use super::lanes::Lanes;
use super::node::{INDEX, LEAF, NOTHING, SPHERES};
use super::ray::{Hit, Ray};
use super::tree::{Bvh, Stack};

impl Bvh {
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
