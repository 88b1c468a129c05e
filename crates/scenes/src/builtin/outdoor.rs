//! A courtyard at noon, seen from its shaded side, in metres.
//!
//! Stands in for the outdoor scene of moon2013flash (two plants, brick wall, indirect illumination): the sun stands
//! behind the brick wall, so that the wall, the plants and most of the ground in view are in shade and get their light
//! from the sunlit ground and the sunlit wall behind the camera; a roof takes most of the sky. A pergola with leaves
//! throws fine shadows on the ground. Also close to the setting of rousselle2013rdfc's sanmiguel.

use glam::{Vec2, Vec3};

use super::garden::{self, Habit};
use crate::shape::{cuboid, quad};
use crate::texture::{Bricks, Clouds, Leaf, Texture, Tiles, Wood};
use crate::{CameraSpec, Material, MaterialIndex, Mesh, Scene, Sky, Sun};

pub const ID: &str = "outdoor";

/// Depth of the roof over the wall, its height, and how far the pergola reaches.
const ROOF: f32 = 1.2;
const HEIGHT: f32 = 2.9;
const PERGOLA: f32 = 2.9;
/// Half the width of the courtyard, where its tiles end, and where its far wall is, behind the camera.
const HALF: f32 = 4.5;
const TERRACE: f32 = 4.62;
const FAR: f32 = 11.0;

pub fn outdoor() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(0.9, 1.6, 8.0),
        target: Vec3::new(-0.05, 1.17, 0.0),
        up: Vec3::Y,
        vertical_fov_degrees: 36.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Courtyard, shade and foliage", camera);
    scene.sun = Some(Sun {
        direction: Vec3::new(0.3, 0.85, -0.43).normalize(),
        half_angle_degrees: 0.27,
        irradiance: Vec3::new(15.0, 13.7, 11.6),
    });
    scene.sky = Some(Sky::Gradient {
        horizon: Vec3::new(1.2, 1.4, 1.65),
        zenith: Vec3::new(0.45, 0.8, 1.5),
        ground: Vec3::new(0.2, 0.17, 0.14),
    });
    walls(&mut scene);
    let timber = scene.add_material(Material::diffuse(
        "timber",
        Texture::Wood(Wood {
            plank: 0.14,
            length: 2.5,
            ring: 0.014,
            dark: Vec3::new(0.16, 0.085, 0.04),
            light: Vec3::new(0.4, 0.25, 0.13),
            seed: 21,
        }),
    ));
    shelter(&mut scene, timber);
    furniture(&mut scene, timber);
    plants(&mut scene);
    scene
}

/// Ground and the four walls.
fn walls(scene: &mut Scene) {
    let terrace = scene.add_material(Material::diffuse(
        "terracotta tiles",
        Texture::Tiles(Tiles {
            size: Vec2::splat(0.42),
            joint: 0.014,
            colors: [Vec3::new(0.42, 0.24, 0.15), Vec3::new(0.56, 0.38, 0.26)],
            clouding: 0.35,
            grout: Vec3::new(0.4, 0.37, 0.33),
            seed: 31,
        }),
    ));
    let brick = scene.add_material(Material::diffuse(
        "brick",
        Texture::Bricks(Bricks {
            size: Vec2::new(0.25, 0.083),
            joint: 0.013,
            colors: [Vec3::new(0.34, 0.13, 0.08), Vec3::new(0.58, 0.29, 0.18)],
            mortar: Vec3::new(0.56, 0.52, 0.46),
            seed: 32,
        }),
    ));
    let plaster = scene.add_material(Material::diffuse(
        "plaster",
        Texture::Clouds(Clouds {
            frequency: Vec2::splat(1.5),
            octaves: 3,
            a: Vec3::new(0.7, 0.64, 0.54),
            b: Vec3::new(0.85, 0.81, 0.73),
            seed: 33,
        }),
    ));
    let gravel = scene.add_material(Material::diffuse(
        "gravel",
        Texture::Clouds(Clouds {
            frequency: Vec2::splat(25.0),
            octaves: 2,
            a: Vec3::new(0.55, 0.51, 0.44),
            b: Vec3::new(0.8, 0.77, 0.7),
            seed: 36,
        }),
    ));
    let width = Vec3::X * (2.0 * HALF);
    let corner = Vec3::new(-HALF, 0.0, 0.0);
    scene.add_mesh(quad(corner + Vec3::Z * TERRACE, width, Vec3::Z * -TERRACE), terrace);
    scene.add_mesh(quad(corner + Vec3::Z * FAR, width, Vec3::Z * (TERRACE - FAR)), gravel);
    scene.add_mesh(quad(corner, width, Vec3::Y * 3.6), brick);
    scene.add_mesh(quad(corner + Vec3::Z * FAR, Vec3::Z * -FAR, Vec3::Y * 3.0), plaster);
    scene.add_mesh(quad(corner + width, Vec3::Z * FAR, Vec3::Y * 3.0), plaster);
    scene.add_mesh(quad(corner + width + Vec3::Z * FAR, -width, Vec3::Y * 4.5), plaster);
}

