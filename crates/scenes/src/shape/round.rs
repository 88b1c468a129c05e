use std::f32::consts::{FRAC_PI_4, TAU};

use glam::{Mat3, Vec2, Vec3};

use super::surface::{Vertex, surface};
use crate::Mesh;

/// A box about the origin with all edges and corners rounded, closed. `half` is half its size, `radius` that of the
/// rounding (at most the smallest of `half`), `segments` (at least 1) the cells over half a quarter circle.
#[must_use]
pub fn rounded_box(half: Vec3, radius: f32, segments: u32) -> Mesh {
    let inner = (half - radius).max(Vec3::ZERO);
    let n = segments.max(1);
    // Offsets of the rounded part of an axis: tangents of equal steps of the angle from 45° to 0.
    let offset = |i: u32| radius * (FRAC_PI_4 * (n - i) as f32 / n as f32).tan();
    let along = |i: u32, inner: f32| if i <= n { -inner - offset(i) } else { inner + offset(2 * n + 1 - i) };
    // Each face is the one that looks along +Z, turned; columns are the images of X, Y and Z.
    let faces = [
        Mat3::IDENTITY,
        Mat3::from_cols(-Vec3::X, Vec3::Y, -Vec3::Z),
        Mat3::from_cols(-Vec3::Z, Vec3::Y, Vec3::X),
        Mat3::from_cols(Vec3::Z, Vec3::Y, -Vec3::X),
        Mat3::from_cols(Vec3::X, -Vec3::Z, Vec3::Y),
        Mat3::from_cols(Vec3::X, Vec3::Z, -Vec3::Y),
    ];
    Mesh::joined(faces.map(|turn| {
        let inner = (turn.transpose() * inner).abs();
        surface(2 * n + 1, 2 * n + 1, |i, j| {
            let flat = Vec3::new(along(i, inner.x), along(j, inner.y), inner.z + radius);
            let core = flat.clamp(-inner, inner);
            let normal = (flat - core).normalize();
            Vertex {
                position: turn * (core + normal * radius),
                normal: turn * normal,
                uv: Vec2::new(flat.x + inner.x, flat.y + inner.y),
            }
        })
    }))
}

/// A profile of (radius, height) points, bottom to top, turned about the Y axis. The outside is to the right of the
/// profile as it runs upwards. Smooth where neighbouring pieces of the profile meet at less than 40°, sharp elsewhere.
/// A radius of 0 at both ends closes it. u runs around (in lengths at the widest radius), v along the profile.
#[must_use]
pub fn lathe(profile: &[Vec2], segments: u32) -> Mesh {
    let n = segments.max(3);
    let widest = profile.iter().fold(0.0f32, |w, p| w.max(p.x));
    let directions: Vec<Vec2> = profile.windows(2).map(|w| (w[1] - w[0]).normalize_or_zero()).collect();
    let mut v = 0.0;
    let mut mesh = Mesh::default();
    for (k, piece) in profile.windows(2).enumerate() {
        let here = directions[k];
        let blend = |other: Option<&Vec2>| match other {
            Some(d) if d.dot(here) > SMOOTH => (*d + here).normalize(),
            _ => here,
        };
        let tangents = [blend(k.checked_sub(1).map(|p| &directions[p])), blend(directions.get(k + 1))];
        let length = piece[0].distance(piece[1]);
        mesh.append(surface(n, 1, |i, j| {
            // Exactly the first angle again at the end, so that the seam closes.
            let (sin, cos) = (TAU * (i % n) as f32 / n as f32).sin_cos();
            let (p, t) = (piece[j as usize], tangents[j as usize]);
            Vertex {
                position: Vec3::new(p.x * sin, p.y, p.x * cos),
                normal: Vec3::new(t.y * sin, -t.x, t.y * cos),
                uv: Vec2::new(TAU * widest * i as f32 / n as f32, v + length * j as f32),
            }
        }));
        v += length;
    }
    mesh
}

/// Cosine of the largest bend that is shaded as smooth.
const SMOOTH: f32 = 0.766;

/// Points of an arc for a [`lathe`] profile: around `center`, from angle `from` to `to` in degrees (0 points
/// outwards, 90 up), `steps` pieces.
#[must_use]
pub fn arc(center: Vec2, radius: f32, from: f32, to: f32, steps: u32) -> Vec<Vec2> {
    (0..=steps)
        .map(|i| {
            let angle = (from + (to - from) * i as f32 / steps as f32).to_radians();
            center + radius * Vec2::from_angle(angle)
        })
        .collect()
}

/// A closed upright cylinder standing on the origin, without bevel.
#[must_use]
pub fn cylinder(radius: f32, height: f32, segments: u32) -> Mesh {
    let profile = [[0.0, 0.0], [radius, 0.0], [radius, height], [0.0, height]];
    lathe(&profile.map(Vec2::from), segments)
}
