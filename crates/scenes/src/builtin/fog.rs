//! A winged serpent on a pedestal in a hall full of thin fog, lit through slits in a wall, in metres.
//!
//! Stands in for the dragon in fog of rousselle2013rdfc: a finely detailed diffuse figure and a small strong lamp whose
//! light falls through slits, so that shafts show in the homogeneous medium that fills the hall. All light comes from
//! within the closed hall.

mod head;
mod serpent;
mod spine;
mod wing;

use glam::{Affine3A, Mat3, Vec2, Vec3};

use crate::shape::{arc, cuboid, lathe, quad};
use crate::texture::{Bricks, Clouds, Leaf, Texture, Tiles};
use crate::{CameraSpec, Material, Medium, Mesh, Scene};

pub const ID: &str = "fog";

/// Corners of the closed hall.
const LOW: Vec3 = Vec3::new(-8.4, 0.0, -4.6);
const HIGH: Vec3 = Vec3::new(5.0, 8.6, 8.0);

/// Inner face and thickness of the wall with the slits.
const WALL: f32 = -3.6;
const THICK: f32 = 0.4;

/// Top of the pedestal.
const PEDESTAL: f32 = 1.15;

pub fn fog() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(1.7, 2.5, 7.3),
        target: Vec3::new(-0.25, 2.42, 0.0),
        up: Vec3::Y,
        vertical_fov_degrees: 38.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Winged serpent in a hall", camera);
    hall(&mut scene);
    lights(&mut scene);
    pedestal(&mut scene);
    figure(&mut scene);
    // Light goes about 20 m; two thirds of what is scattered goes on within a quarter turn.
    let scattering = Vec3::splat(0.045);
    scene.medium = Some(Medium { absorption: Vec3::splat(0.005), scattering, mean_cosine: 0.4 });
    scene
}

/// Floor, outer walls, ceiling, and the wall with three slits that divides off the lamp's chamber.
fn hall(scene: &mut Scene) {
    let floor = scene.add_material(Material::diffuse(
        "flagstones",
        Texture::Tiles(Tiles {
            size: Vec2::splat(0.9),
            joint: 0.04,
            colors: [Vec3::new(0.3, 0.27, 0.24), Vec3::new(0.55, 0.5, 0.43)],
            clouding: 0.35,
            grout: Vec3::splat(0.12),
            seed: 4,
        }),
    ));
    let stone = scene.add_material(Material::diffuse(
        "ashlar",
        Texture::Bricks(Bricks {
            size: Vec2::new(1.1, 0.5),
            joint: 0.03,
            colors: [Vec3::new(0.34, 0.32, 0.3), Vec3::new(0.5, 0.46, 0.41)],
            mortar: Vec3::splat(0.18),
            seed: 9,
        }),
    ));
    let (x, y, z) = (Vec3::X * (HIGH.x - LOW.x), Vec3::Y * (HIGH.y - LOW.y), Vec3::Z * (HIGH.z - LOW.z));
    scene.add_mesh(quad(LOW + z, x, -z), floor);
    let mut walls = Mesh::joined([
        quad(LOW, x, y),
        quad(LOW + z, -z, y),
        quad(HIGH - y - z, z, y),
        quad(HIGH - y, -x, y),
        quad(LOW + y, x, z),
    ]);
    walls.append(slits());
    scene.add_mesh(walls, stone);
}

fn slits() -> Mesh {
    let block = |low: [f32; 2], high: [f32; 2]| {
        cuboid(Vec3::new(WALL - THICK, low[0], low[1]), Vec3::new(WALL, high[0], high[1]))
    };
    let (sill, lintel) = (3.0, 6.3);
    let mut wall =
        Mesh::joined([block([0.0, LOW.z], [sill, HIGH.z]), block([lintel, LOW.z], [HIGH.y, HIGH.z])]);
    // Between the slits, from back to front.
    let mut from = LOW.z;
    for (start, end) in [(-0.7, -0.1), (0.65, 1.65), (2.4, 2.95)] {
        wall.append(block([sill, from], [lintel, start]));
        from = end;
        // Bars across the slit.
        for height in [4.05, 5.1] {
            wall.append(cuboid(
                Vec3::new(WALL - 0.24, height, start),
                Vec3::new(WALL - 0.16, height + 0.07, end),
            ));
        }
    }
    wall.append(block([sill, from], [lintel, HIGH.z]));
    wall
}

