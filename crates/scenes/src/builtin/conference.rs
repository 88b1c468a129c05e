//! A conference room, in metres.
//!
//! Stands in for the conference room of rousselle2013rdfc (Fig. 4 and 6): many area lights, so that soft and hard
//! shadows lie over each other, and long thin geometry — chair legs, armrests, the slats of a blind.

use glam::{Vec2, Vec3};

use crate::shape::{cuboid, quad, rounded_box, tube};
use crate::texture::{Clouds, Texture, Wood};
use crate::{CameraSpec, Material, MaterialIndex, Mesh, Scene};

pub const ID: &str = "conference";

/// Half the room's width (X) and length (Z), and its height.
const ROOM: Vec3 = Vec3::new(3.4, 2.9, 5.6);
const TABLE_HEIGHT: f32 = 0.74;

pub fn conference() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(-2.7, 1.75, 5.3),
        target: Vec3::new(0.45, 0.62, -0.6),
        up: Vec3::Y,
        vertical_fov_degrees: 48.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Conference room, many lights", camera);
    room(&mut scene);
    lights(&mut scene);
    blind(&mut scene);
    table(&mut scene);
    chairs(&mut scene);
    scene
}

fn room(scene: &mut Scene) {
    let carpet = scene.add_material(Material::diffuse(
        "carpet",
        Texture::Clouds(Clouds {
            frequency: Vec2::splat(45.0),
            octaves: 3,
            a: Vec3::new(0.06, 0.09, 0.16),
            b: Vec3::new(0.2, 0.26, 0.36),
            seed: 2,
        }),
    ));
    let panelling = scene.add_material(Material::diffuse(
        "oak panelling",
        Texture::Wood(Wood {
            plank: 0.62,
            length: 2.9,
            ring: 0.02,
            dark: Vec3::new(0.3, 0.17, 0.08),
            light: Vec3::new(0.58, 0.4, 0.23),
            seed: 9,
        }),
    ));
    let white = scene.add_material(Material::diffuse("plaster", Vec3::new(0.74, 0.73, 0.7)));
    let (low, size) = (Vec3::new(-ROOM.x, 0.0, -ROOM.z), Vec3::new(2.0 * ROOM.x, ROOM.y, 2.0 * ROOM.z));
    let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
    scene.add_mesh(quad(low, z, x), carpet);
    scene.add_mesh(quad(low + y, x, z), white);
    // Boards stand upright: u runs along their length.
    scene.add_mesh(quad(low + x, y, -x), panelling);
    scene.add_mesh(quad(low + z, x, y).flipped(), white);
    scene.add_mesh(quad(low, y, z), white);
    scene.add_mesh(quad(low + x, z, y), white);
    let skirting = scene.add_material(Material::diffuse("skirting", Vec3::new(0.2, 0.13, 0.08)));
    scene.add_mesh(cuboid(low, low + Vec3::new(size.x, 0.09, 0.02)), skirting);
    scene.add_mesh(cuboid(low + x - Vec3::X * 0.02, low + x + z + Vec3::Y * 0.09), skirting);
}

/// Ten panels in the ceiling and three lamps over the table.
fn lights(scene: &mut Scene) {
    let panel = scene.add_material(Material::emitter("ceiling panel", Vec3::new(15.0, 15.5, 16.0)));
    for row in 0..5 {
        for side in [-1.9, 1.3] {
            let corner = Vec3::new(side, ROOM.y - 0.01, -4.9 + 2.1 * row as f32);
            scene.add_mesh(quad(corner, Vec3::X * 0.6, Vec3::Z * 0.6), panel);
        }
    }
    let bulb = scene.add_material(Material::emitter("pendant", Vec3::new(60.0, 44.0, 26.0)));
    let shade = scene.add_material(Material::conductor("brass", Vec3::new(0.82, 0.62, 0.3), 0.25));
    let cable = scene.add_material(Material::diffuse("cable", Vec3::splat(0.05)));
    for k in 0..3 {
        let hang = Vec3::new(0.0, 1.75, -2.2 + 2.2 * k as f32);
        scene.add_mesh(quad(hang + Vec3::new(-0.08, -0.01, -0.08), Vec3::X * 0.16, Vec3::Z * 0.16), bulb);
        scene.add_mesh(
            rounded_box(Vec3::new(0.14, 0.05, 0.14), 0.04, 3).translated(hang + Vec3::Y * 0.05),
            shade,
        );
        let top = Vec3::new(hang.x, ROOM.y, hang.z);
        scene.add_mesh(tube(&[hang + Vec3::Y * 0.09, top], &[0.006], 6), cable);
    }
}

