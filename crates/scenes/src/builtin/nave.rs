//! The nave of a Romanesque church, in metres, seen towards the apse (−Z).
//!
//! Stands in for the Sibenik cathedral of rousselle2013rdfc: a deep hall of columns under a thin lens focused on one of
//! them, lit through windows in the aisles, so that most of what the camera sees is indirect light.

mod choir;
mod plan;
mod stones;

use glam::{Vec2, Vec3};

use super::church::{Opening, band};
use super::column::{COLUMN_HEIGHT, Column, column};
use crate::shape::{cuboid, lathe, quad};
use crate::texture::{Texture, Tiles};
use crate::{CameraSpec, Lens, Material, Mesh, Scene};
use choir::{APSE, choir, vault};
use plan::{AISLE, BAY, BAYS, FAR, NAVE, NEAR, VAULT};
use stones::{Stones, stones};

pub const ID: &str = "nave";

/// Bays whose right windows are in the sun; a tower shades the others.
const SUNNY_BAYS: u32 = 5;
/// Thickness of the arcade.
const THICK: f32 = 0.8;
/// Heights: of the string course over the arcade, of the aisles' ceiling.
const COURSE: f32 = 6.9;
const CEILING: f32 = 6.8;

/// An arch of the arcade, in the wall that stands on the columns.
const ARCH: Opening = Opening { half: 1.6, sill: 0.0, spring: 0.2 };
const AISLE_WINDOW: Opening = Opening { half: 0.72, sill: 1.7, spring: 4.3 };
const HIGH_WINDOW: Opening = Opening { half: 0.62, sill: 0.4, spring: 1.45 };

pub fn nave() -> Scene {
    let (eye, target) = (Vec3::new(1.75, 1.7, 6.2), Vec3::new(-0.75, 3.1, -6.0));
    // The second column in view on the left, at the eye's height.
    let in_focus = Vec3::new(-NAVE - 0.5 * THICK, eye.y, NEAR - 3.0 * BAY);
    let camera = CameraSpec {
        eye,
        target,
        up: Vec3::Y,
        vertical_fov_degrees: 54.0,
        lens: Some(Lens { radius: 0.09, focus_distance: (in_focus - eye).dot((target - eye).normalize()) }),
    };
    let mut scene = Scene::empty(ID, "Church nave, depth of field", camera);
    let stones = stones(&mut scene);
    floor(&mut scene);
    for left in [true, false] {
        arcade(&mut scene, &stones, left);
        aisle(&mut scene, &stones, left);
    }
    windows(&mut scene, &stones);
    vault(&mut scene, &stones);
    choir(&mut scene, &stones);
    scene
}

/// Flags, and a chequered walk down the middle.
fn floor(scene: &mut Scene) {
    let flags = scene.add_material(Material::diffuse(
        "flags",
        Texture::Tiles(Tiles {
            size: Vec2::splat(0.7),
            joint: 0.015,
            colors: [Vec3::new(0.4, 0.35, 0.29), Vec3::new(0.62, 0.56, 0.47)],
            clouding: 0.35,
            grout: Vec3::new(0.2, 0.18, 0.15),
            seed: 3,
        }),
    ));
    let walk = scene.add_material(Material::diffuse(
        "chequered walk",
        Texture::Checker {
            frequency: Vec2::splat(1.0 / 0.5),
            a: Vec3::new(0.74, 0.69, 0.6),
            b: Vec3::new(0.28, 0.12, 0.09),
        },
    ));
    let depth = NEAR - FAR + APSE;
    let half = 1.5;
    let back = Vec3::Z * -depth;
    scene.add_mesh(quad(Vec3::new(-half, 0.0, NEAR), Vec3::X * (2.0 * half), back), walk);
    for x in [-AISLE, half] {
        scene.add_mesh(quad(Vec3::new(x, 0.0, NEAR), Vec3::X * (AISLE - half), back), flags);
    }
}

/// A part of a wall in bay `bay`, whose face is `x` from the axis and whose foot is at `y`; texture goes on from bay
/// to bay.
fn on_side(mut mesh: Mesh, left: bool, x: f32, y: f32, bay: u32) -> Mesh {
    let near = NEAR - BAY * bay as f32;
    let run = BAY * bay as f32;
    mesh.uvs.iter_mut().for_each(|uv| *uv += Vec2::new(if left { run } else { -run }, y));
    if left {
        mesh.turned(90.0).translated(Vec3::new(-x, y, near))
    } else {
        mesh.turned(-90.0).translated(Vec3::new(x, y, near - BAY))
    }
}

