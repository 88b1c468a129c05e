use glam::{Vec2, Vec3};

use super::surface::{Vertex, surface};
use crate::Mesh;

/// Control points of a bicubic Bézier patch: four rows upwards, each from left to right, seen from outside.
type Patch = [[Vec3; 4]; 4];

/// Profiles of the parts that are turned about the axis, from bottom to top: (radius, height) of their control points.
const PROFILES: [[[f32; 2]; 4]; 6] = [
    // Bottom.
    [[0.0, 0.0], [1.425, 0.0], [1.5, 0.075], [1.5, 0.15]],
    // Lower and upper body.
    [[1.5, 0.15], [1.5, 0.225], [2.0, 0.45], [2.0, 0.9]],
    [[2.0, 0.9], [2.0, 1.35], [1.75, 1.875], [1.5, 2.4]],
    // Rim, over the edge to the inside.
    [[1.5, 2.4], [1.4375, 2.53125], [1.3375, 2.53125], [1.4, 2.4]],
    // Lid and its knob.
    [[1.3, 2.4], [1.3, 2.55], [0.4, 2.55], [0.2, 2.7]],
    [[0.2, 2.7], [0.0, 2.85], [0.8, 3.15], [0.0, 3.15]],
];

/// Where a quarter circle's inner control points lie, as a share of the radius. Rounder would be 0.5523.
const ROUND: f32 = 0.56;

/// Cross-sections of the handle and the spout, from their root on: (x, height, half width) on the inside (handle) or
/// upside (spout), then (x, height) on the other side.
type Section = [f32; 5];

/// From the top of the body to its flank; the last section of each patch is the first of the next.
const HANDLE: [Section; 7] = [
    [-1.6, 2.025, 0.3, -1.5, 2.25],
    [-2.3, 2.025, 0.3, -2.5, 2.25],
    [-2.7, 2.025, 0.3, -3.0, 2.25],
    [-2.7, 1.8, 0.3, -3.0, 1.8],
    [-2.7, 1.575, 0.3, -3.0, 1.35],
    [-2.5, 1.125, 0.3, -2.65, 0.9375],
    [-2.0, 0.9, 0.3, -1.9, 0.6],
];

/// From the body to the tip, and over the lip to the inside.
const SPOUT: [Section; 7] = [
    [1.7, 1.425, 0.66, 1.7, 0.6],
    [2.6, 1.425, 0.66, 3.1, 0.825],
    [2.3, 2.1, 0.25, 2.4, 2.025],
    [2.7, 2.4, 0.25, 3.3, 2.4],
    [2.8, 2.475, 0.25, 3.525, 2.49375],
    [2.9, 2.475, 0.15, 3.45, 2.5125],
    [2.8, 2.4, 0.15, 3.2, 2.4],
];

/// The Utah teapot as Martin Newell modelled it in 1975, with the bottom that was added later: 32 bicubic Bézier
/// patches, each as `cells` × `cells` (at least 2 × 2) cells with smooth normals.
///
/// It stands on the origin with its axis along Y, the spout towards +X and the handle towards −X, 3.15 units high; the
/// body's radius is 2. It is not one closed surface: lid and rim are 0.1 apart, and handle and spout start inside the
/// body. Texture coordinates run from 0 to 1 over each patch.
#[must_use]
pub fn teapot(cells: u32) -> Mesh {
    Mesh::joined(patches().iter().map(|patch| tessellated(patch, cells.max(2))))
}

fn patches() -> Vec<Patch> {
    let turned = PROFILES.iter().flat_map(|profile| (0..4).map(|quarter| quarter_turn(profile, quarter)));
    let swept = [&HANDLE, &SPOUT].into_iter().flat_map(|sections| {
        [0, 3].into_iter().flat_map(|first| {
            let near: Patch = std::array::from_fn(|row| half_section(sections[first + row]));
            [near, mirrored(&near)]
        })
    });
    turned.chain(swept).collect()
}

/// A quarter of a part that is turned about the axis.
fn quarter_turn(profile: &[[f32; 2]; 4], quarter: u32) -> Patch {
    profile.map(|[radius, height]| {
        [[0.0, 1.0], [ROUND, 1.0], [1.0, ROUND], [1.0, 0.0]].map(|[x, z]| {
            let (x, z) = (radius * x, radius * z);
            // Exactly, so that the quarters meet.
            let (x, z) = match quarter {
                0 => (x, z),
                1 => (z, -x),
                2 => (-x, -z),
                _ => (-z, x),
            };
            Vec3::new(x, height, z)
        })
    })
}

/// The half of a cross-section at z ≥ 0.
fn half_section([x, y, half_width, other_x, other_y]: Section) -> [Vec3; 4] {
    let (one, other) = (Vec3::new(x, y, 0.0), Vec3::new(other_x, other_y, 0.0));
    let out = Vec3::Z * half_width;
    [one, one + out, other + out, other]
}

/// The patch on the other side of the plane z = 0; rows are reversed, as a mirror exchanges left and right.
fn mirrored(patch: &Patch) -> Patch {
    let flip = |p: Vec3| Vec3::new(p.x, p.y, -p.z);
    patch.map(|[a, b, c, d]| [flip(d), flip(c), flip(b), flip(a)])
}

/// Weights of the four control points of a cubic at `t` in [0, 1].
fn weights(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// Derivatives of [`weights`].
fn slopes(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
}

fn blend(patch: &Patch, across: [f32; 4], up: [f32; 4]) -> Vec3 {
    let row = |points: &[Vec3; 4]| points.iter().zip(across).fold(Vec3::ZERO, |sum, (p, w)| sum + *p * w);
    patch.iter().zip(up).fold(Vec3::ZERO, |sum, (points, w)| sum + row(points) * w)
}

/// Outward direction at (u, v); any length above 0.
fn normal(patch: &Patch, u: f32, v: f32) -> Vec3 {
    let at = |v: f32| blend(patch, slopes(u), weights(v)).cross(blend(patch, weights(u), slopes(v)));
    // At a pole the whole row is one point and has no direction: look a little further in. Far more than rounding
    // leaves of a derivative of length 1, far less than any other place of the surface has.
    let here = at(v);
    if here.length_squared() > 1e-8 { here } else { at(v + if v < 0.5 { 1e-2 } else { -1e-2 }) }
}

fn tessellated(patch: &Patch, cells: u32) -> Mesh {
    surface(cells, cells, |i, j| {
        let (u, v) = (i as f32 / cells as f32, j as f32 / cells as f32);
        Vertex {
            position: blend(patch, weights(u), weights(v)),
            normal: normal(patch, u, v),
            uv: Vec2::new(u, v),
        }
    })
}

#[cfg(test)]
mod tests;
