//! Mirrors and glass.

mod common;

use common::*;
use glam::Vec3;
use noisefloor_frame::{Frame, PixelFilter};
use noisefloor_render::{Prepared, Recorded, RenderRequest, Silent, render};
use noisefloor_scenes::{Scattering, Scene, Sky};

fn one_pixel(scene: &Scene, spp: u32, depth: u32) -> Frame {
    let prepared = Prepared::new(scene).unwrap();
    let mut request = RenderRequest::new(&prepared, 1, 1, spp);
    (request.filter, request.depth, request.record) = (PixelFilter::Point, depth, Recorded::color_only());
    render(&request, &Silent).unwrap()
}

#[test]
fn a_mirror_shows_the_light_times_its_reflectance() {
    let mut scene = empty(camera(Vec3::new(-2.0, 2.0, 0.0), Vec3::ZERO, 10.0));
    let mirror = add_material(&mut scene, Scattering::Mirror { reflectance: Vec3::new(0.9, 0.5, 0.25) }, 0.0);
    let light = add_material(&mut scene, diffuse(0.0), 4.0);
    quad(&mut scene, Vec3::new(-1.0, 0.0, -1.0), Vec3::Z * 2.0, Vec3::X * 2.0, mirror);
    sphere(&mut scene, Vec3::new(3.0, 3.0, 0.0), 0.5, light);
    let frame = one_pixel(&scene, 4, 2);
    assert_eq!(frame.color.mean.data(), [3.6, 2.0, 1.0]);
    assert_eq!(one_pixel(&scene, 4, 1).color.mean.data(), [0.0; 3], "two edges are needed");
}

fn slab(background: Sky) -> Scene {
    let mut scene = empty(camera(Vec3::new(0.0, 3.0, 0.0), Vec3::ZERO, 10.0));
    scene.sky = Some(background);
    let glass = add_material(&mut scene, Scattering::Glass { ior: 1.5 }, 0.0);
    cuboid(&mut scene, Vec3::new(-50.0, -0.5, -50.0), Vec3::new(50.0, 0.5, 50.0), false, glass);
    scene
}

#[test]
fn a_glass_slab_transmits_and_reflects_what_fresnel_says() {
    let r = 0.04f64; // ((1.5 − 1)/(1.5 + 1))²
    let (zero, one) = (Vec3::ZERO, Vec3::ONE);
    let below = slab(Sky::Gradient { horizon: zero, zenith: zero, ground: one });
    assert_radiance(&one_pixel(&below, 20_000, 64), (1.0 - r) / (1.0 + r), 0.01);
    let above = slab(Sky::Gradient { horizon: one, zenith: one, ground: zero });
    assert_radiance(&one_pixel(&above, 60_000, 64), 2.0 * r / (1.0 + r), 0.02);
}

#[test]
fn radiance_inside_glass_is_scaled_by_its_squared_index() {
    // The eye is inside the slab: the sky outside looks n² brighter, less what is reflected.
    let mut scene = slab(Sky::Constant(Vec3::ONE));
    scene.camera.eye = Vec3::ZERO;
    scene.camera.target = Vec3::NEG_Y;
    assert_radiance(&one_pixel(&scene, 4_000, 256), 2.25, 0.01);
}

#[test]
fn a_glass_ball_focuses_but_keeps_energy() {
    // A diffuse floor under a sky: covering a part of it by clear glass leaves radiance between 0 and that of the sky.
    let mut scene = with_sky(empty(camera(Vec3::new(0.0, 1.0, 4.0), Vec3::new(0.0, 0.5, 0.0), 40.0)), 1.0);
    let white = add_material(&mut scene, diffuse(0.8), 0.0);
    let glass = add_material(&mut scene, Scattering::Glass { ior: 1.5 }, 0.0);
    quad(&mut scene, Vec3::new(-20.0, 0.0, -20.0), Vec3::Z * 40.0, Vec3::X * 40.0, white);
    sphere(&mut scene, Vec3::new(0.0, 0.6, 0.0), 0.5, glass);
    let prepared = Prepared::new(&scene).unwrap();
    let mut request = RenderRequest::new(&prepared, 16, 12, 512);
    request.record = Recorded::color_only();
    request.depth = 64;
    let frame = render(&request, &Silent).unwrap();
    let variance = frame.color.variance.as_ref().unwrap().mean_variance();
    for (value, variance) in frame.color.mean.plane(0).iter().zip(variance.plane(0)) {
        let error = variance.sqrt();
        assert!(*value <= 1.0 + 5.0 * error && *value > 0.3, "{value} ± {error}");
    }
}
