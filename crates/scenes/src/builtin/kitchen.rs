//! Things that stand on a kitchen counter; lengths in decimetres, each standing on the origin.

use glam::{Vec2, Vec3};

use crate::Mesh;
use crate::hash::Placement;
use crate::shape::{LeafShape, arc, cuboid, cylinder, lathe, rounded_box, slab, tube};

/// Parts of a toaster by material. It is 3.2 long (along X), 1.8 deep and 2.1 high; the lever is at its +X end.
pub struct Toaster {
    pub shell: Mesh,
    pub plastic: Mesh,
    pub chrome: Mesh,
}

/// Height of the shell's top over the counter, and distance of the slots from the middle.
pub const SLOT_HEIGHT: f32 = 2.06;
pub const SLOT_OFFSET: f32 = 0.32;

pub fn toaster() -> Toaster {
    let middle = Vec3::Y * 1.1;
    let shell = rounded_box(Vec3::new(1.45, 0.95, 0.85), 0.32, 5).translated(middle);
    let cap = |x: f32| rounded_box(Vec3::new(0.22, 0.98, 0.88), 0.2, 3).translated(middle + Vec3::X * x);
    let foot = |x: f32, z: f32| cylinder(0.14, 0.2, 12).translated(Vec3::new(x, 0.0, z));
    let slot = |z: f32| {
        cuboid(Vec3::new(-0.95, SLOT_HEIGHT - 0.05, z - 0.12), Vec3::new(0.95, SLOT_HEIGHT, z + 0.12))
    };
    let groove = cuboid(Vec3::new(1.7, 0.6, -0.07), Vec3::new(1.725, 1.8, 0.07));
    let lever = rounded_box(Vec3::new(0.16, 0.07, 0.26), 0.06, 2).translated(Vec3::new(1.86, 1.55, 0.0));
    let plastic = Mesh::joined(
        [cap(-1.5), cap(1.5), slot(-SLOT_OFFSET), slot(SLOT_OFFSET), groove, lever].into_iter().chain([
            foot(-1.1, -0.5),
            foot(1.1, -0.5),
            foot(-1.1, 0.5),
            foot(1.1, 0.5),
        ]),
    );
    let mut chrome = Mesh::default();
    for z in [-SLOT_OFFSET, SLOT_OFFSET] {
        for side in [-1.0, 1.0] {
            let (long, short) = (Vec3::new(1.0, 0.035, 0.035), Vec3::new(0.035, 0.035, 0.12));
            let at = Vec3::new(0.0, SLOT_HEIGHT, z);
            chrome.append(rounded_box(long, 0.034, 1).translated(at + Vec3::Z * (0.14 * side)));
            chrome.append(rounded_box(short, 0.034, 1).translated(at + Vec3::X * (0.97 * side)));
        }
    }
    // Browning dial, its axis along X.
    let mut profile = vec![Vec2::ZERO];
    profile.extend([Vec2::new(0.24, 0.0), Vec2::new(0.24, 0.06), Vec2::new(0.2, 0.1)]);
    profile.extend(arc(Vec2::new(0.15, 0.16), 0.05, 0.0, 90.0, 3));
    profile.push(Vec2::new(0.0, 0.21));
    let lying = glam::Affine3A::from_rotation_z(-std::f32::consts::FRAC_PI_2);
    chrome.append(lathe(&profile, 24).transformed(lying).translated(Vec3::new(1.71, 0.75, 0.45)));
    Toaster { shell, plastic, chrome }
}

/// A slice of bread standing on its lower edge, 1.2 wide and 1.15 high: its faces, textured for
/// [`Texture::Bread`](crate::Texture::Bread), and its crust.
pub fn bread() -> (Mesh, Mesh) {
    let steps = 44;
    let outline: Vec<Vec2> = (0..steps)
        .map(|i| {
            let (s, c) = (std::f32::consts::TAU * i as f32 / steps as f32).sin_cos();
            // A square with round corners, bulging over its shoulders.
            let r = (s.powi(4) + c.powi(4)).powf(-0.25);
            let shoulder = 0.95 + 0.05 * (4.0 * s).clamp(-1.0, 1.0);
            Vec2::new(r * c * shoulder, r * s)
        })
        .collect();
    let (faces, crust) = slab(&outline, 1.0);
    let size = glam::Affine3A::from_scale(Vec3::new(0.6, 0.575, 0.17));
    let stand = |mesh: Mesh| mesh.transformed(size).translated(Vec3::Y * 0.575);
    (stand(faces), stand(crust))
}

/// A flat plate of radius 1.2; v runs along the profile from the underside's middle to the upper side's.
pub fn plate() -> Mesh {
    let profile = [
        [0.0, 0.0],
        [0.65, 0.0],
        [0.7, 0.03],
        [1.17, 0.16],
        [1.2, 0.19],
        [1.17, 0.21],
        [0.85, 0.13],
        [0.72, 0.085],
        [0.62, 0.07],
        [0.0, 0.07],
    ];
    lathe(&profile.map(Vec2::from), 48)
}

