//! A toaster on a kitchen counter, in decimetres.
//!
//! Stands in for the toaster scene of moon2013flash (11 K triangles, depth of field): a thin lens focused on a brushed
//! steel toaster, with things clearly out of focus before and behind it, textured tiles and wood, and glossy metal
//! that reflects both.

use glam::{Affine3A, Vec2, Vec3};

use super::kitchen::{self, SLOT_HEIGHT, SLOT_OFFSET};
use crate::shape::{quad, rounded_box};
use crate::texture::{Bread, Clouds, Leaf, Streaks, Texture, Tiles, Wood};
use crate::{CameraSpec, Lens, Material, Mesh, Scene};

pub const ID: &str = "toaster";

pub fn toaster() -> Scene {
    let (eye, target) = (Vec3::new(1.3, 4.2, 12.7), Vec3::new(0.3, 0.95, 4.2));
    let camera = CameraSpec {
        eye,
        target,
        up: Vec3::Y,
        vertical_fov_degrees: 33.0,
        // In focus is the toaster's near corner; f/1.4 for a lens of 7 cm.
        lens: Some(Lens { radius: 0.25, focus_distance: 8.2 }),
    };
    let mut scene = Scene::empty(ID, "Toaster, depth of field", camera);
    room(&mut scene);
    lights(&mut scene);
    place_toaster(&mut scene);
    breakfast(&mut scene);
    background(&mut scene);
    scene
}

/// Counter, tiled wall, and the plain walls behind the camera that the metal reflects.
fn room(scene: &mut Scene) {
    let wood = scene.add_material(Material::diffuse(
        "beech counter",
        Texture::Wood(Wood {
            plank: 0.8,
            length: 9.0,
            ring: 0.09,
            dark: Vec3::new(0.28, 0.13, 0.05),
            light: Vec3::new(0.62, 0.39, 0.2),
            seed: 3,
        }),
    ));
    scene.add_mesh(quad(Vec3::new(-14.0, 0.0, 10.5), Vec3::X * 28.0, Vec3::Z * -10.5), wood);
    let tiles = scene.add_material(Material::diffuse(
        "glazed tiles",
        Texture::Tiles(Tiles {
            size: Vec2::splat(1.0),
            joint: 0.06,
            colors: [Vec3::new(0.3, 0.47, 0.46), Vec3::new(0.62, 0.72, 0.66)],
            clouding: 0.2,
            grout: Vec3::splat(0.72),
            seed: 8,
        }),
    ));
    scene.add_mesh(quad(Vec3::new(-14.0, 0.0, 0.0), Vec3::X * 28.0, Vec3::Y * 16.0), tiles);
    let plaster = scene.add_material(Material::diffuse("plaster", Vec3::new(0.68, 0.64, 0.58)));
    let cupboard = scene.add_material(Material::diffuse("cupboard", Vec3::new(0.25, 0.1, 0.07)));
    let (x, y, z) = (Vec3::X * 28.0, Vec3::Y * 25.0, Vec3::Z * 26.0);
    let low = Vec3::new(-14.0, -9.0, 0.0);
    scene.add_mesh(quad(low + y, x, z), plaster);
    scene.add_mesh(quad(low, y, z), plaster);
    scene.add_mesh(quad(low + x, z, y), plaster);
    scene.add_mesh(quad(low, z, x), cupboard);
    scene.add_mesh(quad(low + z, y, x), plaster);
    scene.add_mesh(quad(Vec3::new(-14.0, -9.0, 25.9), Vec3::Y * 15.0, Vec3::X * 28.0), cupboard);
}

/// A window to the left and a lamp over the camera's shoulder.
fn lights(scene: &mut Scene) {
    let window = scene.add_material(Material::emitter("window", Vec3::new(7.2, 8.1, 9.2)));
    scene.add_mesh(quad(Vec3::new(-13.9, 2.5, 11.5), Vec3::Z * -8.5, Vec3::Y * 9.0), window);
    let lamp = scene.add_material(Material::emitter("lamp", Vec3::new(11.5, 9.5, 6.6)));
    scene.add_mesh(quad(Vec3::new(2.5, 15.5, 8.0), Vec3::X * 7.0, Vec3::Z * 5.0), lamp);
}