/// Roof, beams, posts and the slats of the pergola.
fn shelter(scene: &mut Scene, timber: MaterialIndex) {
    scene.add_mesh(beam(Vec3::new(-HALF, HEIGHT, 0.0), Vec3::new(HALF, HEIGHT + 0.1, ROOF)), timber);
    let mut parts = vec![
        beam(Vec3::new(-HALF, HEIGHT - 0.2, ROOF - 0.14), Vec3::new(HALF, HEIGHT, ROOF)),
        beam(Vec3::new(-HALF, HEIGHT - 0.2, PERGOLA - 0.14), Vec3::new(HALF, HEIGHT, PERGOLA)),
    ];
    for x in [-2.55, 2.55] {
        parts.push(beam(
            Vec3::new(x - 0.08, 0.0, ROOF - 0.15),
            Vec3::new(x + 0.08, HEIGHT - 0.2, ROOF + 0.01),
        ));
    }
    // Rafters under the roof, slats beyond it.
    for i in 0..9 {
        let x = -HALF + 0.55 + i as f32;
        parts.push(beam(Vec3::new(x, HEIGHT - 0.14, 0.0), Vec3::new(x + 0.1, HEIGHT, ROOF - 0.14)));
    }
    for i in 0..36 {
        let x = -HALF + 0.25 * i as f32;
        parts.push(beam(Vec3::new(x, HEIGHT, ROOF), Vec3::new(x + 0.05, HEIGHT + 0.09, PERGOLA + 0.25)));
    }
    scene.add_mesh(Mesh::joined(parts), timber);
}

/// A cuboid whose texture runs along its longest side.
fn beam(min: Vec3, max: Vec3) -> Mesh {
    let size = max - min;
    let mut mesh = cuboid(min, max);
    for ((p, n), uv) in mesh.positions.iter().zip(&mesh.normals).zip(&mut mesh.uvs) {
        let at = *p - min;
        let along = if size.x >= size.y && size.x >= size.z {
            [at.x, if n.y == 0.0 { at.y } else { at.z }]
        } else if size.y >= size.z {
            [at.y, if n.x == 0.0 { at.x } else { at.z }]
        } else {
            [at.z, if n.y == 0.0 { at.y } else { at.x }]
        };
        // Each beam has its own stretch of wood.
        *uv = Vec2::from(along) + Vec2::new(3.1 * min.x + 1.3 * min.z, 0.14 * (min.x * 7.0).floor());
    }
    mesh
}

