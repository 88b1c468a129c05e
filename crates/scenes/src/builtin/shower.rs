//! A shower booth, in metres.
//!
//! Stands in for the shower booth of moon2013flash: a pane of glass, a glossy can, tiles, and the caustics that metal
//! and glass throw on them. A small spotlight in the booth makes the caustics sharp and lights what stands behind the
//! pane from its own side; a wide dim lamp outside lights the rest. The room is closed.

use glam::{Affine3A, Vec2, Vec3};

use super::bathware;
use crate::shape::{cuboid, cylinder, lathe, quad, rounded_box, tube};
use crate::texture::{Clouds, Streaks, Texture, Tiles};
use crate::{CameraSpec, Material, MaterialIndex, Mesh, Scene};

pub const ID: &str = "shower";

/// Least and greatest corner of the room.
const LOW: Vec3 = Vec3::new(-0.9, 0.0, -0.9);
const HIGH: Vec3 = Vec3::new(1.2, 2.3, 2.1);
/// Height of the tiled ledge along the back wall, and where it ends.
const LEDGE: f32 = 0.45;
const EDGE: f32 = -0.4;

pub fn shower() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(0.14, 1.06, 0.82),
        target: Vec3::new(0.05, 0.605, -0.65),
        up: Vec3::Y,
        vertical_fov_degrees: 32.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Shower booth, glass and caustics", camera);
    room(&mut scene);
    let chrome = scene.add_material(Material::conductor("chrome", Vec3::new(0.78, 0.79, 0.8), 0.05));
    lights(&mut scene, chrome);
    let glass = scene.add_material(Material::glass("glass", 1.5));
    pane(&mut scene, glass, chrome);
    fittings(&mut scene, chrome);
    can(&mut scene);
    on_the_ledge(&mut scene, glass, chrome);
    scene
}

fn room(scene: &mut Scene) {
    let tiles = |name: &str, size: Vec2, colors: [Vec3; 2], seed: u32| {
        let grout = Vec3::splat(0.62);
        let joint = 0.05 * size.x.min(size.y);
        Material::diffuse(name, Texture::Tiles(Tiles { size, joint, colors, clouding: 0.14, grout, seed }))
    };
    let (pale, deep) = (Vec3::new(0.55, 0.6, 0.6), Vec3::new(0.4, 0.5, 0.54));
    let wall = scene.add_material(tiles("wall tiles", Vec2::new(0.15, 0.1), [deep, pale], 3));
    let blue = [Vec3::new(0.05, 0.13, 0.26), Vec3::new(0.16, 0.36, 0.46)];
    let border = scene.add_material(tiles("glass mosaic", Vec2::splat(0.025), blue, 4));
    let stone = [Vec3::new(0.5, 0.46, 0.4), Vec3::new(0.64, 0.6, 0.53)];
    let ledge = scene.add_material(tiles("ledge tiles", Vec2::splat(0.15), stone, 5));
    let floor = scene.add_material(tiles("floor mosaic", Vec2::splat(0.05), blue, 6));
    let plaster = scene.add_material(Material::diffuse("plaster", Vec3::new(0.7, 0.68, 0.64)));
    let d = HIGH - LOW;
    let (x, y, z) = (Vec3::X * d.x, Vec3::Y * d.y, Vec3::Z * d.z);
    scene.add_mesh(quad(LOW, z, x), floor);
    scene.add_mesh(quad(LOW + y, x, z), plaster);
    for (foot, along) in [(LOW, x), (LOW + z, -z)] {
        // Rows of the wall's tiles lie as the ledge does.
        let levels = [-0.05, 0.75, 0.825, HIGH.y];
        for (k, material) in [wall, border, wall].into_iter().enumerate() {
            let up = Vec3::Y * (levels[k + 1] - levels[k]);
            scene.add_mesh(quad(foot + Vec3::Y * levels[k], along, up), material);
        }
    }
    scene.add_mesh(quad(LOW + x, z, y), wall);
    scene.add_mesh(quad(LOW + x + z, -x, y), plaster);
    let low = Vec3::new(LOW.x, 0.0, LOW.z);
    scene.add_mesh(cuboid(low, Vec3::new(HIGH.x, LEDGE, EDGE)), ledge);
}

/// A spotlight in the booth, to the left of the picture, and a panel under the ceiling outside.
fn lights(scene: &mut Scene, chrome: MaterialIndex) {
    // Nine centimetres wide, more than a metre away: small enough for sharp caustics, large enough to be met by
    // chance.
    let spot = scene.add_material(Material::emitter("spotlight", Vec3::new(560.0, 500.0, 410.0)));
    let (center, half) = (Vec3::new(-0.74, 1.2, -0.22), 0.045);
    let front = (Vec3::new(0.0, LEDGE, -0.62) - center).normalize();
    let (u, v) = front.any_orthonormal_pair();
    scene.add_mesh(quad(center - (u + v) * half, u * (2.0 * half), v * (2.0 * half)), spot);
    let back = center - front * 0.012;
    let housing = tube(&[back - front * 0.1, back], &[0.05, 0.08], 40);
    let foot = Vec3::new(LOW.x, back.y, back.z);
    let arm = tube(&[foot, back - front * 0.05], &[0.012], 16);
    scene.add_mesh(Mesh::joined([housing, arm]), chrome);

    let panel = scene.add_material(Material::emitter("ceiling panel", Vec3::new(3.4, 3.8, 4.3)));
    let corner = Vec3::new(-0.2, HIGH.y - 0.01, 0.9);
    scene.add_mesh(quad(corner, Vec3::X * 0.9, Vec3::Z * 0.7), panel);
}