/// A bright window behind the slats of a blind, on the right.
fn blind(scene: &mut Scene) {
    let sky = scene.add_material(Material::emitter("window", Vec3::new(1.1, 1.35, 1.65)));
    let x = ROOM.x - 0.02;
    scene.add_mesh(quad(Vec3::new(x, 0.9, -3.6), Vec3::Z * 4.6, Vec3::Y * 1.6), sky);
    let aluminium = scene.add_material(Material::diffuse("slat", Vec3::splat(0.68)));
    let slat = rounded_box(Vec3::new(0.03, 0.0015, 2.3), 0.0015, 1);
    let slats = (0..40).map(|k| {
        let tilt = glam::Affine3A::from_rotation_z(0.35);
        slat.clone().transformed(tilt).translated(Vec3::new(x - 0.06, 0.91 + 0.04 * k as f32, -1.3))
    });
    scene.add_mesh(Mesh::joined(slats), aluminium);
    let cords = [-3.2, -1.3, 0.6].map(|z| {
        let at = |y: f32| Vec3::new(x - 0.09, y, z);
        tube(&[at(0.9), at(2.52)], &[0.003], 5)
    });
    scene.add_mesh(Mesh::joined(cords), aluminium);
}

fn table(scene: &mut Scene) {
    let top = scene.add_material(Material::diffuse(
        "cherry table",
        Texture::Wood(Wood {
            plank: 0.32,
            length: 2.4,
            ring: 0.017,
            dark: Vec3::new(0.24, 0.08, 0.035),
            light: Vec3::new(0.5, 0.22, 0.11),
            seed: 21,
        }),
    ));
    let slab = rounded_box(Vec3::new(0.75, 0.02, 3.3), 0.02, 3);
    scene.add_mesh(slab.translated(Vec3::Y * (TABLE_HEIGHT - 0.02)), top);
    let steel = scene.add_material(Material::conductor("brushed steel", Vec3::new(0.62, 0.61, 0.6), 0.3));
    let legs = [-2.6f32, 0.0, 2.6].into_iter().flat_map(|z| [-0.5, 0.5].map(|x| (x, z))).map(|(x, z)| {
        let at = |y: f32| Vec3::new(x, y, z);
        tube(&[at(0.0), at(TABLE_HEIGHT - 0.04)], &[0.03], 16)
    });
    scene.add_mesh(Mesh::joined(legs), steel);
    let paper = scene.add_material(Material::diffuse("paper", Vec3::splat(0.82)));
    let sheets = (0..10).map(|k| {
        let (side, row) = (if k % 2 == 0 { -0.42 } else { 0.42 }, k / 2);
        let at = Vec3::new(side, TABLE_HEIGHT + 0.003, -2.5 + 1.25 * row as f32);
        let turn = 90.0 + 17.0 * ((k * 7) % 5) as f32;
        rounded_box(Vec3::new(0.148, 0.003, 0.105), 0.002, 1).turned(turn).translated(at)
    });
    scene.add_mesh(Mesh::joined(sheets), paper);
}

/// Six on each side and one at each end.
fn chairs(scene: &mut Scene) {
    let seat = scene.add_material(Material::diffuse("leather", Vec3::new(0.11, 0.035, 0.03)));
    let chrome = scene.add_material(Material::conductor("chrome", Vec3::splat(0.66), 0.12));
    for row in 0..6 {
        let z = -2.75 + 1.1 * row as f32;
        // Not quite in line, as people leave them.
        let askew = [4.0f32, -7.0, 2.0, 9.0, -3.0, 6.0][row];
        chair(scene, Vec3::new(-1.12, 0.0, z), 90.0 + askew, seat, chrome);
        chair(scene, Vec3::new(1.12, 0.0, z), -90.0 - askew, seat, chrome);
    }
    chair(scene, Vec3::new(0.1, 0.0, -3.9), 3.0, seat, chrome);
    chair(scene, Vec3::new(-0.05, 0.0, 4.0), 172.0, seat, chrome);
}

/// A chair at `place` that looks along +Z, turned by `turn` degrees.
fn chair(scene: &mut Scene, place: Vec3, turn: f32, seat: MaterialIndex, frame: MaterialIndex) {
    let put = |mesh: Mesh| mesh.turned(turn).translated(place);
    let back = rounded_box(Vec3::new(0.21, 0.25, 0.025), 0.02, 2)
        .transformed(glam::Affine3A::from_rotation_x(-0.16))
        .translated(Vec3::new(0.0, 0.78, -0.23));
    let cushion = rounded_box(Vec3::new(0.23, 0.035, 0.22), 0.03, 3).translated(Vec3::Y * 0.45);
    scene.add_mesh(put(Mesh::joined([cushion, back])), seat);
    let side = |x: f32| {
        let p = |y: f32, z: f32| Vec3::new(x, y, z);
        // A leg in front, the armrest, and a leg behind: one bent tube.
        let path = [
            p(0.0, 0.22),
            p(0.58, 0.21),
            p(0.64, 0.17),
            p(0.65, 0.1),
            p(0.65, -0.15),
            p(0.62, -0.21),
            p(0.56, -0.23),
            p(0.0, -0.27),
        ];
        tube(&path, &[0.011], 8)
    };
    let bar = |z: f32| tube(&[Vec3::new(-0.25, 0.42, z), Vec3::new(0.25, 0.42, z)], &[0.009], 8);
    let post = |x: f32| tube(&[Vec3::new(x, 0.42, -0.2), Vec3::new(x, 0.9, -0.28)], &[0.009], 8);
    let parts = [side(-0.25), side(0.25), bar(0.16), bar(-0.16), post(-0.14), post(0.14)];
    scene.add_mesh(put(Mesh::joined(parts)), frame);
}
