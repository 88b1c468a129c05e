//! Toys on a table that turn, roll and fly, in decimetres.
//!
//! Stands in for the scenes with motion blur of liu2018robust: things with bold patterns and glossy metal that move,
//! before a still background of fine texture. Each moving thing is made of meshes of its own, given after all that
//! stays, in the order fan, wheel, top, ball, block; all are placed by their centre, which is a fixed point when they
//! turn.

mod block;
mod fan;
mod wheel;

use std::f32::consts::{PI, TAU};

use glam::{Affine3A, Quat, Vec2, Vec3};

use crate::shape::{Vertex, arc, cuboid, lathe, quad, surface};
use crate::texture::{Clouds, Texture, Tiles, Wood};
use crate::{Body, CameraSpec, Material, Mesh, Scene, Spin};

pub const ID: &str = "spin";

/// The fan's rotor turns about the axis through here.
const FAN: Vec3 = Vec3::new(-2.45, 2.35, -0.6);
/// Angle in degrees about the vertical from +Z to the fan's axis.
const FAN_TURN: f32 = 24.0;
/// The wheel's axle and its angle.
const WHEEL: Vec3 = Vec3::new(2.55, 1.95, -0.9);
const WHEEL_TURN: f32 = -20.0;
/// Tip of the top, and its axis from there.
const TOP: Vec3 = Vec3::new(-1.0, 0.0, 2.3);
const TOP_AXIS: Vec3 = Vec3::new(0.17, 0.97, 0.14);
/// Centre of the ball, which lies on the table.
const BALL: Vec3 = Vec3::new(1.15, BALL_RADIUS, 2.5);
const BALL_RADIUS: f32 = 0.62;
/// Centre of the flying block.
const BLOCK: Vec3 = Vec3::new(0.1, 3.35, 0.9);

pub fn spin() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(0.2, 3.7, 10.6),
        target: Vec3::new(0.05, 1.8, 0.0),
        up: Vec3::Y,
        vertical_fov_degrees: 33.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Turning toys", camera);
    room(&mut scene);
    lights(&mut scene);
    let chrome = scene.add_material(Material::conductor("chrome", Vec3::new(0.78, 0.79, 0.8), 0.08));
    let brass = scene.add_material(Material::conductor("brass", Vec3::new(0.9, 0.7, 0.34), 0.1));
    let (fan, wheel) = (fan::fan(FAN.y), wheel::wheel(WHEEL.y));
    let at_fan = |mesh: Mesh| mesh.turned(FAN_TURN).translated(FAN);
    let at_wheel = |mesh: Mesh| mesh.turned(WHEEL_TURN).translated(WHEEL);

    let enamel = scene.add_material(Material::diffuse("enamel", Vec3::new(0.1, 0.3, 0.3)));
    let oak = scene.add_material(Material::diffuse("oak", Vec3::new(0.36, 0.21, 0.11)));
    scene.add_mesh(at_fan(fan.stand), enamel);
    scene.add_mesh(at_fan(fan.cage), chrome);
    scene.add_mesh(at_wheel(wheel.stand), oak);

    // From here on everything moves.
    let blades = scene.add_material(Material::diffuse(
        "blades",
        Texture::Checker {
            frequency: Vec2::new(1.0, 4.0),
            a: Vec3::new(0.75, 0.1, 0.06),
            b: Vec3::new(0.85, 0.78, 0.55),
        },
    ));
    scene.add_mesh(at_fan(fan.blades), blades);
    scene.add_mesh(at_fan(fan.hub), brass);
    let tyre = scene.add_material(Material::diffuse(
        "tyre",
        Texture::Checker {
            frequency: Vec2::new(wheel::squares_around(36), 0.0),
            a: Vec3::splat(0.06),
            b: Vec3::new(0.8, 0.62, 0.1),
        },
    ));
    let reflector = scene.add_material(Material::diffuse("reflector", Vec3::new(0.85, 0.28, 0.03)));
    scene.add_mesh(at_wheel(wheel.tyre), tyre);
    scene.add_mesh(at_wheel(wheel.metal), chrome);
    scene.add_mesh(at_wheel(wheel.reflectors), reflector);
    top(&mut scene, brass);
    ball(&mut scene);
    let letters = scene.add_material(Material::diffuse("letters", block::letters()));
    let tumble = Quat::from_rotation_y(-0.55) * Quat::from_rotation_x(0.5) * Quat::from_rotation_z(0.3);
    scene.add_mesh(
        block::block(0.55).transformed(Affine3A::from_rotation_translation(tumble, BLOCK)),
        letters,
    );
    movements(&mut scene);
    scene
}

