//! A shower booth, in metres.
//!
//! Stands in for the shower booth of moon2013flash: a pane of glass, a glossy can, tiles, and the caustics that metal
//! and glass throw on them. A small spotlight in the booth makes the caustics sharp and lights what stands behind the
//! pane from its own side; a wide dim lamp outside lights the rest. The room is closed.

mod fittings;

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
    fittings::fittings(&mut scene, chrome);
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
