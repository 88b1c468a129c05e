//! Things that stand, hang and lie about where people wash; lengths in metres, each standing on the origin unless it
//! says otherwise.

use std::f32::consts::{PI, TAU};

use glam::{Affine3A, Vec2, Vec3};

use crate::Mesh;
use crate::shape::{Vertex, cylinder, fan, lathe, rounded_box, surface, tube};

/// A smooth curve through `points` (Catmull–Rom), each piece in `steps` parts. Radii never fall below 0, so that the
/// curve can be a [`lathe`] profile.
pub fn smooth(points: &[Vec2], steps: u32) -> Vec<Vec2> {
    let at = |k: isize| points[k.clamp(0, points.len() as isize - 1) as usize];
    let mut curve = vec![points[0]];
    for k in 0..points.len() as isize - 1 {
        let [before, from, to, after] = [k - 1, k, k + 1, k + 2].map(at);
        for i in 1..=steps {
            if i == steps {
                curve.push(to);
                continue;
            }
            let t = i as f32 / steps as f32;
            let p = from * 2.0
                + (to - before) * t
                + (before * 2.0 - from * 5.0 + to * 4.0 - after) * (t * t)
                + (from * 3.0 - before - to * 3.0 + after) * (t * t * t);
            curve.push((0.5 * p).max(Vec2::new(0.0, f32::NEG_INFINITY)));
        }
    }
    curve
}

/// Turns a smooth profile of (radius, height) points, bottom to top, outside first.
pub fn turned_body(profile: &[[f32; 2]], segments: u32) -> Mesh {
    let points: Vec<Vec2> = profile.iter().copied().map(Vec2::from).collect();
    lathe(&smooth(&points, 4), segments)
}

/// A free-standing oval bathtub, 0.74 wide (X), 1.6 long (Z) and 0.6 high, on a plinth.
pub fn bathtub() -> Mesh {
    let profile = [
        [0.0, 0.0],
        [0.6, 0.0],
        [0.7, 0.03],
        [0.8, 0.2],
        [0.9, 0.42],
        [0.965, 0.56],
        [1.0, 0.585],
        [0.995, 0.6],
        [0.93, 0.6],
        [0.9, 0.575],
        [0.85, 0.4],
        [0.76, 0.22],
        [0.6, 0.14],
        [0.3, 0.12],
        [0.0, 0.12],
    ];
    turned_body(&profile, 72).transformed(Affine3A::from_scale(Vec3::new(0.37, 1.0, 0.8)))
}

/// A round wash basin of radius 0.22.
pub fn basin() -> Mesh {
    let profile = [
        [0.0, 0.0],
        [0.1, 0.0],
        [0.14, 0.02],
        [0.19, 0.07],
        [0.216, 0.13],
        [0.22, 0.142],
        [0.212, 0.145],
        [0.2, 0.125],
        [0.16, 0.065],
        [0.1, 0.03],
        [0.0, 0.022],
    ];
    turned_body(&profile, 48)
}

/// A tap `height` high whose spout reaches `reach` towards +Z, with a lever on top.
pub fn tap(height: f32, reach: f32) -> Mesh {
    let radius = 0.5 * reach;
    let mut path = vec![Vec3::Y * 0.01, Vec3::Y * (0.5 * (height - radius))];
    path.extend((0..=14).map(|i| {
        let (sin, cos) = (PI * i as f32 / 14.0).sin_cos();
        Vec3::new(0.0, height - radius + radius * sin, radius - radius * cos)
    }));
    path.push(Vec3::new(0.0, height - radius - 0.025, reach));
    let lever = tube(&[Vec3::new(0.0, 0.075, 0.0), Vec3::new(0.085, 0.105, 0.0)], &[0.008, 0.006], 12);
    let knob = rounded_box(Vec3::splat(0.012), 0.012, 3).translated(Vec3::new(0.085, 0.105, 0.0));
    let foot = turned_body(&[[0.0, 0.0], [0.03, 0.0], [0.029, 0.012], [0.02, 0.018], [0.0, 0.02]], 32);
    let neck = cylinder(0.019, 0.09, 32);
    Mesh::joined([tube(&path, &[0.0125], 24), lever, knob, foot, neck])
}

