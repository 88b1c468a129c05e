//! A spoked wheel that turns about the Z axis through the origin, radius 1.62.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::{Affine3A, Quat, Vec2, Vec3};

use crate::Mesh;
use crate::shape::{arc, cuboid, lathe, rounded_box, tube};

/// Distance of the tyre's middle from the axis, and half its thickness.
const TYRE: (f32, f32) = (1.5, 0.12);

/// Parts by material; all but `stand` turn.
pub struct Wheel {
    pub tyre: Mesh,
    /// Rim, spokes and hub.
    pub metal: Mesh,
    pub reflectors: Mesh,
    pub stand: Mesh,
}

/// Squares of the tyre's texture per unit of u, so that `count` of them go around.
pub fn squares_around(count: u32) -> f32 {
    count as f32 / (TAU * (TYRE.0 + TYRE.1))
}

/// A wheel whose stand reaches `height` below its axis.
pub fn wheel(height: f32) -> Wheel {
    let lying = Affine3A::from_rotation_x(FRAC_PI_2);
    let tyre = lathe(&arc(Vec2::new(TYRE.0, 0.0), TYRE.1, -180.0, 180.0, 16), 96).transformed(lying);
    let rim =
        [[1.28, -0.07], [1.34, -0.1], [1.44, -0.1], [1.44, 0.1], [1.34, 0.1], [1.28, 0.07], [1.28, -0.07]];
    let axle = [[0.0, -0.3], [0.07, -0.3], [0.07, -0.16], [0.2, -0.14], [0.2, -0.1], [0.1, -0.07]];
    let mirrored = axle.iter().rev().map(|&[r, y]| [r, -y]);
    let hub: Vec<Vec2> = axle.into_iter().chain(mirrored).map(Vec2::from).collect();
    let mut metal = Mesh::joined([
        lathe(&rim.map(Vec2::from), 96).transformed(lying),
        lathe(&hub, 32).transformed(lying),
    ]);
    let spokes = 20;
    let mut reflectors = Mesh::default();
    for k in 0..spokes {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let at = TAU * k as f32 / spokes as f32;
        // Spokes leave the hub aslant, by turns to either side.
        let start = Quat::from_rotation_z(at + 0.35 * side) * Vec3::new(0.0, 0.16, 0.12 * side);
        let end = Quat::from_rotation_z(at) * Vec3::new(0.0, 1.3, 0.02 * side);
        metal.append(tube(&[start, end], &[0.02, 0.02], 8));
        if k % 5 == 0 {
            let plate = rounded_box(Vec3::new(0.1, 0.22, 0.03), 0.025, 2);
            let place = Affine3A::from_rotation_z(at) * Affine3A::from_translation(Vec3::new(0.0, 0.95, 0.0));
            reflectors.append(plate.transformed(place));
        }
    }
    let post = |z: f32| cuboid(Vec3::new(-0.1, -height, z - 0.05), Vec3::new(0.1, 0.12, z + 0.05));
    let plinth = rounded_box(Vec3::new(0.9, 0.1, 0.55), 0.06, 2).translated(Vec3::Y * (0.1 - height));
    Wheel { tyre, metal, reflectors, stand: Mesh::joined([post(-0.32), post(0.32), plinth]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wheel_turns_between_its_posts_and_over_its_plinth() {
        let wheel = wheel(1.95);
        for p in [wheel.tyre, wheel.metal, wheel.reflectors].iter().flat_map(|mesh| &mesh.positions) {
            let radius = p.truncate().length();
            // Only the axle reaches into the posts.
            assert!(radius < 0.08 || p.z.abs() < 0.27, "{p}");
            assert!(radius < 1.75, "{p}");
        }
    }
}