/// What each thing does in a frame, half of which the shutter sees.
fn movements(scene: &mut Scene) {
    let upright = |degrees: f32| Quat::from_rotation_y(degrees.to_radians()) * Vec3::Z;
    let lift = Vec3::Y * 0.012;
    // The ball rolls without slipping: its way over its radius is its angle.
    let roll = 0.6;
    let movements = [
        (9..11, FAN, upright(FAN_TURN), 50.0, Vec3::ZERO),
        (11..14, WHEEL, upright(WHEEL_TURN), 22.0, Vec3::ZERO),
        (14..16, TOP + lift, TOP_AXIS.normalize(), 70.0, Vec3::ZERO),
        (16..17, BALL + lift, Vec3::NEG_Z, (roll / BALL_RADIUS).to_degrees(), Vec3::X * roll),
        (17..18, BLOCK, Vec3::new(0.4, 0.8, 0.4).normalize(), 36.0, Vec3::new(0.8, 0.25, 0.0)),
    ];
    for (meshes, center, axis, degrees, translation) in movements {
        let spin = Some(Spin { center, axis, degrees });
        scene.add_body(0.5, Body { meshes: meshes.collect(), translation, spin });
    }
}

/// Table, tiled wall, and the plain rest of the room, which the metal reflects.
fn room(scene: &mut Scene) {
    let wood = scene.add_material(Material::diffuse(
        "table",
        Texture::Wood(Wood {
            plank: 0.9,
            length: 8.0,
            ring: 0.1,
            dark: Vec3::new(0.3, 0.16, 0.07),
            light: Vec3::new(0.6, 0.4, 0.22),
            seed: 17,
        }),
    ));
    scene.add_mesh(quad(Vec3::new(-12.0, 0.0, 6.5), Vec3::X * 24.0, Vec3::Z * -10.0), wood);
    let tiles = scene.add_material(Material::diffuse(
        "mosaic",
        Texture::Tiles(Tiles {
            size: Vec2::splat(0.32),
            joint: 0.025,
            colors: [Vec3::new(0.22, 0.36, 0.48), Vec3::new(0.66, 0.72, 0.72)],
            clouding: 0.15,
            grout: Vec3::splat(0.7),
            seed: 6,
        }),
    ));
    scene.add_mesh(quad(Vec3::new(-12.0, 0.0, -3.5), Vec3::X * 24.0, Vec3::Y * 12.0), tiles);
    let cloth = scene.add_material(Material::diffuse(
        "gingham",
        Texture::Checker {
            frequency: Vec2::splat(5.0),
            a: Vec3::new(0.78, 0.76, 0.7),
            b: Vec3::new(0.2, 0.28, 0.45),
        },
    ));
    scene.add_mesh(cuboid(Vec3::new(-2.6, -0.01, 1.2), Vec3::new(2.6, 0.012, 3.7)).turned(4.0), cloth);
    let plaster = scene.add_material(Material::diffuse(
        "plaster",
        Texture::Clouds(Clouds {
            frequency: Vec2::splat(0.3),
            octaves: 2,
            a: Vec3::new(0.6, 0.57, 0.52),
            b: Vec3::new(0.7, 0.67, 0.62),
            seed: 18,
        }),
    ));
    let (low, size) = (Vec3::new(-12.0, -7.0, -3.5), Vec3::new(24.0, 19.0, 20.0));
    let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
    let walls =
        [quad(low + y, x, z), quad(low, y, z), quad(low + x, z, y), quad(low, z, x), quad(low + z, y, x)];
    scene.add_mesh(Mesh::joined(walls), plaster);
}

/// A window to the left and a small strong lamp to the right.
fn lights(scene: &mut Scene) {
    let window = scene.add_material(Material::emitter("window", Vec3::new(6.0, 6.8, 7.8)));
    scene.add_mesh(quad(Vec3::new(-11.9, 1.5, 9.5), Vec3::Z * -8.0, Vec3::Y * 7.5), window);
    let lamp = scene.add_material(Material::emitter("lamp", Vec3::new(95.0, 78.0, 54.0)));
    let (center, size) = (Vec3::new(4.5, 8.6, 5.0), 1.3);
    let (u, v) = (Vec3::Y - center).normalize().any_orthonormal_pair();
    scene.add_mesh(quad(center - (u + v) * (0.5 * size), u * size, v * size), lamp);
}