/// A door with its frame in the brick wall, and a bench.
fn furniture(scene: &mut Scene, timber: MaterialIndex) {
    let door = scene.add_material(Material::diffuse(
        "door",
        Texture::Wood(Wood {
            plank: 0.16,
            length: 4.0,
            ring: 0.016,
            dark: Vec3::new(0.05, 0.13, 0.15),
            light: Vec3::new(0.13, 0.29, 0.31),
            seed: 24,
        }),
    ));
    let stone = scene.add_material(Material::diffuse(
        "stone",
        Texture::Clouds(Clouds {
            frequency: Vec2::splat(9.0),
            octaves: 3,
            a: Vec3::new(0.4, 0.38, 0.34),
            b: Vec3::new(0.64, 0.61, 0.55),
            seed: 34,
        }),
    ));
    let frame = Mesh::joined([
        cuboid(Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.26, 2.22, 0.1)),
        cuboid(Vec3::new(1.14, 0.0, 0.0), Vec3::new(1.3, 2.22, 0.1)),
        cuboid(Vec3::new(0.0, 2.06, 0.0), Vec3::new(1.4, 2.26, 0.13)),
        cuboid(Vec3::new(-0.05, 0.0, 0.0), Vec3::new(1.45, 0.08, 0.4)),
    ]);
    scene.add_mesh(frame, stone);
    let mut leaf = vec![beam(Vec3::new(0.26, 0.08, 0.0), Vec3::new(1.14, 2.06, 0.03))];
    for y in [0.3, 1.05, 1.75] {
        leaf.push(beam(Vec3::new(0.28, y, 0.03), Vec3::new(1.12, y + 0.13, 0.05)));
    }
    scene.add_mesh(Mesh::joined(leaf), door);

    let mut bench = vec![];
    for i in 0..4 {
        let z = 0.3 + 0.11 * i as f32;
        bench.push(beam(Vec3::new(-1.55, 0.42, z), Vec3::new(-0.25, 0.45, z + 0.09)));
    }
    for y in [0.58, 0.72, 0.86] {
        bench.push(beam(Vec3::new(-1.55, y, 0.22), Vec3::new(-0.25, y + 0.09, 0.25)));
    }
    for x in [-1.5, -0.36] {
        bench.push(beam(Vec3::new(x, 0.0, 0.66), Vec3::new(x + 0.06, 0.42, 0.72)));
        bench.push(beam(Vec3::new(x, 0.0, 0.25), Vec3::new(x + 0.06, 0.95, 0.3)));
    }
    scene.add_mesh(Mesh::joined(bench), timber);
}

fn plants(scene: &mut Scene) {
    let mut foliage = |name: &str, dark: [f32; 3], light: [f32; 3], vein: [f32; 3], seed| {
        let colors = [dark, light].map(Vec3::from);
        let leaf = Leaf { colors, vein: vein.into(), seed };
        scene.add_material(Material::diffuse(name, Texture::Leaf(leaf)))
    };
    let laurel = foliage("laurel", [0.05, 0.17, 0.03], [0.17, 0.36, 0.07], [0.28, 0.42, 0.16], 51);
    let olive = foliage("olive", [0.16, 0.24, 0.12], [0.33, 0.41, 0.25], [0.4, 0.46, 0.32], 52);
    let ivy = foliage("ivy", [0.04, 0.14, 0.03], [0.2, 0.33, 0.08], [0.36, 0.44, 0.22], 53);
    let bark = scene.add_material(Material::diffuse("bark", Vec3::new(0.17, 0.11, 0.07)));
    let clay = scene.add_material(Material::diffuse(
        "clay",
        Texture::Clouds(Clouds {
            frequency: Vec2::new(3.0, 12.0),
            octaves: 3,
            a: Vec3::new(0.36, 0.15, 0.08),
            b: Vec3::new(0.62, 0.33, 0.2),
            seed: 35,
        }),
    ));
    let soil = scene.add_material(Material::diffuse("soil", Vec3::new(0.06, 0.045, 0.03)));

    let round =
        Habit { branch: 0.53, forks: 4, spread: 50.0, leaves: 15, leaf: Vec2::new(0.095, 0.05), seed: 65 };
    let loose =
        Habit { branch: 0.64, forks: 4, spread: 42.0, leaves: 15, leaf: Vec2::new(0.11, 0.022), seed: 62 };
    for (at, habit, leaf) in
        [(Vec3::new(-1.95, 0.0, 1.25), loose, olive), (Vec3::new(1.98, 0.0, 1.4), round, laurel)]
    {
        let (pot, earth) = garden::pot();
        let (wood, leaves) = garden::shrub(habit);
        scene.add_mesh(pot.translated(at), clay);
        scene.add_mesh(earth.translated(at), soil);
        let rooted = at + Vec3::Y * 0.42;
        scene.add_mesh(wood.translated(rooted), bark);
        scene.add_mesh(leaves.translated(rooted), leaf);
    }
    scene.add_mesh(garden::climber(1.5, 2.8, 2600, 63).translated(Vec3::new(-3.3, 0.0, 0.0)), ivy);
    let (low, high) = (Vec3::new(-3.8, HEIGHT + 0.12, ROOF), Vec3::new(3.8, HEIGHT + 0.2, PERGOLA));
    scene.add_mesh(garden::canopy(low, high, 1800, 64), ivy);
}
