//! A desk fan that blows to +Z; its rotor turns about the Z axis through the origin, radius 1.25.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::{Affine3A, Quat, Vec2, Vec3};

use crate::Mesh;
use crate::shape::{Vertex, arc, lathe, surface, tube};

/// Parts by material; `blades` and `hub` turn, `cage` and `stand` stay.
pub struct Fan {
    pub blades: Mesh,
    pub hub: Mesh,
    pub cage: Mesh,
    pub stand: Mesh,
}

/// A fan whose foot stands `height` below its axis.
pub fn fan(height: f32) -> Fan {
    let lying = Affine3A::from_rotation_x(FRAC_PI_2);
    let mut nose = vec![Vec2::new(0.0, -0.16), Vec2::new(0.27, -0.16)];
    nose.extend(arc(Vec2::new(0.1, 0.06), 0.17, 0.0, 60.0, 6));
    nose.push(Vec2::new(0.0, 0.24));
    let motor = [[0.0, -0.75], [0.2, -0.75], [0.34, -0.6], [0.36, -0.3], [0.1, -0.24], [0.0, -0.24]];
    let mut stand = lathe(&motor.map(Vec2::from), 36).transformed(lying);
    stand.append(tube(&[Vec3::new(0.0, 0.1 - height, -0.5), Vec3::new(0.0, -0.2, -0.5)], &[0.1, 0.1], 20));
    let foot = [[0.0, 0.0], [0.85, 0.0], [0.87, 0.05], [0.82, 0.12], [0.2, 0.2], [0.12, 0.35], [0.0, 0.35]];
    stand.append(lathe(&foot.map(Vec2::from), 48).translated(Vec3::new(0.0, -height, -0.5)));
    Fan {
        blades: Mesh::joined((0..BLADES).map(blade)),
        hub: lathe(&nose, 40).transformed(lying),
        cage: cage(),
        stand,
    }
}

const BLADES: u32 = 6;

/// A pitched blade with round corners; u − `index` runs across it, v along the radius, both over [0, 1].
fn blade(index: u32) -> Mesh {
    let (columns, rows) = (12, 16);
    let turn = Quat::from_rotation_z(TAU * index as f32 / BLADES as f32);
    surface(columns, rows, |i, j| {
        let (u, v) = (i as f32 / columns as f32, j as f32 / rows as f32);
        let radius = 0.22 + 1.0 * v;
        // Narrow at the hub, wide further out, rounded at the tip.
        let tip = (1.0 - ((v - 0.72) / 0.3).max(0.0).powi(2)).max(0.1);
        let half = (0.13 + 0.27 * v) * tip.sqrt();
        let (across, pitch) = ((2.0 * u - 1.0) * half, 0.62 - 0.3 * v);
        let place = Vec3::new(across * pitch.cos(), radius, across * pitch.sin());
        Vertex { position: turn * place, normal: Vec3::Z, uv: Vec2::new(index as f32 + 0.999 * u, v) }
    })
    .smoothed()
}

/// Wire hoops and ribs before and behind the rotor.
fn cage() -> Mesh {
    let wire = 0.018;
    let lying = Affine3A::from_rotation_x(FRAC_PI_2);
    let hoop = |radius: f32, z: f32, wire: f32| {
        let ring = arc(Vec2::new(radius, 0.0), wire, -180.0, 180.0, 8);
        lathe(&ring, 72).transformed(lying).translated(Vec3::Z * z)
    };
    let mut mesh = hoop(1.42, 0.0, 0.04);
    for side in [-1.0, 1.0] {
        for (radius, depth) in [(0.34, 0.36), (0.72, 0.34), (1.1, 0.25)] {
            mesh.append(hoop(radius, side * depth, wire));
        }
        for k in 0..10 {
            let turn = Quat::from_rotation_z(TAU * (k as f32 + 0.5) / 10.0);
            let path = [[0.34, 0.36], [0.72, 0.34], [1.1, 0.25], [1.34, 0.12], [1.42, 0.0]]
                .map(|[radius, depth]| turn * Vec3::new(0.0, radius, side * depth));
            mesh.append(tube(&path, &[wire], 6));
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotor_turns_without_touching_the_cage_or_the_motor() {
        let fan = fan(2.0);
        // Wires run straight from each of these places to the next: distance from the axis, depth.
        let wires = [[0.34, 0.36], [0.72, 0.34], [1.1, 0.25], [1.34, 0.12]].map(Vec2::from);
        for p in fan.blades.positions {
            let (radius, depth) = (p.truncate().length(), p.z.abs());
            let after = wires.iter().position(|w| w.x >= radius).expect("inside the last hoop").max(1);
            let (a, b) = (wires[after - 1], wires[after]);
            let wire = a.y + (b.y - a.y) * ((radius - a.x) / (b.x - a.x)).max(0.0);
            assert!(depth < wire - 0.02, "{p} is outside of the wires at {wire}");
        }
        assert!(fan.hub.positions.iter().all(|p| p.z > -0.2 && p.z < 0.34));
    }
}
