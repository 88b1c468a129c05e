//! Small scenes with known answers.
#![allow(dead_code, missing_docs)] // each test file uses some of it

use glam::Vec3;
use noisefloor_scenes::{CameraSpec, Color, Material, Mesh, Scattering, Scene, Sky, Sphere, Sun};

pub fn camera(eye: Vec3, target: Vec3, fov: f32) -> CameraSpec {
    let up = if (target - eye).normalize().y.abs() > 0.99 { Vec3::Z } else { Vec3::Y };
    CameraSpec { eye, target, up, vertical_fov_degrees: fov, lens: None }
}

pub fn empty(camera: CameraSpec) -> Scene {
    Scene::empty("test", "Test", camera)
}

pub fn add_material(scene: &mut Scene, scattering: Scattering, emission: f32) -> usize {
    scene.materials.push(Material { name: "m".into(), scattering, emission: Vec3::splat(emission) });
    scene.materials.len() - 1
}

pub fn diffuse(albedo: f32) -> Scattering {
    Scattering::Diffuse { albedo: Color::Constant(Vec3::splat(albedo)) }
}

pub fn diffuse_rgb(albedo: Vec3) -> Scattering {
    Scattering::Diffuse { albedo: Color::Constant(albedo) }
}

pub fn conductor(f0: f32, alpha: f32) -> Scattering {
    Scattering::Conductor { f0: Color::Constant(Vec3::splat(f0)), alpha }
}

/// A parallelogram whose front side is that of `a × b`.
pub fn quad(scene: &mut Scene, corner: Vec3, a: Vec3, b: Vec3, material: usize) {
    scene.meshes.push(Mesh {
        positions: vec![corner, corner + a, corner + a + b, corner + b],
        normals: vec![],
        uvs: vec![],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
    });
}

/// A box whose front sides point outwards, or inwards.
pub fn cuboid(scene: &mut Scene, low: Vec3, high: Vec3, inwards: bool, material: usize) {
    let s = high - low;
    let (x, y, z) = (Vec3::X * s.x, Vec3::Y * s.y, Vec3::Z * s.z);
    for (corner, a, b) in
        [(low, z, y), (low + x, y, z), (low, x, z), (low + y, z, x), (low, y, x), (low + z, x, y)]
    {
        let (a, b) = if inwards { (b, a) } else { (a, b) };
        quad(scene, corner, a, b, material);
    }
}

pub fn sphere(scene: &mut Scene, center: Vec3, radius: f32, material: usize) {
    scene.spheres.push(Sphere { center, radius, material });
}

/// A diffuse box with two blocks and a ceiling light.
pub fn cornell() -> Scene {
    let mut scene = empty(camera(Vec3::new(0.0, 1.0, 3.9), Vec3::new(0.0, 1.0, 0.0), 38.0));
    let white = add_material(&mut scene, diffuse_rgb(Vec3::new(0.73, 0.71, 0.68)), 0.0);
    let red = add_material(&mut scene, diffuse_rgb(Vec3::new(0.63, 0.065, 0.05)), 0.0);
    let green = add_material(&mut scene, diffuse_rgb(Vec3::new(0.14, 0.45, 0.09)), 0.0);
    let light = add_material(&mut scene, diffuse(0.0), 16.0);
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    quad(&mut scene, -x - z, 2.0 * z, 2.0 * x, white);
    quad(&mut scene, -x - z + 2.0 * y, 2.0 * x, 2.0 * z, white);
    quad(&mut scene, -x - z, 2.0 * x, 2.0 * y, white);
    quad(&mut scene, -x - z, 2.0 * y, 2.0 * z, red);
    quad(&mut scene, x - z, 2.0 * z, 2.0 * y, green);
    quad(&mut scene, Vec3::new(-0.25, 1.98, -0.25), 0.5 * x, 0.5 * z, light);
    for (center, half, height, angle) in
        [(Vec3::new(-0.35, 0.0, -0.35), 0.3f32, 1.2f32, 0.3f32), (Vec3::new(0.35, 0.0, 0.3), 0.3, 0.6, -0.3)]
    {
        let first = scene.meshes.len();
        cuboid(&mut scene, Vec3::new(-half, 0.0, -half), Vec3::new(half, height, half), false, white);
        let turn = glam::Quat::from_rotation_y(angle);
        for mesh in &mut scene.meshes[first..] {
            mesh.positions.iter_mut().for_each(|p| *p = turn * *p + center);
        }
    }
    scene
}

pub fn with_sky(mut scene: Scene, radiance: f32) -> Scene {
    scene.sky = Some(Sky::Constant(Vec3::splat(radiance)));
    scene
}

pub fn with_sun(mut scene: Scene, direction: Vec3, half_angle_degrees: f32, irradiance: f32) -> Scene {
    scene.sun = Some(Sun {
        direction: direction.normalize(),
        half_angle_degrees,
        irradiance: Vec3::splat(irradiance),
    });
    scene
}

/// Mean and standard error of one channel over all pixels, which are independent estimates of the same value.
pub fn average(frame: &noisefloor_frame::Frame, channel: usize) -> (f64, f64) {
    let n = frame.pixels() as f64;
    let mean = frame.color.mean.plane(channel).iter().map(|&v| f64::from(v)).sum::<f64>() / n;
    let variance = frame.color.variance.as_ref().expect("more than one sample").mean_variance();
    let sum: f64 = variance.plane(channel).iter().map(|&v| f64::from(v)).sum();
    (mean, sum.sqrt() / n)
}

/// Asserts that a frame of independent samples agrees with `truth` within 4.5 standard errors and f32 rounding, and that
/// the standard error is below `sharp` of the truth, so that the agreement says something.
pub fn assert_radiance(frame: &noisefloor_frame::Frame, truth: f64, sharp: f64) {
    for channel in 0..3 {
        let (mean, error) = average(frame, channel);
        assert!(error <= sharp * truth, "standard error {error} is no test of {truth}");
        assert!((mean - truth).abs() <= 4.5 * error + 2e-5 * truth, "{mean} ± {error}, expected {truth}");
    }
}
