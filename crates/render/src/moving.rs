//! Bodies that move while the shutter is open.

use glam::{Affine3A, Vec3A};
use noisefloor_scenes::Body;

use crate::bvh::{Bvh, Ray};

/// A body ready for rays.
#[derive(Debug, Clone)]
pub struct Moving {
    /// Its movement from when the shutter opens.
    pub body: Body,
    /// Of its primitives, numbered from 0.
    pub bvh: Bvh,
    /// Index of its first primitive among those of the scene.
    pub first: u32,
    /// Sphere around it when the shutter opens.
    pub center: Vec3A,
    /// Radius of the sphere.
    pub radius: f32,
}

/// The same ray before a movement.
#[inline]
pub fn to_local(ray: &Ray, pose: &Affine3A) -> Ray {
    let back = pose.matrix3.transpose(); // of a rotation: its inverse
    Ray { origin: back * (ray.origin - pose.translation), direction: back * ray.direction }
}

impl Moving {
    /// The ray before the movement, or nothing if it misses the sphere around the body.
    #[inline]
    pub fn local(&self, ray: &Ray, pose: &Affine3A, limit: f32) -> Option<Ray> {
        let to = pose.transform_point3a(self.center) - ray.origin;
        let along = to.dot(ray.direction);
        let aside = (to - ray.direction * along).length_squared();
        let near =
            aside <= self.radius * self.radius && along >= -self.radius && along - self.radius <= limit;
        near.then(|| to_local(ray, pose))
    }
}
