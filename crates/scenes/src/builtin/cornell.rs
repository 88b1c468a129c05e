//! Cornell boxes.
//!
//! Dimensions are the measured ones of the Cornell Program of Computer Graphics (Goral et al. 1984 and the later
//! data sheet), in decimetres; reflectances and the lamp are the linear RGB values in common use for them.

use glam::Vec3;

use crate::shape::{polygon, quad};
use crate::{CameraSpec, Material, MaterialIndex, Mesh, Scene};

pub const ID: &str = "cornell";
pub const DIFFUSE_ID: &str = "cornell-diffuse";

const WHITE: Vec3 = Vec3::new(0.725, 0.71, 0.68);
const RED: Vec3 = Vec3::new(0.63, 0.065, 0.05);
const GREEN: Vec3 = Vec3::new(0.14, 0.45, 0.091);
const LAMP: Vec3 = Vec3::new(17.0, 12.0, 4.0);

/// The box with a mirror ball and a glass ball, both exact spheres. The lamp is four times as large as the measured
/// one at half the radiance, so that the caustic under the glass ball is found by plain path tracing without rare
/// bright samples; the camera stands closer than usual, so that the box fills a 4:3 image.
pub fn cornell() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(2.78, 2.73, -4.0),
        target: Vec3::new(2.78, 2.73, 0.0),
        up: Vec3::Y,
        vertical_fov_degrees: 54.0,
        lens: None,
    };
    let mut scene = Scene::empty(ID, "Cornell box, mirror and glass", camera);
    room(&mut scene);
    let lamp = scene.add_material(Material::emitter("lamp", LAMP / 2.0));
    scene.add_mesh(
        quad(Vec3::new(4.08, 5.478, 1.745), Vec3::new(0.0, 0.0, 2.1), Vec3::new(-2.6, 0.0, 0.0)),
        lamp,
    );
    let mirror = scene.add_material(Material::mirror("mirror ball", Vec3::splat(0.95)));
    let glass = scene.add_material(Material::glass("glass ball", 1.5));
    scene.add_sphere(Vec3::new(3.95, 1.05, 3.85), 1.05, mirror);
    scene.add_sphere(Vec3::new(1.6, 0.95, 2.45), 0.95, glass);
    scene
}

/// The box with its short and its tall white block, camera and lamp as measured.
pub fn cornell_diffuse() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(2.78, 2.73, -8.0),
        target: Vec3::new(2.78, 2.73, 0.0),
        up: Vec3::Y,
        // A 25 mm film behind a 35 mm lens.
        vertical_fov_degrees: 39.3077,
        lens: None,
    };
    let mut scene = Scene::empty(DIFFUSE_ID, "Cornell box, diffuse blocks", camera);
    let white = room(&mut scene);
    let lamp = scene.add_material(Material::emitter("lamp", LAMP));
    // A millimetre below the ceiling, which has no hole here.
    scene.add_mesh(
        quad(Vec3::new(3.43, 5.478, 2.27), Vec3::new(0.0, 0.0, 1.05), Vec3::new(-1.3, 0.0, 0.0)),
        lamp,
    );
    scene.add_mesh(block([[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]], 165.0), white);
    scene.add_mesh(block([[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]], 330.0), white);
    scene
}

/// Walls, floor and ceiling, fronts inside; the material of the white ones. Opposite walls are not quite parallel,
/// as in the box that was measured.
fn room(scene: &mut Scene) -> MaterialIndex {
    let [white, red, green] = [("white", WHITE), ("red", RED), ("green", GREEN)]
        .map(|(name, albedo)| scene.add_material(Material::diffuse(name, albedo)));
    let faces = [
        (white, [[5.528, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 5.592], [5.496, 0.0, 5.592]]),
        (white, [[5.56, 5.488, 0.0], [5.56, 5.488, 5.592], [0.0, 5.488, 5.592], [0.0, 5.488, 0.0]]),
        (white, [[5.496, 0.0, 5.592], [0.0, 0.0, 5.592], [0.0, 5.488, 5.592], [5.56, 5.488, 5.592]]),
        (green, [[0.0, 0.0, 5.592], [0.0, 0.0, 0.0], [0.0, 5.488, 0.0], [0.0, 5.488, 5.592]]),
        (red, [[5.528, 0.0, 0.0], [5.496, 0.0, 5.592], [5.56, 5.488, 5.592], [5.56, 5.488, 0.0]]),
    ];
    for (material, corners) in faces {
        scene.add_mesh(polygon(&corners.map(Vec3::from)), material);
    }
    white
}

/// A standing prism without its bottom face; `corners` are (x, z), counter-clockwise seen from above, in millimetres
/// like `height`.
fn block(corners: [[f32; 2]; 4], height: f32) -> Mesh {
    let at = |i: usize, y: f32| Vec3::new(corners[i % 4][0], y, corners[i % 4][1]) * 0.01;
    let sides = (0..4).map(|i| polygon(&[at(i, 0.0), at(i + 1, 0.0), at(i + 1, height), at(i, height)]));
    Mesh::joined(sides.chain([polygon(&[0, 1, 2, 3].map(|i| at(i, height)))]))
}
