//! Leaves: four triangles or four spheres, lane by lane.

use glam::{Vec3A, Vec4};

use super::lanes::Lanes;
use super::node::NOTHING;
use super::ray::Hit;

/// Four triangles. Unused lanes have a zero normal, so that no ray hits them.
#[derive(Debug, Clone)]
pub struct Triangles {
    vertex: [Vec4; 3],
    edge1: [Vec4; 3],
    edge2: [Vec4; 3],
    normal: [Vec4; 3],
    primitives: [u32; 4],
}

/// Distances, scaled barycentric coordinates and the lanes that are hit.
struct Crossing {
    t: Vec4,
    u: Vec4,
    v: Vec4,
    mask: u32,
}

#[inline(always)]
fn dot(a: &[Vec4; 3], b: &[Vec4; 3]) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: &[Vec4; 3], b: &[Vec4; 3]) -> [Vec4; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Puts up to four vectors side by side.
fn lanes(vectors: impl Iterator<Item = Vec3A>) -> [Vec4; 3] {
    let mut out = [Vec4::ZERO; 3];
    for (lane, vector) in vectors.enumerate() {
        for (axis, row) in out.iter_mut().enumerate() {
            row[lane] = vector[axis];
        }
    }
    out
}

impl Triangles {
    /// At most four triangles, each with its index.
    pub fn new(members: &[(u32, [Vec3A; 3])]) -> Self {
        let mut primitives = [NOTHING; 4];
        for (slot, (index, _)) in primitives.iter_mut().zip(members) {
            *slot = *index;
        }
        let edge1 = lanes(members.iter().map(|(_, v)| v[1] - v[0]));
        let edge2 = lanes(members.iter().map(|(_, v)| v[2] - v[0]));
        let normal = cross(&edge1, &edge2);
        Self { vertex: lanes(members.iter().map(|(_, v)| v[0])), edge1, edge2, normal, primitives }
    }

    /// Möller and Trumbore (1997) with a stored normal. Edges are widened by two parts in a million, so that rays do
    /// not slip between neighbours.
    #[inline(always)]
    fn cross(&self, ray: &Lanes, limit: f32) -> Crossing {
        let d = &ray.direction;
        let to_vertex =
            [self.vertex[0] - ray.origin[0], self.vertex[1] - ray.origin[1], self.vertex[2] - ray.origin[2]];
        let det = dot(&self.normal, d);
        let inverse = det.recip(); // infinite for parallel rays and unused lanes: every test below then fails
        let r = cross(&to_vertex, d);
        let u = dot(&r, &self.edge2) * inverse;
        let v = -dot(&r, &self.edge1) * inverse;
        let t = dot(&to_vertex, &self.normal) * inverse;
        let slack = Vec4::splat(-2e-6);
        let inside = u.min(v).min(Vec4::ONE - u - v).cmpge(slack);
        let mask = (inside & t.cmpgt(Vec4::ZERO) & t.cmplt(Vec4::splat(limit))).bitmask();
        Crossing { t, u, v, mask }
    }

    /// Shortens `best` to the nearest triangle hit.
    #[inline(always)]
    pub fn closest(&self, ray: &Lanes, best: &mut Hit) {
        let crossing = self.cross(ray, best.t);
        let mut mask = crossing.mask;
        if mask == 0 {
            return;
        }
        // As arrays: a lane that is chosen by number would be a jump.
        let [t, u, v] = [crossing.t, crossing.u, crossing.v].map(|lanes| lanes.to_array());
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize & 3;
            mask &= mask - 1;
            if t[lane] < best.t {
                *best = Hit { t: t[lane], primitive: self.primitives[lane], u: u[lane], v: v[lane] };
            }
        }
    }

    /// Whether any of the triangles is hit.
    #[inline(always)]
    pub fn any(&self, ray: &Lanes, limit: f32) -> bool {
        self.cross(ray, limit).mask != 0
    }
}

/// Four spheres. Unused lanes have a negative squared radius, so that no ray hits them.
#[derive(Debug, Clone)]
pub struct Spheres {
    center: [Vec4; 3],
    squared_radius: Vec4,
    primitives: [u32; 4],
}

impl Spheres {
    /// At most four spheres, each with its index.
    pub fn new(members: &[(u32, Vec3A, f32)]) -> Self {
        let mut primitives = [NOTHING; 4];
        let mut squared_radius = Vec4::splat(-1.0);
        for (lane, (index, _, radius)) in members.iter().enumerate() {
            primitives[lane] = *index;
            squared_radius[lane] = radius * radius;
        }
        Self { center: lanes(members.iter().map(|m| m.1)), squared_radius, primitives }
    }

    /// Distances of both roots and the lanes whose discriminant is not negative. Precise for far and for large spheres
    /// (Haines et al. 2019).
    #[inline(always)]
    fn roots(&self, ray: &Lanes) -> (Vec4, Vec4, u32) {
        let d = &ray.direction;
        let f =
            [ray.origin[0] - self.center[0], ray.origin[1] - self.center[1], ray.origin[2] - self.center[2]];
        let b = -dot(&f, d);
        let l = [f[0] + d[0] * b, f[1] + d[1] * b, f[2] + d[2] * b];
        let discriminant = self.squared_radius - dot(&l, &l);
        let hit = discriminant.cmpge(Vec4::ZERO).bitmask();
        let root = discriminant.max(Vec4::ZERO).map(f32::sqrt);
        let c = dot(&f, &f) - self.squared_radius;
        let q = b + Vec4::select(b.cmplt(Vec4::ZERO), -root, root);
        let other = c / q; // q = 0 only at a grazing touch of the origin; the quotient then fails every test
        (q.min(other), q.max(other), hit)
    }

    /// Shortens `best` to the nearest sphere hit.
    #[inline(always)]
    pub fn closest(&self, ray: &Lanes, best: &mut Hit) {
        let (near, far, mut mask) = self.roots(ray);
        if mask == 0 {
            return;
        }
        let (near, far) = (near.to_array(), far.to_array());
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize & 3;
            mask &= mask - 1;
            let t = if near[lane] > 0.0 { near[lane] } else { far[lane] };
            if t > 0.0 && t < best.t {
                *best = Hit { t, primitive: self.primitives[lane], u: 0.0, v: 0.0 };
            }
        }
    }

    /// Whether any of the spheres is hit.
    #[inline(always)]
    pub fn any(&self, ray: &Lanes, limit: f32) -> bool {
        let mut best = Hit { t: limit, primitive: NOTHING, u: 0.0, v: 0.0 };
        self.closest(ray, &mut best);
        best.primitive != NOTHING
    }
}
