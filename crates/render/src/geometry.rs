//! Primitives as they are shaded: normals, texture coordinates, and where a hit lies.

use glam::{Vec2, Vec3, Vec3A};

use crate::bvh::{Hit, Ray};
use crate::interaction::Interaction;

/// No light, no attributes.
pub const NONE: u32 = u32::MAX;

/// Vertex normals and texture coordinates of a triangle: one cache line.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub struct Attributes {
    /// Unit vertex normals; zero to shade flat.
    pub normals: [Vec3; 3],
    /// Texture coordinates.
    pub uvs: [Vec2; 3],
}

/// Shading data of a primitive: half a cache line.
#[derive(Debug, Clone, Copy)]
pub struct Geometry {
    /// Unit geometric normal of a triangle, or centre of a sphere.
    origin: Vec3,
    /// Signed distance of a triangle's plane from the world's origin, or radius of a sphere.
    offset: f32,
    /// Distance that clears the rounding error of a hit on this primitive.
    clearance: f32,
    /// Material.
    pub material: u32,
    /// Light, or [`NONE`].
    pub light: u32,
    /// Attributes, [`NONE`], or [`SPHERE`].
    attributes: u32,
}

/// Marks a sphere in [`Geometry::attributes`].
const SPHERE: u32 = u32::MAX - 1;

/// Rounding error of hits in units of the coordinates involved: about 8 roundings of 6e-8, with a margin of 6.
const CLEARANCE: f32 = 3e-6;

impl Geometry {
    /// A triangle that is not degenerate.
    pub fn triangle(v: [Vec3A; 3], material: u32, attributes: u32) -> Self {
        let (edge1, edge2) = (v[1] - v[0], v[2] - v[0]);
        let normal = edge1.cross(edge2).normalize();
        let largest = |a: Vec3A| a.abs().max_element();
        Self {
            origin: normal.into(),
            offset: normal.dot(v[0]),
            clearance: CLEARANCE * (largest(v[0]) + largest(edge1) + largest(edge2)),
            material,
            light: NONE,
            attributes,
        }
    }

    /// A sphere of positive radius.
    pub fn sphere(center: Vec3A, radius: f32, material: u32) -> Self {
        Self {
            origin: center.into(),
            offset: radius,
            clearance: CLEARANCE * (center.abs().max_element() + radius),
            material,
            light: NONE,
            attributes: SPHERE,
        }
    }

    /// For a primitive that moves this far: rounding grows with the coordinates on its way.
    pub fn moving(mut self, way: f32) -> Self {
        self.clearance += CLEARANCE * way;
        self
    }

    /// Everything about a hit of `ray` on this primitive.
    #[inline(always)]
    pub fn interact(&self, ray: &Ray, hit: &Hit, attributes: &[Attributes]) -> Interaction {
        if self.attributes == SPHERE {
            return self.on_sphere(ray, hit);
        }
        let normal = Vec3A::from(self.origin);
        let along = ray.origin + ray.direction * hit.t;
        // Moves the rounding error of a long ray into the triangle's plane.
        let point = along - normal * (normal.dot(along) - self.offset);
        let front = ray.direction.dot(normal) < 0.0;
        let geometric = if front { normal } else { -normal };
        let mut out = Interaction {
            point,
            geometric,
            normal: geometric,
            front,
            uv: Vec2::ZERO,
            clearance: self.clearance,
        };
        if self.attributes != NONE {
            let a = &attributes[self.attributes as usize];
            let (u, v) = (hit.u, hit.v);
            let w = 1.0 - u - v;
            out.uv = a.uvs[0] * w + a.uvs[1] * u + a.uvs[2] * v;
            let smooth = Vec3A::from(a.normals[0] * w + a.normals[1] * u + a.normals[2] * v);
            let squared = smooth.length_squared();
            if squared > 1e-6 {
                let smooth = smooth * (1.0 / squared.sqrt());
                let smooth = if front { smooth } else { -smooth };
                // A vertex normal that faces away from the viewer cannot be shaded: fall back to the flat one.
                if smooth.dot(ray.direction) < -1e-4 && smooth.dot(geometric) > 0.0 {
                    out.normal = smooth;
                }
            }
        }
        out
    }

    #[inline(always)]
    fn on_sphere(&self, ray: &Ray, hit: &Hit) -> Interaction {
        let (center, radius) = (Vec3A::from(self.origin), self.offset);
        let outward = (ray.origin + ray.direction * hit.t - center).normalize_or(-ray.direction);
        let front = ray.direction.dot(outward) < 0.0;
        let geometric = if front { outward } else { -outward };
        Interaction {
            point: center + outward * radius,
            geometric,
            normal: geometric,
            front,
            uv: sphere_uv(outward),
            clearance: self.clearance,
        }
    }
}

/// Longitude and latitude, each in [0, 1].
#[inline(never)]
fn sphere_uv(n: Vec3A) -> Vec2 {
    Vec2::new(
        n.z.atan2(n.x) * (0.5 / std::f32::consts::PI) + 0.5,
        n.y.clamp(-1.0, 1.0).acos() * std::f32::consts::FRAC_1_PI,
    )
}