/// A mug with its handle towards +X, and the surface of what is in it.
pub fn mug() -> (Mesh, Mesh) {
    let mut profile = vec![Vec2::ZERO];
    profile.extend(arc(Vec2::new(0.35, 0.06), 0.06, -90.0, 0.0, 2));
    profile.push(Vec2::new(0.43, 0.5));
    profile.extend(arc(Vec2::new(0.41, 0.95), 0.03, 0.0, 180.0, 4));
    profile.extend([Vec2::new(0.38, 0.5), Vec2::new(0.35, 0.1), Vec2::new(0.0, 0.08)]);
    let path: Vec<Vec3> = (0..=10)
        .map(|i| {
            let (s, c) = (-80.0 + 160.0 * i as f32 / 10.0).to_radians().sin_cos();
            Vec3::new(0.4 + 0.3 * c, 0.5 + 0.28 * s, 0.0)
        })
        .collect();
    let cup = Mesh::joined([lathe(&profile, 36), tube(&path, &[0.045], 8)]);
    let coffee = lathe(&[Vec2::new(0.375, 0.78), Vec2::new(0.0, 0.78)], 36);
    (cup, coffee)
}

/// A kettle of radius 1 with spout towards −X: its body, and handle and knob.
pub fn kettle() -> (Mesh, Mesh) {
    let mut profile = vec![Vec2::ZERO];
    profile.extend(arc(Vec2::new(0.85, 0.15), 0.15, -90.0, 20.0, 4));
    profile.extend([Vec2::new(0.92, 0.6), Vec2::new(0.78, 1.05)]);
    profile.extend(arc(Vec2::new(0.5, 1.1), 0.25, 0.0, 80.0, 5));
    profile.extend([Vec2::new(0.3, 1.42), Vec2::new(0.0, 1.46)]);
    let spout = [[-0.8, 0.6, 0.0], [-1.1, 0.8, 0.0], [-1.3, 1.15, 0.0], [-1.5, 1.3, 0.0]].map(Vec3::from);
    let body = Mesh::joined([lathe(&profile, 36), tube(&spout, &[0.2, 0.15, 0.11, 0.09], 14)]);
    let path: Vec<Vec3> = (0..=12)
        .map(|i| {
            let (s, c) = (15.0 * i as f32).to_radians().sin_cos();
            Vec3::new(0.72 * c, 1.15 + 1.0 * s, 0.0)
        })
        .collect();
    let knob = rounded_box(Vec3::splat(0.13), 0.13, 3).translated(Vec3::Y * 1.56);
    (body, Mesh::joined([tube(&path, &[0.06], 8), knob]))
}

/// A lidded canister of radius 0.6 and `height`: jar and lid.
pub fn canister(height: f32) -> (Mesh, Mesh) {
    let mut jar = vec![Vec2::ZERO];
    jar.extend(arc(Vec2::new(0.54, 0.06), 0.06, -90.0, 0.0, 3));
    jar.extend([Vec2::new(0.6, height), Vec2::new(0.0, height)]);
    let mut lid = vec![Vec2::new(0.0, height), Vec2::new(0.57, height)];
    lid.extend(arc(Vec2::new(0.54, height + 0.12), 0.06, 0.0, 90.0, 3));
    lid.extend(arc(Vec2::new(0.0, height + 0.3), 0.12, -80.0, 90.0, 5));
    (lathe(&jar, 32), lathe(&lid, 32))
}

/// A pot of herbs: pot, soil and leaves. The foliage fills about a ball of radius 0.75 over the pot.
pub fn herbs(leaves: u32) -> (Mesh, Mesh, Mesh) {
    let pot = [[0.0, 0.0], [0.4, 0.0], [0.52, 0.75], [0.57, 0.75], [0.57, 0.95], [0.5, 0.95], [0.48, 0.8]];
    let soil = [[0.49, 0.84], [0.0, 0.87]];
    let mut placement = Placement::new(41);
    let foliage = (0..leaves).map(|number| {
        let turn = placement.range(0.0, std::f32::consts::TAU);
        let out = placement.unit().sqrt();
        let height = placement.range(0.0, 1.0);
        let radial = Vec3::new(turn.cos(), 0.0, turn.sin());
        let base = Vec3::Y * (1.0 + 0.75 * height) + radial * (0.6 * out * (1.0 - 0.4 * height * height));
        LeafShape {
            base,
            along: radial + Vec3::Y * placement.range(-0.2, 0.7),
            up: Vec3::Y,
            length: placement.range(0.26, 0.4),
            width: placement.range(0.15, 0.24),
            droop: 0.25,
            fold: -0.12,
        }
        .mesh(number)
    });
    (lathe(&pot.map(Vec2::from), 32), lathe(&soil.map(Vec2::from), 20), Mesh::joined(foliage))
}
