//! A bathroom, in metres.
//!
//! Stands in for the bathroom of moon2013flash: mirrors, detailed textures, and light that mostly comes by way of the
//! ceiling, at which a hanging lamp shines; a frosted window adds some from the left. The room is closed and
//! all its light comes from two finite panels, so that photons can be emitted from them.

mod furniture;

use glam::{Affine2, Affine3A, Vec2, Vec3};

use super::bathware;
use crate::shape::{cuboid, cylinder, quad, rounded_box, tube};
use crate::texture::{Texture, Tiles, Wood};
use crate::{CameraSpec, Material, MaterialIndex, Mesh, Scene};

pub const ID: &str = "bathroom";

/// Least and greatest corner of the room.
const LOW: Vec3 = Vec3::new(-1.45, 0.0, -1.8);
const HIGH: Vec3 = Vec3::new(1.45, 2.5, 2.4);
/// Up to here the walls are tiled, then follows a border.
const TILED: f32 = 1.2;
const BORDER: f32 = 0.1;
/// Top of the wash stand and the middle of its basin.
const STAND: f32 = 0.82;
const BASIN: Vec3 = Vec3::new(0.3, STAND, -1.52);

pub fn bathroom() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(0.35, 1.5, 2.25),
        target: Vec3::new(-0.03, 0.98, -1.0),
        up: Vec3::Y,
        vertical_fov_degrees: 44.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Bathroom, mirrors and indirect light", camera);
    room(&mut scene);
    lights(&mut scene);
    let chrome = scene.add_material(Material::conductor("chrome", Vec3::new(0.78, 0.79, 0.8), 0.06));
    let wood = scene.add_material(Material::diffuse("walnut", walnut()));
    mirrors(&mut scene, wood, chrome);
    furniture::wash_stand(&mut scene, wood, chrome);
    furniture::tub(&mut scene, wood, chrome);
    furniture::linen(&mut scene, chrome);
    furniture::greenery(&mut scene, wood);
    scene
}

fn walnut() -> Texture {
    Texture::Wood(Wood {
        plank: 0.3,
        length: 1.9,
        ring: 0.016,
        dark: Vec3::new(0.2, 0.095, 0.04),
        light: Vec3::new(0.5, 0.3, 0.155),
        seed: 4,
    })
}

/// Floor, ceiling, and walls that are tiled below and plastered above.
fn room(scene: &mut Scene) {
    let tiles = |size: f32, colors: [Vec3; 2], seed: u32| {
        Texture::Tiles(Tiles {
            size: Vec2::splat(size),
            joint: 0.06 * size,
            colors,
            clouding: 0.16,
            grout: Vec3::splat(0.74),
            seed,
        })
    };
    let glaze = tiles(0.15, [Vec3::new(0.32, 0.53, 0.52), Vec3::new(0.5, 0.68, 0.65)], 5);
    let mosaic = tiles(0.05, [Vec3::new(0.07, 0.13, 0.3), Vec3::new(0.75, 0.62, 0.35)], 6);
    let surfaces = [
        scene.add_material(Material::diffuse("glazed tiles", glaze)),
        scene.add_material(Material::diffuse("mosaic border", mosaic)),
        scene.add_material(Material::diffuse("plaster", Vec3::new(0.79, 0.76, 0.7))),
    ];
    let d = HIGH - LOW;
    let (x, y, z) = (Vec3::X * d.x, Vec3::Y * d.y, Vec3::Z * d.z);
    wall(scene, LOW, x, d.y, surfaces);
    wall(scene, LOW + x + z, -x, d.y, surfaces);
    wall(scene, LOW + z, -z, WINDOW.0.y, surfaces);
    // The window's wall goes on above the sill on both sides and over it.
    let (sill, lintel) = WINDOW;
    let (near, far) = (Vec3::Z * (HIGH.z - lintel.z), Vec3::Z * (sill.z - LOW.z));
    let upright = Vec3::Y * (lintel.y - sill.y);
    let corner = |y: f32, z: f32| Vec3::new(LOW.x, y, z);
    scene.add_mesh(quad(corner(sill.y, HIGH.z), -near, upright), surfaces[2]);
    scene.add_mesh(quad(corner(sill.y, sill.z), -far, upright), surfaces[2]);
    scene.add_mesh(quad(corner(lintel.y, HIGH.z), -z, Vec3::Y * (HIGH.y - lintel.y)), surfaces[2]);
    wall(scene, LOW + x, z, d.y, surfaces);
    scene.add_mesh(quad(LOW + y, x, z), surfaces[2]);

    let chequer = Texture::Checker {
        frequency: Vec2::splat(1.0 / 0.21),
        a: Vec3::new(0.075, 0.08, 0.09),
        b: Vec3::new(0.72, 0.7, 0.65),
    };
    let marble = scene.add_material(Material::diffuse("chequered floor", chequer));
    let mut floor = quad(LOW, z, x);
    // Laid diagonally.
    let turn = Affine2::from_angle(std::f32::consts::FRAC_PI_4);
    floor.uvs.iter_mut().for_each(|uv| *uv = turn.transform_point2(*uv));
    scene.add_mesh(floor, marble);
}

/// A wall from `foot` along `along` up to `height`, which is above the border: tiles, border, plaster.
fn wall(scene: &mut Scene, foot: Vec3, along: Vec3, height: f32, surfaces: [MaterialIndex; 3]) {
    let levels = [0.0, TILED, TILED + BORDER, height];
    for (k, material) in surfaces.into_iter().enumerate() {
        scene.add_mesh(
            quad(foot + Vec3::Y * levels[k], along, Vec3::Y * (levels[k + 1] - levels[k])),
            material,
        );
    }
}