/// A leaning top with a patterned body, and tip, stem and knob of brass.
fn top(scene: &mut Scene, brass: usize) {
    let widest = 0.82;
    let paint = scene.add_material(Material::diffuse(
        "top",
        Texture::Checker {
            frequency: Vec2::new(12.0 / (TAU * widest), 4.4),
            a: Vec3::new(0.07, 0.3, 0.6),
            b: Vec3::new(0.86, 0.72, 0.2),
        },
    ));
    let mut body = vec![Vec2::new(0.06, 0.14), Vec2::new(0.3, 0.32), Vec2::new(0.66, 0.66)];
    body.extend(arc(Vec2::new(widest - 0.12, 0.82), 0.12, -40.0, 80.0, 8));
    body.extend([Vec2::new(0.4, 1.04), Vec2::new(0.09, 1.12)]);
    let mut metal = vec![Vec2::new(0.0, 0.0), Vec2::new(0.03, 0.02), Vec2::new(0.09, 0.17)];
    metal.extend([Vec2::new(0.075, 0.3), Vec2::new(0.075, 1.5)]);
    metal.extend(arc(Vec2::new(0.0, 1.6), 0.13, -50.0, 90.0, 8));
    let lean = Quat::from_rotation_arc(Vec3::Y, TOP_AXIS.normalize());
    let place = Affine3A::from_rotation_translation(lean, TOP + Vec3::Y * 0.012);
    scene.add_mesh(lathe(&body, 72).transformed(place), paint);
    scene.add_mesh(lathe(&metal, 32).transformed(place), brass);
}

/// A ball of triangles, which unlike an exact sphere can be turned with its texture.
fn ball(scene: &mut Scene) {
    let paint = scene.add_material(Material::diffuse(
        "ball",
        Texture::Checker {
            frequency: Vec2::new(8.0, 4.0),
            a: Vec3::new(0.82, 0.8, 0.74),
            b: Vec3::new(0.78, 0.12, 0.08),
        },
    ));
    let (columns, rows) = (96, 48);
    let mesh = surface(columns, rows, |i, j| {
        let (u, v) = (i as f32 / columns as f32, j as f32 / rows as f32);
        // Exactly the first angle again at the end, and exactly the poles.
        let (sin, cos) = (TAU * (i % columns) as f32 / columns as f32).sin_cos();
        let (height, ring) = ((PI * (v - 0.5)).sin(), if j % rows == 0 { 0.0 } else { (PI * v).sin() });
        let out = Vec3::new(ring * sin, height, ring * cos);
        Vertex { position: out * BALL_RADIUS, normal: out, uv: Vec2::new(u, v) }
    });
    let lift = Vec3::Y * 0.012;
    let pose = Quat::from_rotation_z(0.5) * Quat::from_rotation_x(0.4);
    scene.add_mesh(mesh.transformed(Affine3A::from_rotation_translation(pose, BALL + lift)), paint);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_comes_last_in_the_documented_order() {
        let scene = spin();
        let names = |meshes: &[Mesh]| {
            meshes.iter().map(|mesh| scene.materials[mesh.material].name.clone()).collect::<Vec<_>>()
        };
        let (still, moving) = scene.meshes.split_at(9);
        assert_eq!(
            names(moving),
            ["blades", "brass", "tyre", "chrome", "reflector", "top", "brass", "ball", "letters"]
        );
        assert_eq!(names(&still[6..]), ["enamel", "chrome", "oak"]);
    }

    #[test]
    fn what_stands_or_lies_on_the_table_touches_it() {
        let scene = spin();
        let lowest = |i: usize| scene.meshes[i].positions.iter().fold(f32::MAX, |low, p| low.min(p.y));
        // Foot of the fan and the wheel's plinth on the wood, tip of the top and the ball on the cloth.
        for (mesh, expected) in [(6, 0.0), (8, 0.0), (15, 0.012), (16, 0.012)] {
            // The ball is a polyhedron, whose lowest corner is at most its largest sagitta too high.
            let low = lowest(mesh) - expected;
            assert!((-1e-4..2e-3).contains(&low), "mesh {mesh} hovers by {low}");
        }
    }
}