/// A bottle of `radius` and `height`: its body with round shoulders, and its cap.
pub fn bottle(radius: f32, height: f32) -> (Mesh, Mesh) {
    let (r, h) = (radius, height);
    let body = [
        [0.0, 0.0],
        [0.85 * r, 0.0],
        [r, 0.03 * h],
        [r, 0.35 * h],
        [r, 0.6 * h],
        [0.8 * r, 0.72 * h],
        [0.36 * r, 0.79 * h],
        [0.34 * r, 0.84 * h],
        [0.0, 0.84 * h],
    ];
    let cap = [[0.0, 0.0], [0.44 * r, 0.0], [0.45 * r, 0.02 * h], [0.42 * r, 0.15 * h], [0.0, 0.16 * h]];
    (turned_body(&body, 24), turned_body(&cap, 16).translated(Vec3::Y * (0.84 * h)))
}

/// A towel hung over a bar along X through the origin: `width` along X, `front` and `back` long, in folds that deepen
/// downwards. u runs along the bar, v along the cloth.
pub fn towel(width: f32, front: f32, back: f32) -> Mesh {
    let radius = 0.016;
    let over = PI * radius;
    let length = front + over + back;
    let at = |u: f32, v: f32| {
        let s = v * length;
        // Down the front, over the bar, down the back.
        let (y, z, drop, side) = if s < front {
            (s - front, radius, front - s, 1.0)
        } else if s < front + over {
            let (sin, cos) = ((s - front) / radius).sin_cos();
            (radius * sin, radius * cos, 0.0, 1.0)
        } else {
            (front + over - s, -radius, s - front - over, -0.3)
        };
        let depth = 0.018 * (drop / front).min(1.0);
        let fold = (TAU * 3.0 * u + 0.8 * (5.0 * u).sin()).sin() + 1.0;
        Vec3::new(width * (u - 0.5) * (1.0 - 0.08 * drop), y, z + side * depth * fold)
    };
    let (columns, rows) = (48, 40);
    surface(columns, rows, |i, j| {
        let (u, v) = (i as f32 / columns as f32, j as f32 / rows as f32);
        let e = 1e-3;
        let across = at(u + e, v) - at(u - e, v);
        let along = at(u, (v + e).min(1.0)) - at(u, (v - e).max(0.0));
        Vertex { position: at(u, v), normal: across.cross(along), uv: Vec2::new(width * u, length * v) }
    })
}

/// A rolled towel of `radius`, `length` along X, lying on the XZ plane.
pub fn roll(radius: f32, length: f32) -> Mesh {
    let (r, l) = (radius, length);
    let profile = [[0.0, 0.0], [0.8 * r, 0.0], [r, 0.03 * l], [r, 0.97 * l], [0.8 * r, l], [0.0, l]];
    turned_body(&profile, 32).transformed(Affine3A::from_rotation_z(-0.5 * PI)).translated(Vec3::new(
        -0.5 * l,
        r,
        0.0,
    ))
}

/// A round mirror about the origin that looks along +Z, `radius` large: the glass, and its rim of metal.
pub fn round_mirror(radius: f32) -> (Mesh, Mesh) {
    let n = 64;
    let rim: Vec<Vec3> = (0..n)
        .map(|i| {
            let (sin, cos) = (TAU * i as f32 / n as f32).sin_cos();
            Vec3::new(radius * cos, radius * sin, 0.0)
        })
        .collect();
    let glass = fan(Vec3::ZERO, &rim, Vec3::Z, |p| p.truncate());
    (glass, hoop(radius, 0.1 * radius).transformed(Affine3A::from_rotation_x(0.5 * PI)))
}

/// A ring of round wire about the Y axis: `radius` at its middle, the wire `thickness` wide.
pub fn hoop(radius: f32, thickness: f32) -> Mesh {
    let steps = 16;
    let profile: Vec<Vec2> = (0..=steps)
        .map(|i| {
            // Exactly the first point again at the end, so that the seam closes.
            let (sin, cos) = (TAU * (i % steps) as f32 / steps as f32).sin_cos();
            Vec2::new(radius + 0.5 * thickness * sin, -0.5 * thickness * cos)
        })
        .collect();
    lathe(&profile, 64)
}

/// A stool with a seat `width` wide, its top `height` over the floor.
pub fn stool(width: f32, height: f32) -> Mesh {
    let half = 0.5 * width;
    let seat =
        rounded_box(Vec3::new(half, 0.018, 0.75 * half), 0.012, 3).translated(Vec3::Y * (height - 0.018));
    let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let legs = corners.map(|(x, z)| {
        let top = Vec3::new(0.75 * half * x, height - 0.03, 0.55 * half * z);
        tube(&[Vec3::new(0.92 * half * x, 0.0, 0.68 * half * z), top], &[0.014, 0.018], 14)
    });
    Mesh::joined(legs.into_iter().chain([seat]))
}

#[cfg(test)]
mod tests;