/// A small strong lamp in the chamber behind the slits, and a dim one under the ceiling.
fn lights(scene: &mut Scene) {
    let lamp = scene.add_material(Material::emitter("lamp", Vec3::new(15000.0, 13000.0, 10000.0)));
    let (center, aim) = (Vec3::new(-7.9, 7.9, 2.6), Vec3::new(0.0, 2.3, 0.0));
    let (u, v) = (aim - center).normalize().any_orthonormal_pair();
    let size = 0.3;
    scene.add_mesh(quad(center - (u + v) * (0.5 * size), u * size, v * size), lamp);
    let fill = scene.add_material(Material::emitter("skylight", Vec3::new(3.5, 4.6, 6.2)));
    scene.add_mesh(quad(Vec3::new(1.5, HIGH.y - 0.01, 1.0), Vec3::X * 3.0, Vec3::Z * 4.0), fill);
}

fn pedestal(scene: &mut Scene) {
    let marble = scene.add_material(Material::diffuse(
        "marble",
        Texture::Clouds(Clouds {
            frequency: Vec2::new(1.4, 3.0),
            octaves: 4,
            a: Vec3::new(0.34, 0.31, 0.3),
            b: Vec3::new(0.72, 0.68, 0.62),
            seed: 21,
        }),
    ));
    let mut profile = vec![Vec2::ZERO, Vec2::new(1.75, 0.0), Vec2::new(1.75, 0.14)];
    profile.extend(arc(Vec2::new(1.62, 0.2), 0.09, -40.0, 90.0, 6));
    profile.extend([
        Vec2::new(1.3, 0.32),
        Vec2::new(1.22, 0.5),
        Vec2::new(1.22, 0.82),
        Vec2::new(1.34, 0.96),
    ]);
    profile.extend(arc(Vec2::new(1.4, 1.07), 0.08, -80.0, 90.0, 6));
    profile.push(Vec2::new(0.0, PEDESTAL));
    scene.add_mesh(lathe(&profile, 96), marble);
}

