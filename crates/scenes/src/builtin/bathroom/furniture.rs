//! What stands and hangs in the bathroom.

use glam::{Affine3A, Vec2, Vec3};

use super::{BASIN, HIGH, LOW, STAND, WINDOW};
use crate::builtin::{bathware, kitchen};
use crate::shape::{cuboid, cylinder, rounded_box, tube};
use crate::texture::{Clouds, Leaf, Texture};
use crate::{Material, MaterialIndex, Mesh, Scene};

/// Cabinet, stone top, basin, tap and what stands around them.
pub fn wash_stand(scene: &mut Scene, wood: MaterialIndex, chrome: MaterialIndex) {
    let (left, right, depth) = (-0.3, 0.9, 0.5);
    let front = LOW.z + depth;
    scene.add_mesh(cuboid(Vec3::new(left, 0.12, LOW.z), Vec3::new(right, STAND - 0.03, front - 0.02)), wood);
    let mut knobs = vec![];
    for k in 0..3 {
        for (low, high) in [(0.13, 0.44), (0.45, 0.78)] {
            let middle = Vec3::new(left + 0.2 + 0.4 * k as f32, 0.5 * (low + high), front - 0.012);
            let panel = rounded_box(Vec3::new(0.194, 0.5 * (high - low), 0.012), 0.006, 2);
            scene.add_mesh(panel.translated(middle), wood);
            knobs.push(
                rounded_box(Vec3::splat(0.014), 0.014, 3).translated(middle + Vec3::new(0.0, 0.1, 0.025)),
            );
        }
    }
    let legs = [left + 0.05, right - 0.05]
        .map(|x| cylinder(0.02, 0.12, 20).translated(Vec3::new(x, 0.0, front - 0.08)));
    let tap = bathware::tap(0.27, 0.15).translated(BASIN - Vec3::Z * 0.23);
    scene.add_mesh(Mesh::joined(knobs.into_iter().chain(legs).chain([tap])), chrome);

    let stone = scene.add_material(Material::diffuse(
        "stone",
        Texture::Clouds(Clouds {
            frequency: Vec2::new(9.0, 14.0),
            octaves: 4,
            a: Vec3::new(0.36, 0.33, 0.3),
            b: Vec3::new(0.84, 0.82, 0.78),
            seed: 17,
        }),
    ));
    let slab = rounded_box(Vec3::new(0.5 * (right - left) + 0.02, 0.016, 0.5 * depth + 0.005), 0.008, 3);
    scene.add_mesh(
        slab.translated(Vec3::new(0.5 * (left + right), STAND - 0.016, LOW.z + 0.5 * depth)),
        stone,
    );
    let china = scene.add_material(Material::diffuse("china", Vec3::new(0.84, 0.84, 0.82)));
    scene.add_mesh(bathware::basin().translated(BASIN), china);

    let striped = scene.add_material(Material::diffuse(
        "tooth mug",
        Texture::Stripes {
            period: 0.35,
            share: 0.3,
            base: Vec3::new(0.8, 0.76, 0.66),
            stripe: Vec3::new(0.6, 0.1, 0.07),
        },
    ));
    // It was made for a kitchen, in decimetres.
    let (mug, _) = kitchen::mug();
    let at = Vec3::new(-0.12, STAND, -1.55);
    scene.add_mesh(
        mug.transformed(Affine3A::from_scale(Vec3::splat(0.1))).turned(200.0).translated(at),
        striped,
    );
    for (lean, color) in [(0.022, Vec3::new(0.75, 0.12, 0.1)), (-0.02, Vec3::new(0.1, 0.35, 0.7))] {
        let brush = scene.add_material(Material::diffuse("toothbrush", color));
        let top = at + Vec3::new(1.9 * lean, 0.18, 0.4 * lean);
        scene.add_mesh(tube(&[at + Vec3::new(-0.5 * lean, 0.015, 0.0), top], &[0.004], 8), brush);
    }
    let bottles = [
        (Vec3::new(0.62, STAND, -1.6), 0.034, 0.2, Vec3::new(0.62, 0.2, 0.06)),
        (Vec3::new(0.71, STAND, -1.5), 0.028, 0.15, Vec3::new(0.16, 0.34, 0.2)),
        (Vec3::new(0.8, STAND, -1.62), 0.03, 0.23, Vec3::new(0.1, 0.16, 0.42)),
    ];
    stand_bottles(scene, &bottles, chrome);
    let soap = scene.add_material(Material::diffuse("soap", Vec3::new(0.8, 0.52, 0.5)));
    let bar = rounded_box(Vec3::new(0.045, 0.015, 0.03), 0.014, 4).turned(25.0);
    scene.add_mesh(bar.translated(Vec3::new(0.62, STAND + 0.015, -1.42)), soap);
}

