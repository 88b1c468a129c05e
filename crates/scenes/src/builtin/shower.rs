//! Shower booth, in decimetres.
//!
//! Stands in for the shower booth of moon2013flash, which is photon mapped: a glass pane, a glossy can, and a small spot
//! whose light the can, a glass and a bottle throw as sharp caustics onto tiles.

use glam::{Affine3A, Vec2, Vec3};

use crate::shape::{arc, cuboid, cylinder, lathe, quad, rounded_box, tube};
use crate::texture::{Texture, Tiles};
use crate::{CameraSpec, Material, Mesh, Scene};

pub const ID: &str = "shower";

/// Height of the tiled bench.
const BENCH: f32 = 4.4;

pub fn shower() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(5.6, 9.6, 7.2),
        target: Vec3::new(-0.75, 5.9, -3.2),
        up: Vec3::Y,
        vertical_fov_degrees: 35.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Shower booth with caustics", camera);
    booth(&mut scene);
    lamps(&mut scene);
    fittings(&mut scene);
    on_the_bench(&mut scene);
    scene
}

fn tiles(size: f32, joint: f32, colors: [Vec3; 2], seed: u32) -> Texture {
    let grout = Vec3::splat(0.55);
    Texture::Tiles(Tiles { size: Vec2::splat(size), joint, colors, clouding: 0.25, grout, seed })
}

/// Walls, floor, bench and the room around.
fn booth(scene: &mut Scene) {
    let aqua = [Vec3::new(0.42, 0.58, 0.6), Vec3::new(0.6, 0.72, 0.72)];
    let wall = scene.add_material(Material::diffuse("wall tiles", tiles(1.5, 0.05, aqua, 3)));
    let sand = [Vec3::new(0.55, 0.48, 0.38), Vec3::new(0.75, 0.68, 0.56)];
    let mosaic = scene.add_material(Material::diffuse("mosaic", tiles(0.42, 0.045, sand, 8)));
    let plaster = scene.add_material(Material::diffuse("plaster", Vec3::splat(0.78)));
    let slate = scene.add_material(Material::diffuse("slate", Vec3::new(0.3, 0.29, 0.28)));
    let (low, high) = (Vec3::new(-5.0, 0.0, -5.0), Vec3::new(18.0, 22.0, 20.0));
    let (x, y, z) = (Vec3::X * 23.0, Vec3::Y * 22.0, Vec3::Z * 25.0);
    scene.add_mesh(quad(low, x, y), wall);
    scene.add_mesh(quad(low + z, -z, y), wall);
    scene.add_mesh(quad(low + z, x, -z), mosaic);
    scene.add_mesh(Mesh::joined([quad(high, -z, -x), quad(high - x, x, -y), quad(high, -y, -z)]), plaster);
    let bench = cuboid(Vec3::new(-5.0, 0.0, -5.0), Vec3::new(2.2, BENCH - 0.25, -1.2));
    scene.add_mesh(bench, mosaic);
    let top = rounded_box(Vec3::new(3.68, 0.125, 1.98), 0.06, 2);
    scene.add_mesh(top.translated(Vec3::new(-1.4, BENCH - 0.125, -3.08)), slate);
}

/// A small spot for the caustics and a dim panel far behind the camera.
fn lamps(scene: &mut Scene) {
    let spot = scene.add_material(Material::emitter("spot", Vec3::new(1000.0, 900.0, 770.0)));
    let (center, half) = (Vec3::new(2.3, 11.0, -2.9), 0.2);
    let front = (Vec3::new(-0.9, BENCH, -2.4) - center).normalize();
    let (u, v) = front.any_orthonormal_pair();
    scene.add_mesh(quad(center - (u + v) * half, u * (2.0 * half), v * (2.0 * half)), spot);
    let panel = scene.add_material(Material::emitter("panel", Vec3::new(1.3, 1.4, 1.5)));
    scene.add_mesh(quad(Vec3::new(2.0, 21.95, 6.0), Vec3::X * 10.0, Vec3::Z * 10.0), panel);
}

/// Pane, shower pipe with its head, and mixer.
fn fittings(scene: &mut Scene) {
    let glass = scene.add_material(Material::glass("pane", 1.5));
    let pane = rounded_box(Vec3::new(0.03, 9.0, 1.9), 0.02, 1);
    scene.add_mesh(pane.translated(Vec3::new(2.6, 9.2, -3.0)), glass);
    let chrome = scene.add_material(Material::conductor("chrome", Vec3::new(0.84, 0.86, 0.88), 0.05));
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let mut path = vec![at(-2.6, 6.6, -4.72), at(-2.6, 14.0, -4.72)];
    path.extend(arc(Vec2::new(-3.22, 14.0), 1.5, 0.0, 90.0, 10).iter().skip(1).map(|p| {
        // The arc lies in the plane across the wall: its outward axis is +Z here.
        at(-2.6, p.y, -4.72 + (-1.72 - p.x))
    }));
    let mut metal = tube(&path, &[0.13], 20);
    let end = path[path.len() - 1];
    let head = [[0.0, 0.0], [1.1, 0.0], [1.1, 0.12], [0.25, 0.3], [0.2, 0.5], [0.0, 0.5]];
    metal.append(lathe(&head.map(Vec2::from), 48).translated(end + at(0.0, -0.5, 0.1)));
    metal.append(rounded_box(at(0.9, 0.2, 0.2), 0.18, 4).translated(at(-2.6, 6.6, -4.5)));
    let lying = Affine3A::from_rotation_z(std::f32::consts::FRAC_PI_2);
    for x in [-3.45, -1.35] {
        metal.append(cylinder(0.3, 0.4, 32).transformed(lying).translated(at(x, 6.6, -4.5)));
    }
    // Clamps of the pane.
    for y in [2.0, 16.0] {
        metal.append(rounded_box(at(0.14, 0.35, 0.3), 0.05, 2).translated(at(2.6, y, -4.7)));
    }
    scene.add_mesh(metal, chrome);
}

