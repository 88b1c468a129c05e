//! What a ray meets: points, normals and materials of primitives.

use glam::{Vec2, Vec3, Vec3A};
use noisefloor_scenes::{Color, Texture};

use crate::bsdf::{Event, Lobe, Specular};
use crate::bvh::{Hit, Ray};

/// No light, no attributes.
pub const NONE: u32 = u32::MAX;

/// A colour whose textures are set apart, so that constant ones are read without a branch on size.
#[derive(Debug, Clone)]
pub enum Tint {
    /// The same everywhere.
    Constant(Vec3A),
    /// By surface coordinates.
    Texture(Box<Texture>),
}

impl Tint {
    /// From the scene description.
    pub fn new(color: &Color) -> Self {
        match color {
            Color::Constant(c) => Self::Constant((*c).into()),
            Color::Texture(t) => Self::Texture(Box::new(t.clone())),
        }
    }

    /// Colour at surface coordinates.
    #[inline(always)]
    pub fn at(&self, uv: Vec2) -> Vec3A {
        match self {
            Self::Constant(c) => *c,
            Self::Texture(texture) => texture_at(texture, uv),
        }
    }
}

/// Kept out of line: textures are dear and rare, and the loop around them should stay small.
#[inline(never)]
fn texture_at(texture: &Texture, uv: Vec2) -> Vec3A {
    texture.eval(uv).into()
}

/// How a surface scatters.
#[derive(Debug, Clone)]
pub enum Scatter {
    /// Lambertian on both sides.
    Diffuse(Tint),
    /// Perfect mirror.
    Mirror(Vec3A),
    /// Smooth dielectric with this refractive index.
    Glass(f32),
    /// GGX with reflectance at normal incidence and α.
    Conductor(Tint, f32),
}

impl Scatter {
    /// The model at surface coordinates.
    #[inline(always)]
    pub fn at(&self, uv: Vec2) -> Event {
        match self {
            Self::Diffuse(tint) => Event::Lobe(Lobe::Diffuse { albedo: tint.at(uv) }),
            Self::Conductor(tint, alpha) => Event::Lobe(Lobe::Conductor { f0: tint.at(uv), alpha: *alpha }),
            Self::Mirror(reflectance) => Event::Specular(Specular::Mirror(*reflectance)),
            Self::Glass(ior) => Event::Specular(Specular::Glass(*ior)),
        }
    }
}

impl Event {
    /// The reflectance that is recorded as albedo.
    #[inline(always)]
    pub fn albedo(&self) -> Vec3A {
        match *self {
            Self::Lobe(Lobe::Diffuse { albedo: tint } | Lobe::Conductor { f0: tint, .. }) => tint,
            Self::Specular(specular) => specular.tint(),
        }
    }
}

/// A material ready for shading.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Scattering.
    pub scatter: Scatter,
    /// Radiance on the front side.
    pub emission: Vec3A,
    /// Whether `emission` is not zero.
    pub emits: bool,
}

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

/// A hit, seen from the side that the ray came from.
#[derive(Debug, Clone, Copy)]
pub struct Interaction {
    /// Point on the surface.
    pub point: Vec3A,
    /// Geometric normal on the viewer's side.
    pub geometric: Vec3A,
    /// Shading normal on the viewer's side: its cosine with the direction to the viewer is positive.
    pub normal: Vec3A,
    /// Whether the viewer is on the side to which the primitive's own geometric normal points.
    pub front: bool,
    /// Texture coordinates.
    pub uv: Vec2,
    /// See [`Geometry::clearance`].
    pub clearance: f32,
}

impl Interaction {
    /// Where a ray that leaves in direction `w` starts, clear of the surface.
    #[inline(always)]
    pub fn leave(&self, w: Vec3A) -> Vec3A {
        self.point + self.geometric * self.clearance.copysign(w.dot(self.geometric))
    }
}

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