/// Bottles at (place, radius, height, colour), with caps of `cap`.
fn stand_bottles(scene: &mut Scene, bottles: &[(Vec3, f32, f32, Vec3)], cap: MaterialIndex) {
    for &(place, radius, height, color) in bottles {
        let lotion = scene.add_material(Material::diffuse("bottle", color));
        let (body, top) = bathware::bottle(radius, height);
        scene.add_mesh(body.translated(place), lotion);
        scene.add_mesh(top.translated(place), cap);
    }
}

/// The bathtub with its standing tap, and a stool beside it.
pub fn tub(scene: &mut Scene, wood: MaterialIndex, chrome: MaterialIndex) {
    let enamel = scene.add_material(Material::diffuse("enamel", Vec3::new(0.83, 0.82, 0.79)));
    let place = Vec3::new(-0.99, 0.0, -0.88);
    scene.add_mesh(bathware::bathtub().translated(place), enamel);
    let pipe = |z: f32| tube(&[Vec3::new(0.0, 0.0, z), Vec3::new(0.0, 0.72, z)], &[0.012], 16);
    let filler = bathware::tap(0.25, 0.17).translated(Vec3::Y * 0.72);
    let bridge = tube(&[Vec3::new(0.0, 0.72, -0.07), Vec3::new(0.0, 0.72, 0.07)], &[0.022], 20);
    let stand = Mesh::joined([pipe(-0.06), pipe(0.06), bridge, filler.turned(90.0)]);
    scene.add_mesh(stand.turned(180.0).translated(place + Vec3::new(0.42, 0.0, -0.2)), chrome);

    let at = Vec3::new(-0.42, 0.0, -0.32);
    scene.add_mesh(bathware::stool(0.34, 0.42).turned(14.0).translated(at), wood);
    let bottles = [
        (at + Vec3::new(0.08, 0.42, -0.02), 0.03, 0.19, Vec3::new(0.72, 0.6, 0.2)),
        (at + Vec3::new(0.02, 0.42, 0.05), 0.024, 0.13, Vec3::new(0.5, 0.12, 0.2)),
    ];
    stand_bottles(scene, &bottles, chrome);
    let rolled = scene.add_material(Material::diffuse("rolled towel", Vec3::new(0.78, 0.7, 0.55)));
    scene.add_mesh(
        bathware::roll(0.05, 0.2).turned(80.0).translated(at + Vec3::new(-0.08, 0.42, 0.0)),
        rolled,
    );
}

