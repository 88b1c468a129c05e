//! Closed scenes whose radiance is known: nothing is lost, nothing is gained.

mod common;

use common::*;
use glam::Vec3;
use noisefloor_render::{Prepared, Recorded, RenderRequest, Silent, render};
use noisefloor_scenes::{Scattering, Scene};

fn radiance(scene: &Scene, depth: u32, spp: u32) -> noisefloor_frame::Frame {
    let prepared = Prepared::new(scene).unwrap();
    let mut request = RenderRequest::new(&prepared, 8, 8, spp);
    request.depth = depth;
    request.seed = 3;
    request.record = Recorded::color_only();
    render(&request, &Silent).unwrap()
}

fn closed_box(albedo: f32) -> Scene {
    let mut scene = empty(camera(Vec3::new(0.2, 0.1, 0.0), Vec3::new(1.0, 0.3, 0.5), 60.0));
    let wall = add_material(&mut scene, diffuse(albedo), 1.0);
    cuboid(&mut scene, Vec3::splat(-1.0), Vec3::new(1.0, 1.5, 2.0), true, wall);
    scene
}

#[test]
fn a_closed_box_shows_as_many_terms_of_the_geometric_series_as_the_path_has_edges() {
    let albedo = 0.6f64;
    for depth in [1, 2, 3, 6] {
        let truth: f64 = (0..depth).map(|k| albedo.powi(k)).sum();
        assert_radiance(&radiance(&closed_box(0.6), depth as u32, 256), truth, 0.005);
    }
}

#[test]
fn a_closed_box_of_deep_paths_reaches_the_whole_series() {
    assert_radiance(&radiance(&closed_box(0.8), 200, 512), 5.0, 0.01);
}

fn ball(scattering: Scattering) -> Scene {
    let mut scene = with_sky(empty(camera(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO, 20.0)), 1.0);
    let material = add_material(&mut scene, scattering, 0.0);
    sphere(&mut scene, Vec3::ZERO, 1.0, material);
    scene
}

#[test]
fn a_white_ball_vanishes_under_a_white_sky() {
    assert_radiance(&radiance(&ball(diffuse(1.0)), 2, 64), 1.0, 0.01);
    for scattering in [Scattering::Mirror { reflectance: Vec3::ONE }, Scattering::Glass { ior: 1.5 }] {
        let frame = radiance(&ball(scattering), 64, 64);
        let far = frame.color.mean.data().iter().map(|v| (v - 1.0).abs()).fold(0.0, f32::max);
        assert!(far < 1e-5, "every path brings back the sky: {far}");
    }
}

/// Directional albedo of a white GGX surface, integrated over the hemisphere in f64.
fn directional_albedo(alpha: f64, cos: f64) -> f64 {
    let a2 = alpha * alpha;
    let shadow = |z: f64| (a2 + (1.0 - a2) * z * z).sqrt();
    let (rows, columns) = (800, 400);
    let mut sum = 0.0;
    for i in 0..rows {
        let z = (f64::from(i) + 0.5) / f64::from(rows);
        let sin = (1.0 - z * z).sqrt();
        for k in 0..columns {
            let (s, c) = ((f64::from(k) + 0.5) / f64::from(columns) * std::f64::consts::TAU).sin_cos();
            let (x, y) = (sin * c + (1.0 - cos * cos).sqrt(), sin * s);
            let nh = (z + cos) / (x * x + y * y + (z + cos) * (z + cos)).sqrt();
            let t = nh * nh * (a2 - 1.0) + 1.0;
            sum += a2 / (std::f64::consts::PI * t * t) * z / (2.0 * (shadow(cos) * z + shadow(z) * cos));
        }
    }
    sum / f64::from(rows * columns) * std::f64::consts::TAU
}

#[test]
fn a_rough_white_conductor_loses_exactly_what_single_scattering_loses() {
    for (alpha, cos) in [(0.3f32, 0.8f32), (0.5, 0.4), (1.0, 0.95)] {
        let sin = (1.0 - cos * cos).sqrt();
        let eye = Vec3::new(sin, cos, 0.0) * 2.0;
        let mut scene = with_sky(empty(camera(eye, Vec3::ZERO, 0.01)), 1.0);
        let material = add_material(&mut scene, conductor(1.0, alpha), 0.0);
        quad(&mut scene, Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, material);
        let truth = directional_albedo(f64::from(alpha), f64::from(cos));
        assert!(truth < 1.0);
        assert_radiance(&radiance(&scene, 2, 1024), truth, 0.005);
    }
}

fn glass_octahedron(smooth: bool) -> noisefloor_frame::Frame {
    let corners = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let mut scene = ball(Scattering::Glass { ior: 1.5 });
    scene.spheres.clear();
    scene.meshes.push(noisefloor_scenes::Mesh {
        positions: corners.to_vec(),
        normals: if smooth { corners.to_vec() } else { vec![] },
        uvs: vec![],
        triangles: faces.to_vec(),
        material: 0,
    });
    radiance(&scene, 256, 64)
}

#[test]
fn a_clear_polyhedron_vanishes_under_a_white_sky() {
    let frame = glass_octahedron(false);
    let far = frame.color.mean.data().iter().map(|v| (v - 1.0).abs()).fold(0.0, f32::max);
    assert!(far < 1e-4, "{far}");
}

#[test]
fn interpolated_normals_never_gain_energy() {
    // Shaded as a sphere, an octahedron reflects some paths for ever; all others bring back the sky.
    let (mean, _) = average(&glass_octahedron(true), 0);
    assert!(mean > 0.9 && mean < 1.0 + 1e-5, "{mean}");
}
