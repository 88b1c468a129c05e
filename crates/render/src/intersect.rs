//! Rays against a prepared scene: what stands still in one hierarchy, each moving body in its own.
//!
//! A body's hierarchy is built where the body is when the shutter opens. A ray is taken there by the inverse of the
//! body's movement at the ray's time, which is a rotation and a translation and so keeps distances; what it hits is
//! taken back.

use glam::{Affine3A, Vec3A};

use crate::bvh::{Hit, Ray, Stack};
use crate::interaction::Interaction;
use crate::moving::to_local;
use crate::prepare::Prepared;

/// What a thread needs to follow rays; made once, so that no ray pays for clearing it.
#[derive(Debug, Clone)]
pub struct Traversal {
    stack: Stack,
    /// Of the bodies at the time of the sample: from when the shutter opens to then.
    poses: Vec<Affine3A>,
    /// Rays followed since this was last asked for.
    rays: u64,
}

impl Traversal {
    /// Rays followed since the last call; a shadow ray counts as one.
    pub fn take_rays(&mut self) -> u64 {
        std::mem::take(&mut self.rays)
    }
}

impl Prepared {
    /// A traversal at time 0.
    pub fn traversal(&self) -> Traversal {
        let stacks = self.bodies.iter().map(|b| b.bvh.stack()).chain([self.bvh.stack()]);
        let stack = stacks.max_by_key(Stack::size).unwrap_or_else(|| self.bvh.stack());
        Traversal { stack, poses: self.bodies.iter().map(|b| b.body.at(0.0)).collect(), rays: 0 }
    }

    /// Puts the bodies where they are after a share `u` of the time that the shutter is open.
    pub fn set_time(&self, traversal: &mut Traversal, u: f32) {
        for (pose, moving) in traversal.poses.iter_mut().zip(&self.bodies) {
            *pose = moving.body.at(u * self.shutter);
        }
    }

    /// Nearest hit at a positive distance below `limit`.
    #[inline(always)]
    pub fn closest<const EXTRAS: bool>(
        &self,
        ray: &Ray,
        limit: f32,
        traversal: &mut Traversal,
    ) -> Option<Hit> {
        traversal.rays += 1;
        let mut best = self.bvh.closest(ray, limit, &mut traversal.stack);
        if EXTRAS {
            for (moving, pose) in self.bodies.iter().zip(&traversal.poses) {
                let limit = best.map_or(limit, |hit| hit.t);
                if let Some(local) = moving.local(ray, pose, limit)
                    && let Some(hit) = moving.bvh.closest(&local, limit, &mut traversal.stack)
                {
                    best = Some(Hit { primitive: hit.primitive + moving.first, ..hit });
                }
            }
        }
        best
    }

    /// Whether anything lies at a positive distance below `limit`.
    #[inline(always)]
    pub fn occluded<const EXTRAS: bool>(&self, ray: &Ray, limit: f32, traversal: &mut Traversal) -> bool {
        traversal.rays += 1;
        if self.bvh.occluded(ray, limit, &mut traversal.stack) {
            return true;
        }
        EXTRAS
            && self.bodies.iter().zip(&traversal.poses).any(|(moving, pose)| {
                moving
                    .local(ray, pose, limit)
                    .is_some_and(|local| moving.bvh.occluded(&local, limit, &mut traversal.stack))
            })
    }

    /// Everything about a hit of `ray`.
    #[inline(always)]
    pub fn interact<const EXTRAS: bool>(&self, ray: &Ray, hit: &Hit, traversal: &Traversal) -> Interaction {
        let geometry = &self.geometry[hit.primitive as usize];
        if EXTRAS && let Some(body) = self.body_of(hit) {
            let pose = &traversal.poses[body];
            let local = geometry.interact(&to_local(ray, pose), hit, &self.attributes);
            return Interaction {
                point: pose.transform_point3a(local.point),
                geometric: pose.transform_vector3a(local.geometric),
                normal: pose.transform_vector3a(local.normal),
                ..local
            };
        }
        geometry.interact(ray, hit, &self.attributes)
    }

    /// The moving body that was hit.
    #[inline]
    fn body_of(&self, hit: &Hit) -> Option<usize> {
        // Bodies come last, in the order of their primitives.
        self.bodies.iter().rposition(|moving| hit.primitive >= moving.first)
    }

    /// Where a point of what was hit is when the shutter opens, and one frame later.
    pub fn over_a_frame(&self, hit: &Hit, point: Vec3A, traversal: &Traversal) -> [Vec3A; 2] {
        match self.body_of(hit) {
            None => [point; 2],
            Some(body) => {
                let start = traversal.poses[body].inverse().transform_point3a(point);
                [start, self.bodies[body].body.at(1.0).transform_point3a(start)]
            }
        }
    }
}