/// Everything that stands on the bench.
fn on_the_bench(scene: &mut Scene) {
    let place = |mesh: Mesh, x: f32, z: f32| mesh.translated(Vec3::new(x, BENCH, z));
    let can = scene.add_material(Material::conductor("can", Vec3::new(0.93, 0.82, 0.55), 0.07));
    let mut profile = vec![Vec2::ZERO, Vec2::new(0.5, 0.0), Vec2::new(0.52, 0.05), Vec2::new(0.52, 1.75)];
    profile.extend(arc(Vec2::new(0.34, 1.75), 0.18, 0.0, 90.0, 6).into_iter().skip(1));
    profile.push(Vec2::new(0.0, 1.93));
    scene.add_mesh(place(lathe(&profile, 96), -1.25, -2.7), can);
    let red = scene.add_material(Material::diffuse("cap", Vec3::new(0.6, 0.06, 0.05)));
    scene.add_mesh(place(cylinder(0.27, 0.38, 40).translated(Vec3::Y * 1.93), -1.25, -2.7), red);

    let glass = scene.add_material(Material::glass("bottle", 1.5));
    scene.add_mesh(place(bottle(), 0.75, -3.5), glass);
    scene.add_mesh(place(tumbler(), -0.1, -1.9), glass);

    let shampoo = scene.add_material(Material::diffuse("shampoo", Vec3::new(0.12, 0.3, 0.55)));
    let body = rounded_box(Vec3::new(0.45, 0.95, 0.25), 0.2, 5).translated(Vec3::Y * 0.95);
    scene.add_mesh(place(body.turned(25.0), -3.2, -3.7), shampoo);
    let cream = scene.add_material(Material::diffuse("cream", Vec3::new(0.8, 0.74, 0.62)));
    let neck = cylinder(0.17, 0.35, 32).translated(Vec3::Y * 1.9);
    scene.add_mesh(place(neck, -3.2, -3.7), cream);
    let soap = rounded_box(Vec3::new(0.5, 0.16, 0.32), 0.14, 5).translated(Vec3::Y * 0.16);
    scene.add_mesh(place(soap.turned(-20.0), -2.5, -1.95), cream);
    let sponge = scene.add_material(Material::diffuse(
        "sponge",
        Texture::Clouds(crate::texture::Clouds {
            frequency: Vec2::splat(9.0),
            octaves: 3,
            a: Vec3::new(0.75, 0.55, 0.12),
            b: Vec3::new(0.35, 0.2, 0.03),
            seed: 5,
        }),
    ));
    let block = rounded_box(Vec3::new(0.6, 0.28, 0.4), 0.08, 3).translated(Vec3::Y * 0.28);
    scene.add_mesh(place(block.turned(12.0), -4.1, -2.4), sponge);
}

/// A solid glass bottle with a ball for a stopper, closed.
fn bottle() -> Mesh {
    let mut profile = vec![Vec2::ZERO, Vec2::new(0.42, 0.0)];
    profile.extend(arc(Vec2::new(0.4, 0.12), 0.12, -60.0, 0.0, 4));
    profile.push(Vec2::new(0.52, 1.0));
    profile.extend(arc(Vec2::new(0.22, 1.0), 0.3, 0.0, 80.0, 8).into_iter().skip(1));
    profile.extend([Vec2::new(0.17, 1.42), Vec2::new(0.17, 1.58)]);
    let ball = arc(Vec2::new(0.0, 1.83), 0.3, -55.0, 90.0, 14);
    // The last point lies on the axis itself, so that the top closes.
    profile.extend(ball.iter().take(14));
    profile.push(Vec2::new(0.0, 2.13));
    lathe(&profile, 96)
}

/// A drinking glass with a thick bottom, closed.
fn tumbler() -> Mesh {
    let mut profile = vec![Vec2::ZERO, Vec2::new(0.36, 0.0), Vec2::new(0.45, 1.2)];
    profile.extend(arc(Vec2::new(0.425, 1.2), 0.025, 0.0, 180.0, 6).into_iter().skip(1));
    profile.extend([Vec2::new(0.32, 0.22), Vec2::new(0.0, 0.18)]);
    lathe(&profile, 96)
}
