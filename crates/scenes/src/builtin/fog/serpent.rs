//! The serpent's body: a tapering tube along a coil, keeled scales, belly plates and a crest of spikes.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::spine::{Joint, Station, stations};
use crate::Mesh;
use crate::hash::Placement;
use crate::shape::{LeafShape, Vertex, surface, tube};

/// Half the angle, measured from the back, over which scales grow; the belly is left to plates.
const SCALED: f32 = 2.25;

/// The coil, from the tip of the tail to where the head sits; it lies on a disc of radius 1.35 at `floor` above the
/// origin and rises to about 2.8 over that.
pub fn coil(floor: f32) -> Vec<Station> {
    // Angle from +Z towards +X in degrees, distance from the axis, height, thickness.
    let ring = [
        [-72.0, 1.62, -0.62, 0.012],
        [-62.0, 1.56, -0.3, 0.04],
        [-47.0, 1.38, 0.03, 0.07],
        [-22.0, 1.12, 0.13, 0.1],
        [12.0, 1.0, 0.14, 0.135],
        [55.0, 0.98, 0.175, 0.17],
        [100.0, 0.98, 0.215, 0.21],
        [150.0, 0.97, 0.255, 0.25],
        [200.0, 0.96, 0.29, 0.285],
        [250.0, 0.95, 0.35, 0.31],
        [300.0, 0.93, 0.52, 0.33],
        [345.0, 0.82, 0.78, 0.34],
        [395.0, 0.69, 1.05, 0.32],
        [450.0, 0.55, 1.36, 0.3],
    ];
    let mut joints: Vec<Joint> = ring
        .iter()
        .map(|&[angle, distance, height, radius]| {
            let (sin, cos) = f32::to_radians(angle).sin_cos();
            let out = Vec3::new(sin, 0.0, cos);
            // Where the tail hangs over the edge its back looks outwards.
            let upright = if height < 0.0 { 0.2 } else { 1.0 };
            Joint {
                at: out * distance + Vec3::Y * (floor + height),
                radius,
                back: out * 0.55 + Vec3::Y * upright,
            }
        })
        .collect();
    let neck = [
        ([0.25, 1.72, -0.4], 0.28, [0.75, 0.45, -0.5]),
        ([-0.02, 2.06, -0.42], 0.25, [0.5, 0.25, -0.8]),
        ([-0.2, 2.4, -0.22], 0.225, [0.45, 0.2, -0.85]),
        ([-0.3, 2.68, 0.02], 0.2, [0.3, 0.8, -0.6]),
        ([-0.46, 2.8, 0.34], 0.185, [0.1, 1.0, -0.1]),
    ];
    joints.extend(neck.iter().map(|&(at, radius, back)| Joint {
        at: Vec3::from(at) + Vec3::Y * floor,
        radius,
        back: Vec3::from(back),
    }));
    stations(&joints, 120)
}

/// Skin with raised plates across the belly.
pub fn skin(spine: &[Station]) -> Mesh {
    let (columns, stride) = (40, 4);
    let rows = (spine.len() as u32 - 1) / stride;
    surface(columns, rows, |i, j| {
        let s = &spine[(j * stride) as usize];
        let angle = TAU * (i % columns) as f32 / columns as f32 - PI;
        // A plate rises slowly and ends in a step towards the tail.
        let phase = (s.length / (0.28 * s.radius.max(0.05))).fract();
        let belly = ((angle.abs() - SCALED) / 0.3).clamp(0.0, 1.0);
        let swell = 1.0 + belly * (0.07 * phase - 0.05);
        let out = s.outward(angle);
        Vertex {
            position: s.at + out * (s.radius * swell),
            normal: out,
            uv: Vec2::new(angle * 0.3, s.length),
        }
    })
    .smoothed()
}

/// Overlapping scales in staggered rows; the integer part of u numbers them.
pub fn scales(spine: &[Station]) -> Mesh {
    let across = 20;
    let mut placement = Placement::new(41);
    let mut mesh = Mesh::default();
    let (mut next, mut row, mut number) = (0.0, 0, 0);
    for s in spine.iter().filter(|s| s.radius > 0.03) {
        if s.length < next {
            continue;
        }
        next = s.length + 0.21 * s.radius;
        row += 1;
        for k in 0..across {
            let angle = SCALED * (2.0 * (k as f32 + 0.5 * (row & 1) as f32) / across as f32 - 1.0);
            let out = s.outward(angle);
            let size = s.radius * placement.range(0.9, 1.1);
            let lift = placement.range(0.16, 0.3);
            let scale = LeafShape {
                base: s.at + out * (s.radius * 0.985),
                along: out * lift - s.forward,
                up: out,
                length: 0.46 * size,
                width: 0.35 * size,
                droop: 0.12,
                // The keel is higher than the rims.
                fold: -0.16,
            };
            mesh.append(scale.mesh(number));
            number += 1;
        }
    }
    mesh
}

/// Curved spikes along the back, largest over the thickest part.
pub fn crest(spine: &[Station]) -> Mesh {
    let mut mesh = Mesh::default();
    let mut next = 0.25;
    for s in spine.iter().filter(|s| s.radius > 0.035) {
        if s.length < next {
            continue;
        }
        next = s.length + 0.42 * s.radius + 0.02;
        let height = 0.2 * s.radius + 0.55 * s.radius * (0.75 + 0.25 * (9.0 * s.length).sin());
        let path: Vec<Vec3> = (0..=6)
            .map(|i| {
                let t = i as f32 / 6.0;
                s.at + s.back * (0.9 * s.radius + height * t) - s.forward * (height * 0.75 * t * t)
            })
            .collect();
        let radii: Vec<f32> = (0..=6).map(|i| s.radius * (0.15 * (1.0 - i as f32 / 6.0) + 0.006)).collect();
        mesh.append(tube(&path, &radii, 8));
    }
    mesh
}