fn place_toaster(scene: &mut Scene) {
    let steel = scene.add_material(Material::conductor(
        "brushed steel",
        Texture::Streaks(Streaks {
            width: 0.012,
            length: 1.6,
            dark: Vec3::new(0.5, 0.49, 0.47),
            bright: Vec3::new(0.8, 0.79, 0.77),
            seed: 5,
        }),
        0.12,
    ));
    let plastic = scene.add_material(Material::conductor("black plastic", Vec3::splat(0.045), 0.15));
    let chrome = scene.add_material(Material::conductor("chrome", Vec3::new(0.72, 0.73, 0.74), 0.05));
    let place = Affine3A::from_translation(Vec3::new(0.0, 0.0, 4.2))
        * Affine3A::from_rotation_y((-32.0f32).to_radians());
    let parts = kitchen::toaster();
    scene.add_mesh(parts.shell.transformed(place), steel);
    scene.add_mesh(parts.plastic.transformed(place), plastic);
    scene.add_mesh(parts.chrome.transformed(place), chrome);

    let (crumb, crust) = bread_materials(scene);
    for (x, z, depth) in [(-0.08, SLOT_OFFSET, 0.52), (0.1, -SLOT_OFFSET, 0.62)] {
        let lift = Affine3A::from_translation(Vec3::new(x, SLOT_HEIGHT - depth, z));
        let (faces, rim) = kitchen::bread();
        scene.add_mesh(faces.transformed(place * lift), crumb);
        scene.add_mesh(rim.transformed(place * lift), crust);
    }
    // Two slices on a plate, nearer to the camera and out of focus.
    let plate_at = Vec3::new(2.55, 0.0, 6.7);
    for (turn, lean, lift) in [(20.0f32, -88.0f32, 0.17), (-35.0, -80.0, 0.36)] {
        let down = Affine3A::from_translation(plate_at + Vec3::Y * lift)
            * Affine3A::from_rotation_y(turn.to_radians())
            * Affine3A::from_rotation_x(lean.to_radians())
            * Affine3A::from_translation(Vec3::Y * -0.575);
        let (faces, rim) = kitchen::bread();
        scene.add_mesh(faces.transformed(down), crumb);
        scene.add_mesh(rim.transformed(down), crust);
    }
    let china = scene.add_material(Material::diffuse(
        "plate",
        Texture::Stripes {
            period: 0.62,
            share: 0.12,
            base: Vec3::new(0.8, 0.79, 0.75),
            stripe: Vec3::new(0.06, 0.12, 0.4),
        },
    ));
    scene.add_mesh(kitchen::plate().translated(plate_at), china);
}

fn bread_materials(scene: &mut Scene) -> (usize, usize) {
    let crumb = Texture::Bread(Bread {
        crumb: Vec3::new(0.78, 0.6, 0.34),
        toasted: Vec3::new(0.5, 0.24, 0.07),
        crust: Vec3::new(0.2, 0.075, 0.02),
        seed: 12,
    });
    let crust = Texture::Clouds(Clouds {
        frequency: Vec2::splat(4.0),
        octaves: 2,
        a: Vec3::new(0.2, 0.08, 0.025),
        b: Vec3::new(0.42, 0.2, 0.07),
        seed: 13,
    });
    (
        scene.add_material(Material::diffuse("toast", crumb)),
        scene.add_material(Material::diffuse("crust", crust)),
    )
}