/// The pane before the right half of the booth, 8 mm thick, held by clamps at the edge and with a handle.
fn pane(scene: &mut Scene, glass: MaterialIndex, chrome: MaterialIndex) {
    let (low, high) = (Vec3::new(0.17, 0.02, -0.204), Vec3::new(1.18, 1.9, -0.196));
    scene.add_mesh(cuboid(low, high), glass);
    let grip = |z: f32| {
        let at = |y: f32, z: f32| Vec3::new(low.x + 0.07, y, z);
        tube(&[at(0.8, z), at(0.97, z)], &[0.009], 24)
    };
    let bolt = |y: f32| {
        let at = |z: f32| Vec3::new(low.x + 0.07, y, z);
        [
            tube(&[at(high.z + 0.0005), at(high.z + 0.035)], &[0.006], 16),
            tube(&[at(low.z - 0.035), at(low.z - 0.0005)], &[0.006], 16),
        ]
    };
    // Its free edge is framed, half a millimetre off the glass.
    let frame = cuboid(Vec3::new(low.x - 0.0125, 0.0, -0.208), Vec3::new(low.x - 0.0005, high.y, -0.192));
    let bars = [frame, grip(high.z + 0.035), grip(low.z - 0.035)];
    scene.add_mesh(Mesh::joined(bars.into_iter().chain(bolt(0.83)).chain(bolt(0.94))), chrome);
}

/// Mixer on the back wall, rail with the shower head, and the hose between them.
fn fittings(scene: &mut Scene, chrome: MaterialIndex) {
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

/// The glossy can: drawn metal, a concave foot and shoulder, a cap of plastic.
fn can(scene: &mut Scene) {
    let metal = scene.add_material(Material::conductor(
        "can",
        Texture::Streaks(Streaks {
            width: 0.0015,
            length: 0.2,
            dark: Vec3::new(0.8, 0.56, 0.3),
            bright: Vec3::new(0.95, 0.72, 0.42),
            seed: 2,
        }),
        0.07,
    ));
    let place = Vec3::new(-0.3, LEDGE, -0.66);
    let big = Affine3A::from_scale(Vec3::splat(1.2));
    let side = [[0.0, 0.004], [0.045, 0.004], [0.05, 0.0], [0.053, 0.004], [0.053, 0.15], [0.05, 0.16]];
    let shoulder = [[0.042, 0.172], [0.032, 0.18], [0.03, 0.186], [0.0, 0.186]];
    let profile: Vec<Vec2> = side.into_iter().chain(shoulder).map(Vec2::from).collect();
    scene.add_mesh(lathe(&profile, 160).transformed(big).translated(place), metal);
    let cap = scene.add_material(Material::diffuse("cap of the can", Vec3::new(0.62, 0.09, 0.07)));
    let lid = [[0.0, 0.0], [0.029, 0.0], [0.03, 0.003], [0.028, 0.04], [0.022, 0.046], [0.0, 0.047]];
    scene.add_mesh(
        bathware::turned_body(&lid, 48).translated(Vec3::Y * 0.186).transformed(big).translated(place),
        cap,
    );
}

/// Things of glass and metal that throw caustics, and dull ones between them.
fn on_the_ledge(scene: &mut Scene, glass: MaterialIndex, chrome: MaterialIndex) {
    // A wide ring of metal before the can, open above: light gathers inside.
    let (radius, height) = (0.085, 0.032);
    let (inner, outer) = (radius - 0.0015, radius + 0.0015);
    let band = [[inner, 0.0], [outer, 0.0], [outer, height], [inner, height], [inner, 0.0]].map(Vec2::from);
    scene.add_mesh(lathe(&band, 200).translated(Vec3::new(-0.14, LEDGE, -0.52)), chrome);

    scene.add_sphere(Vec3::new(0.03, LEDGE + 0.0601, -0.56), 0.06, glass);
    let flask = [
        [0.0, 0.0],
        [0.035, 0.0],
        [0.045, 0.006],
        [0.047, 0.03],
        [0.046, 0.08],
        [0.036, 0.11],
        [0.016, 0.128],
        [0.014, 0.15],
        [0.019, 0.158],
        [0.0, 0.16],
    ];
    let body = bathware::turned_body(&flask, 96);
    scene.add_mesh(
        body.transformed(Affine3A::from_scale(Vec3::splat(1.15))).translated(Vec3::new(
            0.29,
            LEDGE + 0.0005,
            -0.6,
        )),
        glass,
    );

    for (x, z, radius, height, color) in [
        (0.43, -0.76, 0.034, 0.24, Vec3::new(0.7, 0.55, 0.1)),
        (0.52, -0.7, 0.03, 0.18, Vec3::new(0.12, 0.4, 0.2)),
    ] {
        let shampoo = scene.add_material(Material::diffuse("shampoo", color));
        let place = Vec3::new(x, LEDGE, z);
        let (bottle, _) = bathware::bottle(radius, height);
        scene.add_mesh(bottle.translated(place), shampoo);
        scene.add_mesh(
            cylinder(0.014, 0.16 * height, 32).translated(place + Vec3::Y * (0.84 * height)),
            chrome,
        );
    }
    let sponge = scene.add_material(Material::diffuse(
        "sponge",
        Texture::Clouds(Clouds {
            frequency: Vec2::splat(160.0),
            octaves: 2,
            a: Vec3::new(0.36, 0.2, 0.03),
            b: Vec3::new(0.86, 0.62, 0.2),
            seed: 7,
        }),
    ));
    let block = rounded_box(Vec3::new(0.055, 0.02, 0.035), 0.012, 4).turned(-20.0);
    scene.add_mesh(block.translated(Vec3::new(0.46, LEDGE + 0.02, -0.5)), sponge);
}
