//! Metal teapot and balls on granite; one unit is about 6 cm.
//!
//! Stands in for the teapot-metal scene of rousselle2013rdfc: glossy metal that reflects lamps and floor with a blur,
//! on stone whose texture is as fine and as irregular as noise, so that a filter can hardly tell the two apart without
//! features.

use glam::{Affine3A, Vec2, Vec3};

use crate::shape::{arc, lathe, quad, rounded_box, teapot as utah_teapot, tube};
use crate::texture::{Clouds, Granite, Texture};
use crate::{CameraSpec, Material, Mesh, Scene};

pub const ID: &str = "teapot";

pub fn teapot() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(1.6, 6.4, 13.2),
        target: Vec3::new(0.4, 1.05, 0.2),
        up: Vec3::Y,
        vertical_fov_degrees: 28.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Glossy teapot on granite", camera);
    room(&mut scene);
    lamps(&mut scene);
    let steel = scene.add_material(Material::conductor("steel", Vec3::new(0.82, 0.8, 0.77), 0.13));
    scene.add_mesh(utah_teapot(24).turned(-22.0), steel);
    service(&mut scene);
    scene
}

/// A slab of granite, and walls that the metal reflects.
fn room(scene: &mut Scene) {
    let granite = scene.add_material(Material::diffuse(
        "granite",
        Texture::Granite(Granite {
            grain: 0.13,
            colors: [
                Vec3::new(0.62, 0.45, 0.38),
                Vec3::new(0.07, 0.065, 0.07),
                Vec3::new(0.86, 0.83, 0.78),
                Vec3::new(0.38, 0.22, 0.17),
            ],
            seed: 6,
        }),
    ));
    scene.add_mesh(quad(Vec3::new(-14.0, 0.0, 16.0), Vec3::X * 28.0, Vec3::Z * -26.0), granite);
    let wall = |a: Vec3, b: Vec3, frequency: f32, seed: u32| {
        Texture::Clouds(Clouds { frequency: Vec2::splat(frequency), octaves: 4, a, b, seed })
    };
    let slate = wall(Vec3::new(0.13, 0.17, 0.22), Vec3::new(0.36, 0.42, 0.48), 0.9, 3);
    let slate = scene.add_material(Material::diffuse("slate wall", slate));
    let ochre = scene.add_material(Material::diffuse("ochre wall", Vec3::new(0.62, 0.42, 0.2)));
    let white = scene.add_material(Material::diffuse("white", Vec3::splat(0.72)));
    let low = Vec3::new(-14.0, 0.0, -10.0);
    let (x, y, z) = (Vec3::X * 28.0, Vec3::Y * 15.0, Vec3::Z * 26.0);
    scene.add_mesh(quad(low, x, y), slate);
    scene.add_mesh(quad(low, y, z), ochre);
    scene.add_mesh(quad(low + x, z, y), white);
    scene.add_mesh(quad(low + y, x, z), white);
    scene.add_mesh(quad(low + z, y, x), white);
}

/// A soft box overhead to the left, a strip on the right, and a small lamp for sharp shadows.
fn lamps(scene: &mut Scene) {
    let mut lamp = |name: &str, radiance: Vec3, center: Vec3, aim: Vec3, size: Vec2| {
        let front = (aim - center).normalize();
        let u = front.cross(Vec3::Y).normalize() * size.x;
        let v = u.normalize().cross(front) * -size.y;
        let material = scene.add_material(Material::emitter(name, radiance));
        scene.add_mesh(quad(center - 0.5 * (u + v), u, v), material);
    };
    let pot = Vec3::Y * 1.2;
    lamp("soft box", Vec3::new(24.0, 22.0, 19.0), Vec3::new(-6.5, 11.0, 3.0), pot, Vec2::new(4.5, 4.5));
    lamp("strip", Vec3::new(13.0, 15.5, 19.0), Vec3::new(9.5, 5.5, 1.0), pot, Vec2::new(1.4, 7.0));
    lamp("small lamp", Vec3::new(330.0, 285.0, 210.0), Vec3::new(4.0, 12.5, -4.0), pot, Vec2::splat(0.9));
}

/// What stands around the teapot: a cup on its saucer, a spoon, and balls.
fn service(scene: &mut Scene) {
    let copper = scene.add_material(Material::conductor("copper", Vec3::new(0.93, 0.55, 0.4), 0.16));
    let at = Vec3::new(3.4, 0.0, 2.2);
    scene.add_mesh(cup().turned(-40.0).translated(at), copper);
    let gold = scene.add_material(Material::conductor("gold", Vec3::new(0.95, 0.68, 0.32), 0.2));
    scene.add_sphere(Vec3::new(-3.1, 0.62, 2.2), 0.62, gold);
    let blue = scene.add_material(Material::conductor("anodised blue", Vec3::new(0.12, 0.3, 0.66), 0.1));
    scene.add_sphere(Vec3::new(-2.0, 0.42, 3.3), 0.42, blue);
    let red = scene.add_material(Material::conductor("anodised red", Vec3::new(0.62, 0.1, 0.07), 0.14));
    scene.add_sphere(Vec3::new(2.6, 0.9, -3.3), 0.9, red);
    let silver = scene.add_material(Material::conductor("silver", Vec3::new(0.93, 0.91, 0.87), 0.1));
    scene.add_mesh(spoon().turned(28.0).translated(Vec3::new(0.0, 0.0, 3.9)), silver);
}

/// A cup with its handle towards +X on a saucer, standing on the origin.
fn cup() -> Mesh {
    let mut saucer = vec![Vec2::ZERO, Vec2::new(0.6, 0.0), Vec2::new(0.64, 0.05), Vec2::new(1.2, 0.2)];
    saucer.extend(arc(Vec2::new(1.22, 0.23), 0.03, -60.0, 150.0, 5));
    saucer.extend([Vec2::new(0.6, 0.12), Vec2::new(0.0, 0.1)]);
    let mut wall = vec![Vec2::new(0.0, 0.1), Vec2::new(0.36, 0.1), Vec2::new(0.38, 0.16)];
    wall.extend(arc(Vec2::new(0.2, 0.75), 0.55, -62.0, 0.0, 10));
    wall.push(Vec2::new(0.8, 1.15));
    wall.extend(arc(Vec2::new(0.77, 1.17), 0.03, 0.0, 180.0, 4));
    wall.extend(arc(Vec2::new(0.2, 0.75), 0.49, 0.0, -80.0, 10));
    wall.push(Vec2::new(0.0, 0.26));
    let path: Vec<Vec3> = (0..=14)
        .map(|i| {
            let (sin, cos) = (-100.0 + 200.0 * i as f32 / 14.0).to_radians().sin_cos();
            Vec3::new(0.78 + 0.36 * cos, 0.72 + 0.28 * sin, 0.0)
        })
        .collect();
    Mesh::joined([lathe(&saucer, 64), lathe(&wall, 64), tube(&path, &[0.055], 12)])
}

/// A spoon on the floor: a flat bowl at the origin, its stem along +X.
fn spoon() -> Mesh {
    let bowl = rounded_box(Vec3::ONE, 1.0, 6)
        .transformed(Affine3A::from_scale(Vec3::new(0.46, 0.07, 0.29)))
        .translated(Vec3::Y * 0.07);
    let path =
        [[0.4, 0.07], [0.7, 0.12], [1.2, 0.15], [1.8, 0.12], [2.2, 0.08]].map(|[x, y]| Vec3::new(x, y, 0.0));
    Mesh::joined([bowl, tube(&path, &[0.05, 0.045, 0.045, 0.06, 0.075], 12)])
}