/// What stands around the toaster: a mug beside it, oranges and a knife before it.
fn breakfast(scene: &mut Scene) {
    let glaze = scene.add_material(Material::diffuse(
        "mug",
        Texture::Stripes {
            period: 0.31,
            share: 0.4,
            base: Vec3::new(0.82, 0.8, 0.74),
            stripe: Vec3::new(0.55, 0.09, 0.05),
        },
    ));
    let coffee = scene.add_material(Material::conductor("coffee", Vec3::new(0.05, 0.035, 0.025), 0.06));
    let (cup, drink) = kitchen::mug();
    let place = |mesh: Mesh| mesh.turned(-25.0).translated(Vec3::new(2.7, 0.0, 4.3));
    scene.add_mesh(place(cup), glaze);
    scene.add_mesh(place(drink), coffee);

    let peel = scene.add_material(Material::diffuse("orange", Vec3::new(0.82, 0.3, 0.03)));
    scene.add_sphere(Vec3::new(-1.3, 0.42, 6.9), 0.42, peel);
    scene.add_sphere(Vec3::new(-0.55, 0.38, 7.3), 0.38, peel);

    let blade = scene.add_material(Material::conductor("knife", Vec3::new(0.7, 0.7, 0.71), 0.08));
    let handle = scene.add_material(Material::diffuse("handle", Vec3::new(0.09, 0.04, 0.02)));
    let lie = |mesh: Mesh| mesh.turned(52.0).translated(Vec3::new(1.0, 0.05, 6.75));
    scene.add_mesh(lie(rounded_box(Vec3::new(0.85, 0.012, 0.13), 0.011, 1)), blade);
    let grip = rounded_box(Vec3::new(0.5, 0.06, 0.1), 0.05, 2).translated(Vec3::X * -1.3);
    scene.add_mesh(lie(grip), handle);
}

/// Behind the toaster, out of focus: a copper kettle, canisters, herbs.
fn background(scene: &mut Scene) {
    let copper = scene.add_material(Material::conductor("copper", Vec3::new(0.93, 0.56, 0.4), 0.1));
    let iron = scene.add_material(Material::diffuse("iron", Vec3::splat(0.05)));
    let (body, handle) = kitchen::kettle();
    let place = |mesh: Mesh| mesh.turned(25.0).translated(Vec3::new(3.1, 0.0, 1.7));
    scene.add_mesh(place(body), copper);
    scene.add_mesh(place(handle), iron);

    let cream = scene.add_material(Material::diffuse(
        "canister",
        Texture::Stripes {
            period: 1.1,
            share: 0.16,
            base: Vec3::new(0.74, 0.66, 0.5),
            stripe: Vec3::new(0.1, 0.22, 0.2),
        },
    ));
    let lid = scene.add_material(Material::conductor("tin lid", Vec3::splat(0.6), 0.2));
    for (x, z, height) in [(-3.9, 1.2, 1.9), (-2.75, 0.95, 1.5)] {
        let (jar, cover) = kitchen::canister(height);
        scene.add_mesh(jar.translated(Vec3::new(x, 0.0, z)), cream);
        scene.add_mesh(cover.translated(Vec3::new(x, 0.0, z)), lid);
    }
    let terracotta = scene.add_material(Material::diffuse("terracotta", Vec3::new(0.5, 0.2, 0.1)));
    let soil = scene.add_material(Material::diffuse("soil", Vec3::new(0.05, 0.035, 0.025)));
    let basil = scene.add_material(Material::diffuse(
        "basil",
        Texture::Leaf(Leaf {
            colors: [Vec3::new(0.06, 0.2, 0.03), Vec3::new(0.16, 0.36, 0.06)],
            vein: Vec3::new(0.3, 0.45, 0.15),
            seed: 2,
        }),
    ));
    let (pot, earth, leaves) = kitchen::herbs(110);
    let at = Vec3::new(1.5, 0.0, 1.0);
    scene.add_mesh(pot.translated(at), terracotta);
    scene.add_mesh(earth.translated(at), soil);
    scene.add_mesh(leaves.translated(at), basil);
}
