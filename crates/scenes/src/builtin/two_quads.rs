//! A sharp and a blurred picture, in metres.
//!
//! Stands in for rousselle2013rdfc, Fig. 3: one textured quad in focus, another far out of focus, the same light on
//! both, so that the texture is the only feature that tells anything and its noise is all defocus.

use glam::{Vec2, Vec3};

use crate::shape::quad;
use crate::texture::{Bricks, Texture, Tiles};
use crate::{CameraSpec, Lens, Material, Scene, Sky};

pub const ID: &str = "two-quads";

pub fn two_quads() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::ZERO,
        target: -Vec3::Z,
        up: Vec3::Y,
        vertical_fov_degrees: 40.0,
        // The far quad's circle of confusion is about a tenth of the image's height.
        lens: Some(Lens { radius: 0.07, focus_distance: 1.5 }),
    };
    let mut scene = Scene::empty(ID, "Two quads, one out of focus", camera);
    scene.sky = Some(Sky::Constant(Vec3::splat(0.7)));
    let sharp = scene.add_material(Material::diffuse(
        "sharp tiles",
        Texture::Tiles(Tiles {
            size: Vec2::splat(0.07),
            joint: 0.006,
            colors: [Vec3::new(0.75, 0.3, 0.12), Vec3::new(0.12, 0.35, 0.55)],
            clouding: 0.3,
            grout: Vec3::splat(0.85),
            seed: 4,
        }),
    ));
    scene.add_mesh(quad(Vec3::new(-0.66, -0.4, -1.5), Vec3::X * 0.6, Vec3::Y * 0.8), sharp);
    let blurred = scene.add_material(Material::diffuse(
        "blurred bricks",
        Texture::Bricks(Bricks {
            size: Vec2::new(1.1, 0.5),
            joint: 0.09,
            colors: [Vec3::new(0.6, 0.16, 0.08), Vec3::new(0.35, 0.1, 0.07)],
            mortar: Vec3::splat(0.8),
            seed: 6,
        }),
    ));
    scene.add_mesh(quad(Vec3::new(0.4, -3.2, -12.0), Vec3::X * 5.2, Vec3::Y * 6.4), blurred);
    scene
}
