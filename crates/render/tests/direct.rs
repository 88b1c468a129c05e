//! Light scattered once, against closed forms.

mod common;

use std::f64::consts::PI;

use common::*;
use glam::Vec3;
use noisefloor_frame::{Frame, PixelFilter};
use noisefloor_render::{Prepared, Recorded, RenderRequest, Silent, render};
use noisefloor_scenes::{EnvironmentMap, Scattering, Scene, Sky};

/// A floor at y = 0 seen at the origin from the side.
fn floor(scattering: Scattering) -> Scene {
    let mut scene = empty(camera(Vec3::new(3.0, 2.0, 0.0), Vec3::ZERO, 10.0));
    let material = add_material(&mut scene, scattering, 0.0);
    quad(&mut scene, Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, material);
    scene
}

/// One pixel whose rays all go to the origin.
fn at_origin(scene: &Scene, spp: u32, depth: u32) -> Frame {
    let prepared = Prepared::new(scene).unwrap();
    let mut request = RenderRequest::new(&prepared, 1, 1, spp);
    request.filter = PixelFilter::Point;
    request.depth = depth;
    request.seed = 11;
    request.record = Recorded::color_only();
    render(&request, &Silent).unwrap()
}

#[test]
fn a_square_light_overhead_gives_its_configuration_factor() {
    let mut scene = floor(diffuse(0.7));
    let light = add_material(&mut scene, diffuse(0.0), 2.0);
    // Side 2 at height 1.5, shining down.
    quad(&mut scene, Vec3::new(-1.0, 1.5, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0, light);
    scene.camera.eye = Vec3::new(3.0, 1.0, 0.0);
    let a = 1.0f64 / 1.5;
    let root = (1.0 + a * a).sqrt();
    let factor = 4.0 / (2.0 * PI) * 2.0 * (a / root) * (a / root).atan();
    assert_radiance(&at_origin(&scene, 4096, 2), 0.7 * 2.0 * factor, 0.01);
}

#[test]
fn a_spherical_light_gives_its_squared_sine() {
    let mut scene = floor(diffuse(0.5));
    let light = add_material(&mut scene, diffuse(0.0), 5.0);
    sphere(&mut scene, Vec3::new(0.0, 2.0, 1.0), 0.5, light);
    let squared = 5.0f64;
    let truth = 0.5 * 5.0 * (0.25 / squared) * (2.0 / squared.sqrt());
    assert_radiance(&at_origin(&scene, 4096, 2), truth, 0.01);
}

#[test]
fn the_sun_gives_its_irradiance_times_the_cosine() {
    for half_angle in [0.26, 5.0] {
        let scene = with_sun(floor(diffuse(0.8)), Vec3::new(1.0, 2.0, 2.0), half_angle, 3.0);
        assert_radiance(&at_origin(&scene, 4096, 2), 0.8 / PI * 3.0 * (2.0 / 3.0), 0.01);
    }
}

#[test]
fn a_constant_sky_gives_albedo_times_radiance() {
    assert_radiance(&at_origin(&with_sky(floor(diffuse(0.4)), 2.0), 4096, 2), 0.8, 0.01);
}

#[test]
fn a_gradient_sky_gives_its_cosine_integral() {
    let mut scene = floor(diffuse(0.5));
    scene.sky =
        Some(Sky::Gradient { horizon: Vec3::ONE, zenith: Vec3::splat(3.0), ground: Vec3::splat(9.0) });
    // ∫(1 + 2cos)·cos dω = π + 4π/3 over the upper hemisphere.
    assert_radiance(&at_origin(&scene, 4096, 2), 0.5 * (1.0 + 4.0 / 3.0), 0.01);
}

#[test]
fn an_environment_map_gives_its_cosine_integral() {
    // Rows of 4: radiance L_k between the angles kπ/4 and (k+1)π/4 from straight up. A diffuse floor sees the upper two,
    // each with the share sin²(θ₂) − sin²(θ₁) = ½ of the cosine integral π.
    let rows = [Vec3::new(8.0, 1.0, 0.0), Vec3::new(2.0, 3.0, 0.5), Vec3::splat(9.0), Vec3::splat(9.0)];
    let texels: Vec<Vec3> = rows.iter().flat_map(|row| [*row; 6]).collect();
    let mut scene = floor(diffuse(0.5));
    scene.sky = Some(Sky::Map(EnvironmentMap { width: 6, height: 4, texels }.into()));
    let frame = at_origin(&scene, 16_384, 2);
    for (channel, truth) in [2.5, 1.0, 0.125].into_iter().enumerate() {
        let (mean, error) = average(&frame, channel);
        assert!(error < 0.02 * truth && (mean - truth).abs() < 4.5 * error, "{mean} ± {error}, {truth}");
    }
}

#[test]
fn a_white_environment_map_is_a_white_sky() {
    let mut scene = floor(diffuse(0.4));
    let map = EnvironmentMap { width: 8, height: 4, texels: vec![Vec3::splat(2.0); 32] };
    scene.sky = Some(Sky::Map(map.into()));
    assert_radiance(&at_origin(&scene, 16_384, 2), 0.8, 0.01);
}

#[test]
fn many_kinds_of_light_add_up() {
    let mut scene = with_sun(with_sky(floor(diffuse(0.5)), 0.5), Vec3::Y, 1.0, 2.0);
    let light = add_material(&mut scene, diffuse(0.0), 5.0);
    sphere(&mut scene, Vec3::new(0.0, 2.0, 4.0), 0.5, light);
    sphere(&mut scene, Vec3::new(0.0, 2.0, -4.0), 0.5, light);
    let (squared, hidden) = (20.0f64, 0.25);
    let ball = 5.0 * (hidden / squared) * (2.0 / squared.sqrt());
    // Each ball hides its share of the sky.
    let sky = 0.5 * (1.0 - 2.0 * (hidden / squared) * (2.0 / squared.sqrt()));
    assert_radiance(&at_origin(&scene, 16384, 2), 0.5 * (2.0 / PI + sky + 2.0 * ball), 0.02);
}

/// GGX reflection of a square light, integrated over its area in f64.
fn glossy_quadrature(alpha: f64, f0: f64, side: f64, height: f64, out: [f64; 3]) -> f64 {
    let a2 = alpha * alpha;
    let shadow = |z: f64| (a2 + (1.0 - a2) * z * z).sqrt();
    let n = 1500;
    let mut sum = 0.0;
    for i in 0..n {
        for k in 0..n {
            let x = ((f64::from(i) + 0.5) / f64::from(n) - 0.5) * side;
            let z = ((f64::from(k) + 0.5) / f64::from(n) - 0.5) * side;
            let squared = x * x + height * height + z * z;
            let d = squared.sqrt();
            let w = [x / d, height / d, z / d];
            let h = [w[0] + out[0], w[1] + out[1], w[2] + out[2]];
            let length = (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]).sqrt();
            let nh = h[1] / length;
            let oh = (out[0] * h[0] + out[1] * h[1] + out[2] * h[2]) / length;
            let t = nh * nh * (a2 - 1.0) + 1.0;
            let density = a2 / (PI * t * t);
            let g = 2.0 * out[1] * w[1] / (shadow(out[1]) * w[1] + shadow(w[1]) * out[1]);
            let fresnel = f0 + (1.0 - f0) * (1.0 - oh).powi(5);
            sum += fresnel * density * g / (4.0 * out[1]) * (height / d) / squared;
        }
    }
    sum * (side / f64::from(n)).powi(2)
}

