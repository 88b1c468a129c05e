//! What is screwed to the wall of the shower booth.

use glam::{Affine3A, Vec2, Vec3};

use super::LOW;
use crate::builtin::bathware;
use crate::shape::{rounded_box, tube};
use crate::{Material, MaterialIndex, Mesh, Scene};

/// Mixer on the back wall, rail with the shower head, and the hose between them.
pub fn fittings(scene: &mut Scene, chrome: MaterialIndex) {
    let wall = LOW.z;
    let across = |x: f32, length: f32, radius: f32, at: Vec3| {
        tube(&[at + Vec3::X * x, at + Vec3::X * (x + length)], &[radius], 32)
    };
    let mixer = Vec3::new(0.0, 0.66, wall + 0.06);
    let body = across(-0.09, 0.18, 0.02, mixer);
    let knobs = [across(-0.135, 0.04, 0.026, mixer), across(0.095, 0.04, 0.026, mixer)];
    let pipes = [-0.06, 0.06].map(|x| {
        let at = mixer + Vec3::X * x;
        let rosette = tube(&[Vec3::new(at.x, at.y, wall), Vec3::new(at.x, at.y, wall + 0.008)], &[0.03], 32);
        Mesh::joined([rosette, tube(&[Vec3::new(at.x, at.y, wall + 0.008), at], &[0.011], 24)])
    });
    let rail = Vec3::new(-0.34, 0.0, wall + 0.05);
    let pole = tube(&[rail + Vec3::Y * 0.62, rail + Vec3::Y * 1.45], &[0.01], 24);
    let bracket = [0.66, 1.4].map(|y| tube(&[Vec3::new(rail.x, y, wall), rail + Vec3::Y * y], &[0.014], 24));
    // The head looks forward and down; its handle runs to the holder on the rail.
    let holder = rail + Vec3::new(0.0, 0.8, 0.02);
    let neck = holder + Vec3::new(0.03, 0.1, 0.08);
    let handle = tube(&[holder - Vec3::new(0.008, 0.06, 0.015), holder, neck], &[0.011, 0.012, 0.014], 24);
    let head = [[0.0, 0.0], [0.052, 0.0], [0.056, 0.006], [0.05, 0.02], [0.02, 0.034], [0.0, 0.036]];
    let turn = Affine3A::from_translation(neck + Vec3::new(0.002, -0.006, 0.012))
        * Affine3A::from_rotation_z(0.25)
        * Affine3A::from_rotation_x(-0.9);
    let rose = bathware::turned_body(&head, 48).transformed(turn);
    let clip = rounded_box(Vec3::new(0.018, 0.022, 0.024), 0.008, 2).translated(holder - Vec3::Z * 0.008);
    let metal = [body, pole, handle, rose, clip];
    scene.add_mesh(Mesh::joined(metal.into_iter().chain(knobs).chain(pipes).chain(bracket)), chrome);

    let rubber = scene.add_material(Material::diffuse("nozzles", Vec3::splat(0.08)));
    let nozzles = (0..3).flat_map(|ring: u32| {
        (0..6 * (ring + 1)).map(move |k| {
            let angle = std::f32::consts::TAU * k as f32 / (6 * (ring + 1)) as f32;
            let at = Vec2::from_angle(angle) * (0.014 * (ring + 1) as f32);
            rounded_box(Vec3::splat(0.0025), 0.0025, 2)
                .translated(Vec3::new(at.x, 0.0, at.y))
                .transformed(turn)
        })
    });
    scene.add_mesh(Mesh::joined(nozzles), rubber);

    let hose = scene.add_material(Material::conductor("steel hose", Vec3::splat(0.6), 0.2));
    let (from, to) = (holder - Vec3::new(0.008, 0.06, 0.015), mixer - Vec3::Y * 0.02);
    let points = [
        Vec2::new(from.x, from.y),
        Vec2::new(-0.33, 0.62),
        Vec2::new(-0.24, 0.51),
        Vec2::new(-0.09, 0.52),
        Vec2::new(to.x, to.y),
    ];
    // Curves of the hose are drawn to the right of x = −1, as radii may not be negative.
    let shifted: Vec<Vec2> = points.iter().map(|p| *p + Vec2::X).collect();
    let curve = bathware::smooth(&shifted, 10);
    let last = (curve.len() - 1) as f32;
    let path: Vec<Vec3> = curve
        .iter()
        .enumerate()
        .map(|(k, p)| Vec3::new(p.x - 1.0, p.y, from.z + (to.z - from.z) * k as f32 / last))
        .collect();
    // Ribbed.
    let radii: Vec<f32> = (0..path.len()).map(|k| if k % 2 == 0 { 0.0075 } else { 0.0065 }).collect();
    scene.add_mesh(tube(&path, &radii, 16), hose);
}