/// Columns, arches, and the wall over them with its high windows.
fn arcade(scene: &mut Scene, stones: &Stones, left: bool) {
    let sign = if left { -1.0 } else { 1.0 };
    let axis = sign * (NAVE + 0.5 * THICK);
    let Column { shaft, stone } = column();
    // A slender shaft before the wall carries the vault's rib.
    let half_round = [[0.13, COLUMN_HEIGHT], [0.13, VAULT - 0.3], [0.26, VAULT - 0.05], [0.26, VAULT]];
    let respond = lathe(&half_round.map(Vec2::from), 16);
    for k in 0..=BAYS {
        let place = Vec3::new(axis, 0.0, NEAR - BAY * k as f32);
        scene.add_mesh(shaft.clone().translated(place), stones.marble);
        scene.add_mesh(stone.clone().translated(place), stones.dressed);
        let before = Vec3::new(sign * NAVE, 0.0, place.z);
        scene.add_mesh(respond.clone().translated(before), stones.dressed);
    }
    let size = Vec2::new(BAY, COURSE - COLUMN_HEIGHT);
    let ring = band(ARCH.half - 0.02, ARCH.half + 0.36, THICK + 0.1);
    let ring = ring.translated(Vec3::new(0.5 * BAY, ARCH.spring, 0.05));
    let high = Vec2::new(BAY, VAULT - COURSE);
    for bay in 0..BAYS {
        let put = |mesh: Mesh, y: f32| on_side(mesh, left, NAVE, y, bay);
        scene.add_mesh(put(ARCH.face(size), COLUMN_HEIGHT), stones.ashlar);
        let behind = on_side(ARCH.face(size), !left, -NAVE - THICK, COLUMN_HEIGHT, bay);
        scene.add_mesh(behind, stones.ashlar);
        scene.add_mesh(put(ARCH.reveal(BAY, THICK), COLUMN_HEIGHT), stones.dressed);
        scene.add_mesh(put(ring.clone(), COLUMN_HEIGHT), stones.voussoirs);
        scene.add_mesh(put(HIGH_WINDOW.face(high), COURSE), stones.ashlar);
        scene.add_mesh(put(HIGH_WINDOW.reveal(BAY, 0.4), COURSE), stones.dressed);
    }
    for (low, high, out) in [(COURSE - 0.12, COURSE + 0.08, 0.12), (VAULT - 0.1, VAULT + 0.05, 0.1)] {
        let (a, b) = (sign * (NAVE - out), sign * (NAVE + 0.05));
        let course = cuboid(Vec3::new(a.min(b), low, FAR), Vec3::new(a.max(b), high, NEAR));
        scene.add_mesh(course, stones.dressed);
    }
}

/// Outer wall and timber ceiling of an aisle.
fn aisle(scene: &mut Scene, stones: &Stones, left: bool) {
    let sign = if left { -1.0 } else { 1.0 };
    let size = Vec2::new(BAY, CEILING);
    for bay in 0..BAYS {
        let put = |mesh: Mesh| on_side(mesh, left, AISLE, 0.0, bay);
        scene.add_mesh(put(AISLE_WINDOW.face(size)), stones.ashlar);
        scene.add_mesh(put(AISLE_WINDOW.reveal(BAY, 0.5)), stones.dressed);
        let ring = band(AISLE_WINDOW.half, AISLE_WINDOW.half + 0.22, 0.05);
        let ring = ring.translated(Vec3::new(0.5 * BAY, AISLE_WINDOW.spring, 0.05));
        scene.add_mesh(put(ring), stones.voussoirs);
    }
    let (near, far) = (sign * (NAVE + THICK), sign * AISLE);
    let (low, high) = (near.min(far), near.max(far));
    // Boards run along the aisle.
    let boards = quad(Vec3::new(low, CEILING, FAR), Vec3::Z * (NEAR - FAR), Vec3::X * (high - low)).flipped();
    scene.add_mesh(boards, stones.oak);
    let mut beams = Mesh::default();
    for k in 0..4 * BAYS {
        let z = NEAR - 0.5 - k as f32;
        beams.append(cuboid(
            Vec3::new(low, CEILING - 0.2, z - 0.08),
            Vec3::new(high, CEILING + 0.01, z + 0.08),
        ));
    }
    scene.add_mesh(beams, stones.oak);
}

/// Glass: the sun stands on the right, so that the windows there are bright and the others show their colours.
fn windows(scene: &mut Scene, stones: &Stones) {
    let mut glass = |side: &str, light: f32, pale: f32| {
        let colors = [Vec3::new(1.0, 0.93, 0.78), Vec3::new(0.95, 0.42, 0.12), Vec3::new(0.25, 0.5, 0.95)];
        let names = ["clear", "amber", "blue"];
        [0, 1, 2].map(|k| {
            let radiance = colors[k].lerp(colors[0], pale) * light;
            scene.add_material(Material::emitter(&format!("{} glass {side}", names[k]), radiance))
        })
    };
    // Nearly white where most of the light comes from: a strong colour per pane would be a strong colour per sample.
    let sunny = glass("in the sun", 28.0, 0.75);
    let shady = glass("in the shade", 2.2, 0.0);
    for left in [true, false] {
        for bay in 0..BAYS {
            let panes = if left || bay >= SUNNY_BAYS { shady } else { sunny };
            for (opening, x, y, depth, rows) in
                [(AISLE_WINDOW, AISLE, 0.0, 0.5, 8), (HIGH_WINDOW, NAVE, COURSE, 0.4, 3)]
            {
                let (meshes, bars) = opening.glazing(BAY, depth, rows);
                for (mesh, material) in meshes.into_iter().zip(panes) {
                    scene.add_mesh(on_side(mesh, left, x, y, bay), material);
                }
                scene.add_mesh(on_side(bars, left, x, y, bay), stones.lead);
            }
        }
    }
}