#[test]
fn glossy_reflection_of_a_square_light_agrees_with_quadrature() {
    for (alpha, f0) in [(0.1f32, 0.9), (0.4, 0.5), (1.0, 0.3)] {
        let mut scene = floor(conductor(f0, alpha));
        let light = add_material(&mut scene, diffuse(0.0), 2.0);
        quad(&mut scene, Vec3::new(-1.0, 1.5, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0, light);
        scene.camera.eye = Vec3::new(2.0, 1.3, 0.0);
        let out = scene.camera.eye.normalize().as_dvec3().to_array();
        let truth = 2.0 * glossy_quadrature(f64::from(alpha), f64::from(f0), 2.0, 1.5, out);
        assert_radiance(&at_origin(&scene, 20_000, 2), truth, 0.02);
    }
}

#[test]
fn the_back_of_a_light_is_dark() {
    let mut scene = floor(diffuse(0.5));
    let light = add_material(&mut scene, diffuse(0.0), 5.0);
    quad(&mut scene, Vec3::new(-1.0, 1.5, -1.0), Vec3::Z * 2.0, Vec3::X * 2.0, light);
    scene.camera.eye = Vec3::new(3.0, 1.0, 0.0);
    assert_eq!(average(&at_origin(&scene, 64, 4), 0).0, 0.0);
}
