//! Vault and ends of the [`nave`](super): the apse, and the wall behind the camera.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Affine3A, Vec2, Vec3};

use super::plan::{AISLE, BAY, BAYS, FAR, NAVE, NEAR, VAULT};
use super::stones::Stones;
use crate::builtin::church::{Opening, band};
use crate::shape::{Vertex, cuboid, fan, quad, surface};
use crate::{Material, Scene};

/// Radius of the apse.
pub const APSE: f32 = 2.5;

const CHOIR_ARCH: Opening = Opening { half: APSE, sill: 0.0, spring: 5.6 };

/// Barrel vault with ribs, and the wall behind the camera with a round window.
pub fn vault(scene: &mut Scene, stones: &Stones) {
    let steps = 32;
    let barrel = surface(steps, BAYS, |i, j| {
        let radial = Vec2::from_angle(PI * (steps - i) as f32 / steps as f32);
        let (angle, along) = (i as f32 / steps as f32, BAY * j as f32);
        Vertex {
            position: (radial * NAVE + Vec2::Y * VAULT).extend(FAR + along),
            normal: -radial.extend(0.0),
            uv: Vec2::new(along, PI * NAVE * angle),
        }
    });
    scene.add_mesh(barrel, stones.plaster);
    for k in 0..=BAYS {
        let rib = band(NAVE - 0.22, NAVE + 0.05, 0.5);
        let at = Vec3::new(0.0, VAULT, NEAR - BAY * k as f32 + 0.25);
        scene.add_mesh(rib.translated(at), stones.voussoirs);
    }
    let height = VAULT + NAVE;
    let wall = quad(Vec3::new(AISLE, 0.0, NEAR), Vec3::X * (-2.0 * AISLE), Vec3::Y * height);
    scene.add_mesh(wall, stones.ashlar);
    let rose = scene.add_material(Material::emitter("rose window", Vec3::new(15.0, 14.0, 12.5)));
    let center = Vec3::new(0.0, VAULT - 0.6, NEAR - 0.02);
    let rim: Vec<Vec3> =
        (0..24).map(|k| center + (1.5 * Vec2::from_angle(TAU * k as f32 / 24.0)).extend(0.0)).collect();
    scene.add_mesh(fan(center, &rim, -Vec3::Z, |p| p.truncate()), rose);
}

/// End wall with the apse: half a drum under half a dome, three windows, steps and an altar.
pub fn choir(scene: &mut Scene, stones: &Stones) {
    let height = VAULT + NAVE;
    let size = Vec2::new(2.0 * AISLE, height);
    let at = Vec3::new(-AISLE, 0.0, FAR);
    scene.add_mesh(CHOIR_ARCH.face(size).translated(at), stones.ashlar);
    let ring = band(APSE - 0.1, APSE + 0.45, 0.4).translated(Vec3::new(0.0, CHOIR_ARCH.spring, FAR + 0.1));
    scene.add_mesh(ring, stones.voussoirs);

    let steps = 24;
    let around = |i: u32| Vec2::from_angle(PI * (1.0 - i as f32 / steps as f32));
    let drum = surface(steps, 1, |i, j| {
        let out = around(i);
        let y = CHOIR_ARCH.spring * j as f32;
        Vertex {
            position: Vec3::new(out.x * APSE, y, FAR - out.y * APSE),
            normal: Vec3::new(-out.x, 0.0, out.y),
            uv: Vec2::new(PI * APSE * i as f32 / steps as f32, y),
        }
    });
    scene.add_mesh(drum, stones.ashlar);
    let dome = surface(steps, 12, |i, j| {
        let (out, up) = (around(i), Vec2::from_angle(FRAC_PI_2 * j as f32 / 12.0));
        let radial = Vec3::new(out.x * up.x, up.y, -out.y * up.x);
        Vertex {
            position: Vec3::new(0.0, CHOIR_ARCH.spring, FAR) + radial * APSE,
            normal: -radial,
            uv: Vec2::new(i as f32 * 0.3, j as f32 * 0.3),
        }
    });
    scene.add_mesh(dome, stones.plaster);

    let east = scene.add_material(Material::emitter("east window", Vec3::new(6.8, 6.4, 5.2)));
    let blue = scene.add_material(Material::emitter("east window, blue", Vec3::new(1.0, 2.0, 4.4)));
    let amber = scene.add_material(Material::emitter("east window, amber", Vec3::new(4.8, 1.8, 0.5)));
    let lancet = Opening { half: 0.38, sill: 2.2, spring: 4.3 };
    for degrees in [-38.0f32, 0.0, 38.0] {
        // Before the wall by as much as a chord needs.
        let map = Affine3A::from_translation(Vec3::Z * FAR)
            * Affine3A::from_rotation_y(degrees.to_radians())
            * Affine3A::from_translation(Vec3::new(-0.5, 0.0, -APSE + 0.1));
        let (panes, bars) = lancet.glazing(1.0, 0.0, 7);
        for (mesh, material) in panes.into_iter().zip([east, amber, blue]) {
            scene.add_mesh(mesh.transformed(map), material);
        }
        scene.add_mesh(bars.transformed(map), stones.lead);
        let frame = band(lancet.half, lancet.half + 0.14, 0.12);
        let frame = frame.translated(Vec3::new(0.5, lancet.spring, 0.06));
        scene.add_mesh(frame.transformed(map), stones.voussoirs);
    }
    for k in 0..3 {
        let (half, rise) = (3.0 - 0.35 * k as f32, 0.16);
        let low = Vec3::new(-half, 0.0, FAR - APSE);
        let high = Vec3::new(half, rise * (k + 1) as f32, FAR + 2.6 - 0.4 * k as f32);
        scene.add_mesh(cuboid(low, high), stones.dressed);
    }
    let altar = cuboid(Vec3::new(-1.0, 0.48, FAR + 0.1), Vec3::new(1.0, 1.45, FAR + 0.9));
    scene.add_mesh(altar, stones.marble);
}
