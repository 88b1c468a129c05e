//! A bat-like wing.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use crate::Mesh;
use crate::shape::{Vertex, surface, tube};

/// Bones and membrane of a wing whose shoulder is at the origin; `side` is +1 for a wing towards +X, −1 for its
/// mirror image. It spans about 2.3 outwards and 1.4 upwards and stands nearly across Z.
pub fn wing(side: f32) -> (Mesh, Mesh) {
    let at = |x: f32, y: f32, z: f32| Vec3::new(side * x, y, z);
    let (elbow, wrist) = (at(0.62, 0.62, -0.32), at(1.12, 1.3, -0.2));
    let arm = [Vec3::ZERO, at(0.32, 0.36, -0.2), elbow, at(0.85, 1.0, -0.3), wrist];
    // Control point and tip of each finger; the last "finger" is the line along which the membrane meets the body.
    let fingers = [
        (wrist, at(1.75, 1.6, -0.12), at(2.3, 0.75, -0.2)),
        (wrist, at(1.65, 0.95, -0.3), at(1.85, 0.02, -0.35)),
        (wrist, at(1.25, 0.6, -0.4), at(1.22, -0.42, -0.4)),
        (elbow, at(0.75, 0.1, -0.4), at(0.62, -0.5, -0.3)),
        (Vec3::ZERO, at(0.1, -0.2, -0.1), at(0.15, -0.5, 0.05)),
    ];
    let along = |k: usize, t: f32| {
        let (a, b, c) = fingers[k];
        a.lerp(b, t).lerp(b.lerp(c, t), t)
    };

    let mut bones = tube(&arm, &[0.075, 0.07, 0.06, 0.05, 0.045], 12);
    for k in 0..4 {
        let path: Vec<Vec3> = (0..=16).map(|i| along(k, i as f32 / 16.0)).collect();
        let radii: Vec<f32> = (0..=16).map(|i| 0.034 * (1.0 - i as f32 / 16.0) + 0.006).collect();
        bones.append(tube(&path, &radii, 8));
    }
    let claw: Vec<Vec3> = (0..=6)
        .map(|i| {
            let t = i as f32 / 6.0;
            wrist + at(0.02 - 0.1 * t * t, 0.26 * t, 0.12 * t)
        })
        .collect();
    bones.append(tube(&claw, &[0.04, 0.036, 0.031, 0.025, 0.018, 0.01, 0.004], 8));

    let membrane = Mesh::joined((0..4).map(|k| {
        panel(|u, v| {
            // The free edge is drawn in between two fingers.
            let reach = v * (1.0 - 0.5 * u * (1.0 - u) * v);
            let span = along(k, reach).lerp(along(k + 1, reach), u);
            let sag = 0.16 * (PI * u).sin() * v + 0.012 * (5.0 * PI * u).sin() * v;
            span - Vec3::Z * sag
        })
    }));
    (bones, membrane)
}

/// A smooth patch of `point(u, v)` over [0, 1]²; normals from differences.
fn panel(point: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let (columns, rows) = (28, 32);
    surface(columns, rows, |i, j| {
        let (u, v) = (i as f32 / columns as f32, j as f32 / rows as f32);
        // Where fingers share a joint the rows shrink to a point, so look a little off it.
        let (d, w) = (1e-2, v.max(0.03));
        let du = point((u + d).min(1.0), w) - point((u - d).max(0.0), w);
        let dv = point(u, (w + d).min(1.0)) - point(u, w - d);
        let position = point(u, v);
        Vertex { position, normal: du.cross(dv), uv: Vec2::new(position.x, position.y) }
    })
}
