//! Rings on a wooden table, in centimetres.
//!
//! Stands in for the wedding band of moon2013flash and the rings of rousselle2013rdfc: polished metal that throws sharp
//! caustics of a small lamp onto a textured floor. A path tracer finds a caustic only where a path from the table meets
//! the lamp by way of the metal, so few samples miss much of it.

use glam::{Affine3A, Vec2, Vec3};

use crate::shape::{lathe, quad};
use crate::texture::{Texture, Wood};
use crate::{CameraSpec, Lens, Material, Mesh, Scene, Sky};

pub const ID: &str = "rings";

pub fn rings() -> Scene {
    let camera = CameraSpec {
        eye: Vec3::new(0.5, 3.3, 5.6),
        target: Vec3::new(0.25, 0.15, -0.2),
        up: Vec3::Y,
        vertical_fov_degrees: 31.0,
        lens: Some(Lens { radius: 0.045, focus_distance: 6.1 }),
    };
    let mut scene = Scene::empty(ID, "Rings with caustics", camera);
    table(&mut scene);
    let gold = scene.add_material(Material::conductor("gold", Vec3::new(0.95, 0.67, 0.3), 0.035));
    let silver = scene.add_material(Material::conductor("silver", Vec3::new(0.93, 0.91, 0.87), 0.025));
    let copper = scene.add_material(Material::conductor("copper", Vec3::new(0.93, 0.55, 0.4), 0.06));
    scene.add_mesh(ring(1.05, 0.3).translated(Vec3::new(-0.72, 0.0, -0.25)), gold);
    // Leans on the first: one end on the table, the other on the gold band's upper rim, 0.3 above it.
    scene.add_mesh(lying(ring(0.95, 0.26), Vec3::new(1.28, 0.0, 0.05), 90.0, 9.6), silver);
    scene.add_mesh(ring(0.62, 0.2).translated(Vec3::new(0.75, 0.0, -1.95)), copper);
    scene
}

/// Planks, a small lamp, and a dim room.
fn table(scene: &mut Scene) {
    let wood = scene.add_material(Material::diffuse(
        "walnut",
        Texture::Wood(Wood {
            plank: 1.7,
            length: 9.0,
            ring: 0.13,
            dark: Vec3::new(0.2, 0.1, 0.05),
            light: Vec3::new(0.5, 0.31, 0.17),
            seed: 12,
        }),
    ));
    scene.add_mesh(quad(Vec3::new(-30.0, 0.0, 30.0), Vec3::X * 60.0, Vec3::Z * -60.0), wood);
    // A square of 1.4 cm about 8 cm away: small enough for sharp caustics, large enough to be met by chance.
    let lamp = scene.add_material(Material::emitter("lamp", Vec3::new(150.0, 135.0, 110.0)));
    let (center, half) = (Vec3::new(-4.6, 5.4, -4.2), 0.7);
    let front = (Vec3::new(0.2, 0.0, 0.0) - center).normalize();
    let (u, v) = front.any_orthonormal_pair();
    let corner = center - (u + v) * half;
    scene.add_mesh(quad(corner, u * (2.0 * half), v * (2.0 * half)), lamp);
    scene.sky = Some(Sky::Gradient {
        horizon: Vec3::new(0.25, 0.22, 0.2),
        zenith: Vec3::new(0.45, 0.5, 0.6),
        ground: Vec3::ZERO,
    });
}

/// A band around the Y axis, standing on the XZ plane: `radius` at its middle, `height` high, with a domed outside and
/// a flatter inside.
fn ring(radius: f32, height: f32) -> Mesh {
    let steps = 64;
    let profile: Vec<Vec2> = (0..=steps)
        .map(|i| {
            // From the bottom, outside first. Exactly the first point again at the end, so that the seam closes.
            let angle = std::f32::consts::TAU * (i % steps) as f32 / steps as f32;
            let (sin, cos) = angle.sin_cos();
            // sin is across the band, cos along its height.
            let across = if sin > 0.0 { 0.085 } else { 0.045 } * sin;
            Vec2::new(radius + across, 0.5 * height * (1.0 - cos))
        })
        .collect();
    lathe(&profile, 360)
}

/// Turned about X by `tilt` and about Y by `turn` degrees, put at `place`, and lifted so that its lowest point is on
/// the table.
fn lying(mesh: Mesh, place: Vec3, turn: f32, tilt: f32) -> Mesh {
    let map = Affine3A::from_rotation_y(turn.to_radians()) * Affine3A::from_rotation_x(tilt.to_radians());
    let mesh = mesh.transformed(map);
    let lowest = mesh.positions.iter().fold(f32::INFINITY, |low, p| low.min(p.y));
    mesh.translated(place - Vec3::Y * lowest)
}