/// Towels on a warm ladder of chrome to the right, and the mat.
pub fn linen(scene: &mut Scene, chrome: MaterialIndex) {
    let stripes =
        |period: f32, share: f32, base: Vec3, stripe: Vec3| Texture::Stripes { period, share, base, stripe };
    let terry = scene.add_material(Material::diffuse(
        "towel",
        stripes(0.085, 0.42, Vec3::new(0.82, 0.79, 0.72), Vec3::new(0.62, 0.13, 0.1)),
    ));
    let plain = scene.add_material(Material::diffuse(
        "guest towel",
        stripes(0.16, 0.14, Vec3::new(0.2, 0.34, 0.5), Vec3::new(0.78, 0.77, 0.7)),
    ));
    let (x, near, far) = (HIGH.x - 0.09, -0.85, -1.5);
    let upright = [near, far].map(|z| tube(&[Vec3::new(x, 0.35, z), Vec3::new(x, 1.75, z)], &[0.014], 16));
    let rungs = (0..8).map(|k| {
        let y = 0.45 + 0.175 * k as f32;
        tube(&[Vec3::new(x, y, near), Vec3::new(x, y, far)], &[0.01], 14)
    });
    scene.add_mesh(Mesh::joined(upright.into_iter().chain(rungs)), chrome);
    let hang = |cloth: Mesh, y: f32| cloth.turned(-90.0).translated(Vec3::new(x, y, 0.5 * (near + far)));
    scene.add_mesh(hang(bathware::towel(0.5, 0.56, 0.4), 0.45 + 0.175 * 7.0), terry);
    scene.add_mesh(hang(bathware::towel(0.42, 0.34, 0.25), 0.45 + 0.175 * 3.0), plain);

    let mat = scene.add_material(Material::diffuse(
        "mat",
        stripes(0.11, 0.45, Vec3::new(0.75, 0.68, 0.52), Vec3::new(0.14, 0.28, 0.36)),
    ));
    let rug = rounded_box(Vec3::new(0.42, 0.012, 0.27), 0.01, 3).turned(-6.0);
    scene.add_mesh(rug.translated(Vec3::new(0.3, 0.012, -0.75)), mat);
}

/// A plant in the corner, and the door and a shelf behind the camera, which the mirror shows.
pub fn greenery(scene: &mut Scene, wood: MaterialIndex) {
    let clay = scene.add_material(Material::diffuse("terracotta", Vec3::new(0.5, 0.21, 0.11)));
    let soil = scene.add_material(Material::diffuse("soil", Vec3::new(0.05, 0.035, 0.025)));
    let leaf = scene.add_material(Material::diffuse(
        "leaf",
        Texture::Leaf(Leaf {
            colors: [Vec3::new(0.05, 0.2, 0.04), Vec3::new(0.17, 0.4, 0.08)],
            vein: Vec3::new(0.36, 0.5, 0.2),
            seed: 3,
        }),
    ));
    let (pot, earth, leaves) = kitchen::herbs(130);
    let small =
        Affine3A::from_translation(Vec3::new(-0.52, 0.0, -1.58)) * Affine3A::from_scale(Vec3::splat(0.3));
    let on_sill = Affine3A::from_translation(WINDOW.0 + Vec3::new(-0.09, 0.0, 0.62))
        * Affine3A::from_scale(Vec3::splat(0.11));
    for place in [small, on_sill] {
        scene.add_mesh(pot.clone().transformed(place), clay);
        scene.add_mesh(earth.clone().transformed(place), soil);
        scene.add_mesh(leaves.clone().transformed(place), leaf);
    }
    let wall = HIGH.z;
    scene.add_mesh(cuboid(Vec3::new(-0.75, 0.0, wall - 0.04), Vec3::new(0.1, 2.05, wall - 0.001)), wood);
    let shelf = rounded_box(Vec3::new(0.4, 0.015, 0.11), 0.006, 2);
    let rolled = scene.add_material(Material::diffuse("towel on the shelf", Vec3::new(0.2, 0.36, 0.5)));
    for (k, y) in [1.25, 1.65].into_iter().enumerate() {
        scene.add_mesh(shelf.clone().translated(Vec3::new(0.85, y, wall - 0.11)), wood);
        for i in 0..2 {
            let at = Vec3::new(0.65 + 0.13 * i as f32 + 0.25 * k as f32, y + 0.015, wall - 0.12);
            scene.add_mesh(bathware::roll(0.06, 0.2).turned(90.0).translated(at), rolled);
        }
    }
}