/// Opposite corners of the opening for the window in the wall to the left, and how deep the window sits in it.
const WINDOW: (Vec3, Vec3) = (Vec3::new(LOW.x, 1.4, -1.4), Vec3::new(LOW.x, 2.2, -0.6));
const REVEAL: f32 = 0.2;

/// A tray that hangs from the ceiling and whose lamp shines at it, and the window.
fn lights(scene: &mut Scene) {
    let lamp = scene.add_material(Material::emitter("uplight", Vec3::new(43.0, 35.0, 25.5)));
    let white = scene.add_material(Material::diffuse("lacquer", Vec3::splat(0.8)));
    let (middle, half, wall) = (Vec3::new(0.25, 2.02, 0.75), Vec3::new(0.6, 0.03, 0.28), 0.015);
    let (low, high) = (middle - half, middle + half);
    let lift = Vec3::Y * 0.021;
    let inner = low + Vec3::new(wall, 0.0, wall) + lift;
    let size = 2.0 * (half - wall);
    scene.add_mesh(quad(inner, Vec3::Z * size.z, Vec3::X * size.x), lamp);
    let floor = cuboid(low, Vec3::new(high.x, low.y + 0.02, high.z));
    let bar = |from: Vec3, to: Vec3| cuboid(from + Vec3::Y * 0.02, to);
    let tray = [
        floor,
        bar(low, Vec3::new(high.x, high.y, low.z + wall)),
        bar(Vec3::new(low.x, low.y, high.z - wall), high),
        bar(low + Vec3::Z * wall, Vec3::new(low.x + wall, high.y, high.z - wall)),
        bar(Vec3::new(high.x - wall, low.y, low.z + wall), high - Vec3::Z * wall),
    ];
    scene.add_mesh(Mesh::joined(tray), white);
    let cord = |x: f32, z: f32| {
        let foot = middle + Vec3::new(x * (half.x - 0.5 * wall), half.y, z * (half.z - 0.5 * wall));
        tube(&[foot, Vec3::new(foot.x, HIGH.y, foot.z)], &[0.003], 8)
    };
    let cords = [cord(-1.0, -1.0), cord(1.0, -1.0), cord(-1.0, 1.0), cord(1.0, 1.0)];
    scene.add_mesh(Mesh::joined(cords), white);

    let day = scene.add_material(Material::emitter("frosted window", Vec3::new(3.4, 4.2, 5.2)));
    let (sill, lintel) = WINDOW;
    let (out, up, back) = (Vec3::X * REVEAL, Vec3::Y * (lintel.y - sill.y), Vec3::Z * (lintel.z - sill.z));
    let outer = sill - out;
    scene.add_mesh(quad(outer + back, -back, up), day);
    let reveal = [
        quad(outer, back, out),
        quad(outer + up, out, back),
        quad(outer, out, up),
        quad(outer + back, up, out),
    ];
    scene.add_mesh(Mesh::joined(reveal), white);
    let middle = outer + 0.5 * (up + back) + Vec3::X * 0.02;
    let bars = [
        rounded_box(Vec3::new(0.02, 0.5 * up.y, 0.02), 0.008, 2).translated(middle),
        rounded_box(Vec3::new(0.02, 0.02, 0.5 * back.z), 0.008, 2).translated(middle + Vec3::Y * 0.1),
    ];
    scene.add_mesh(Mesh::joined(bars), white);
}

/// A framed one over the wash stand and a round one for shaving beside it.
fn mirrors(scene: &mut Scene, wood: MaterialIndex, chrome: MaterialIndex) {
    let silver = scene.add_material(Material::mirror("mirror", Vec3::new(0.88, 0.9, 0.89)));
    let (corner, size) = (Vec3::new(-0.3, 1.1, LOW.z + 0.02), Vec2::new(1.2, 0.85));
    scene.add_mesh(quad(corner, Vec3::X * size.x, Vec3::Y * size.y), silver);
    let middle = corner + Vec3::new(0.5 * size.x, 0.5 * size.y, 0.0);
    let beam =
        |half: Vec2, at: Vec2| rounded_box(half.extend(0.022), 0.012, 3).translated(middle + at.extend(0.0));
    let (lying, standing) = (Vec2::new(0.5 * size.x + 0.045, 0.024), Vec2::new(0.024, 0.5 * size.y));
    let frame = [-1.0, 1.0].into_iter().flat_map(|side: f32| {
        let (x, y) = (side * (0.5 * size.x + 0.022), side * (0.5 * size.y + 0.022));
        [beam(lying, Vec2::new(0.0, y)), beam(standing, Vec2::new(x, 0.0))]
    });
    scene.add_mesh(Mesh::joined(frame), wood);

    let (glass, rim) = bathware::round_mirror(0.11);
    let center = Vec3::new(1.14, 1.5, -1.56);
    let turn = Affine3A::from_translation(center)
        * Affine3A::from_rotation_y((-24.0f32).to_radians())
        * Affine3A::from_rotation_x(8.0f32.to_radians());
    let front = turn.transform_vector3(Vec3::Z);
    let hinge = Vec3::new(1.22, 1.34, LOW.z);
    let arm = [
        hinge,
        hinge + Vec3::new(0.0, 0.0, 0.09),
        center - Vec3::Y * 0.16 - front * 0.02,
        center - front * 0.02,
    ];
    scene.add_mesh(glass.transformed(turn), silver);
    let back = cylinder(0.105, 0.006, 48).transformed(Affine3A::from_rotation_x(90f32.to_radians()));
    let back = back.translated(Vec3::Z * -0.008);
    let metal = [rim.transformed(turn), back.transformed(turn), tube(&arm, &[0.007], 12)];
    scene.add_mesh(Mesh::joined(metal), chrome);
}