fn figure(scene: &mut Scene) {
    let skin = scene.add_material(Material::diffuse(
        "skin",
        Texture::Clouds(Clouds {
            frequency: Vec2::splat(7.0),
            octaves: 3,
            a: Vec3::new(0.46, 0.4, 0.24),
            b: Vec3::new(0.74, 0.66, 0.42),
            seed: 30,
        }),
    ));
    let scales = scene.add_material(Material::diffuse(
        "scales",
        Texture::Leaf(Leaf {
            colors: [Vec3::new(0.12, 0.42, 0.3), Vec3::new(0.36, 0.64, 0.4)],
            vein: Vec3::new(0.55, 0.7, 0.4),
            seed: 31,
        }),
    ));
    let horn = scene.add_material(Material::diffuse("horn", Vec3::new(0.78, 0.7, 0.54)));
    let eye = scene.add_material(Material::diffuse("eye", Vec3::new(0.75, 0.35, 0.03)));
    let mouth = scene.add_material(Material::diffuse("mouth", Vec3::new(0.6, 0.1, 0.08)));
    let hide = scene.add_material(Material::diffuse(
        "hide",
        Texture::Clouds(Clouds {
            frequency: Vec2::splat(5.0),
            octaves: 4,
            a: Vec3::new(0.42, 0.13, 0.08),
            b: Vec3::new(0.75, 0.36, 0.2),
            seed: 32,
        }),
    ));

    let spine = serpent::coil(PEDESTAL);
    let end = spine[spine.len() - 1];
    // The head looks a little lower than the neck ends.
    let pose = Mat3::from_cols(end.side, end.back, end.forward) * Mat3::from_rotation_x(0.12);
    let pose = Affine3A::from_mat3_translation(pose, end.at) * Affine3A::from_scale(Vec3::splat(0.95));
    let head = head::head();
    let mut horns = serpent::crest(&spine);
    horns.append(head.horn.transformed(pose));
    let mut membranes = Mesh::default();
    for (side, turn) in [(-1.0, -22.0), (1.0, 2.0)] {
        let (bones, membrane) = wing::wing(side);
        let place = |mesh: Mesh| mesh.turned(turn).translated(Vec3::new(0.17 * side, PEDESTAL + 1.75, -0.42));
        horns.append(place(bones));
        membranes.append(place(membrane));
    }
    scene.add_mesh(Mesh::joined([serpent::skin(&spine), head.skin.transformed(pose)]), skin);
    scene.add_mesh(serpent::scales(&spine), scales);
    scene.add_mesh(horns, horn);
    scene.add_mesh(head.eyes.transformed(pose), eye);
    scene.add_mesh(head.mouth.transformed(pose), mouth);
    scene.add_mesh(membranes, hide);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh<'a>(scene: &'a Scene, material: &str) -> &'a Mesh {
        let named = |mesh: &&Mesh| scene.materials[mesh.material].name == material;
        scene.meshes.iter().find(named).expect("the scene has this material")
    }

    #[test]
    fn everything_lies_within_the_hall_and_the_figure_on_the_near_side_of_the_slits() {
        let scene = fog();
        for p in scene.meshes.iter().flat_map(|mesh| &mesh.positions) {
            assert!(p.cmpge(LOW - 1e-4).all() && p.cmple(HIGH + 1e-4).all(), "{p}");
        }
        for part in ["skin", "scales", "horn", "eye", "mouth", "hide"] {
            assert!(mesh(&scene, part).positions.iter().all(|p| p.x > WALL + 0.5), "{part}");
        }
        assert!(scene.camera.eye.cmpgt(LOW).all() && scene.camera.eye.cmplt(HIGH).all());
    }

    #[test]
    fn coil_lies_on_the_pedestal() {
        // Where it is over the disc, the body may sink into it by less than a twentieth of its thickness.
        for s in serpent::coil(PEDESTAL).iter().filter(|s| Vec2::new(s.at.x, s.at.z).length() < 1.3) {
            assert!(s.at.y - 0.95 * s.radius > PEDESTAL - 0.02, "{} with radius {}", s.at, s.radius);
        }
    }

    #[test]
    fn lamp_reaches_the_head_through_a_slit_but_not_the_camera() {
        let scene = fog();
        let lamp = mesh(&scene, "lamp");
        let blocked = |to: Vec3| {
            let from = 0.5 * (lamp.positions[0] + lamp.positions[2]);
            let walls = mesh(&scene, "ashlar");
            walls.triangles.iter().any(|t| crosses(from, to, t.map(|i| walls.positions[i as usize])))
        };
        let head = mesh(&scene, "eye").positions[0];
        assert!(!blocked(head), "{head} is in the wall's shadow");
        assert!(blocked(scene.camera.eye), "the lamp shines into the camera");
    }

    /// Whether the straight line between two points passes through a triangle.
    fn crosses(from: Vec3, to: Vec3, [a, b, c]: [Vec3; 3]) -> bool {
        let volume = |p: Vec3, q: Vec3, r: Vec3, s: Vec3| (q - p).cross(r - p).dot(s - p);
        let apart = volume(a, b, c, from) * volume(a, b, c, to) < 0.0;
        let turns = [volume(from, to, a, b), volume(from, to, b, c), volume(from, to, c, a)];
        apart && (turns.iter().all(|v| *v > 0.0) || turns.iter().all(|v| *v < 0.0))
    }
}
