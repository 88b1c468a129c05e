//! The participating medium against closed forms.

mod common;

use common::*;
use glam::Vec3;
use noisefloor_frame::{FeatureId, Flash, Frame};
use noisefloor_render::{FeatureHit, Prepared, Quantity, Recorded, RenderRequest, Silent, render};
use noisefloor_scenes::{Medium, Scattering, Scene};

fn fog(absorption: f32, scattering: f32, mean_cosine: f32) -> Option<Medium> {
    Some(Medium { absorption: Vec3::splat(absorption), scattering: Vec3::splat(scattering), mean_cosine })
}

fn radiance(scene: &Scene, depth: u32, spp: u32) -> Frame {
    let prepared = Prepared::new(scene).unwrap();
    let request = RenderRequest {
        seed: 4,
        depth,
        record: Recorded::color_only(),
        ..RenderRequest::new(&prepared, 8, 8, spp)
    };
    render(&request, &Silent).unwrap()
}

/// The inside of a large lamp of radiance 1, seen from its centre.
fn lamp(distance: f32) -> Scene {
    let mut scene = empty(camera(Vec3::ZERO, Vec3::Z, 2.0));
    let light = add_material(&mut scene, diffuse(0.0), 1.0);
    let half = 3.0;
    quad(&mut scene, Vec3::new(-half, -half, distance), Vec3::Y * 2.0 * half, Vec3::X * 2.0 * half, light);
    scene
}

#[test]
fn a_lamp_is_dimmed_by_the_transmittance() {
    let (extinction, distance) = (0.35f64, 4.0f64);
    // Rays aside of the middle are longer by at most 1.5e-4 · 2 of the distance.
    let truth = (-extinction * distance).exp();
    let absorbing = Scene { medium: fog(0.35, 0.0, 0.0), ..lamp(4.0) };
    let frame = radiance(&absorbing, 8, 4);
    for value in frame.color.mean.data() {
        assert!((f64::from(*value) / truth - 1.0).abs() < 5e-4, "{value}, expected {truth}");
    }
    // Light that is scattered once more is not counted at depth 1.
    let scattering = Scene { medium: fog(0.1, 0.25, 0.5), ..lamp(4.0) };
    let frame = radiance(&scattering, 1, 1024);
    assert_radiance(&frame, truth, 0.01);
}

#[test]
fn each_colour_has_its_own_transmittance() {
    let mut scene = lamp(4.0);
    let (absorption, scattering) = (Vec3::new(0.0, 0.1, 0.9), Vec3::new(0.5, 0.1, 0.0));
    scene.medium = Some(Medium { absorption, scattering, mean_cosine: 0.0 });
    let frame = radiance(&scene, 1, 1024);
    for channel in 0..3 {
        let truth = f64::from(-(absorption + scattering)[channel] * 4.0).exp();
        let (mean, error) = average(&frame, channel);
        assert!(
            error < 0.01 * truth && (mean - truth).abs() < 4.5 * error + 5e-4 * truth,
            "{channel}: {mean} ± {error}, {truth}"
        );
    }
}

/// Radiance along the z axis from the origin by light that a ball lamp of radiance 1 sends and the medium scatters once:
/// midpoint rule over the ray and over the cone in which the lamp is seen from each of its points.
fn scattered_once(center: glam::DVec3, radius: f64, absorption: f64, scattering: f64, g: f64) -> f64 {
    let extinction = absorption + scattering;
    let (steps, far) = (600, 40.0);
    let mut sum = 0.0;
    for i in 0..steps {
        let z = (f64::from(i) + 0.5) / f64::from(steps) * far;
        let to = center - glam::DVec3::Z * z;
        let distance = to.length();
        let axis = to / distance;
        let side = axis.any_orthonormal_vector();
        let other = axis.cross(side);
        let lowest = (1.0 - (radius / distance).powi(2)).sqrt();
        let (rings, turns) = (16, 24);
        let mut light = 0.0;
        for r in 0..rings {
            let cos = lowest + (f64::from(r) + 0.5) / f64::from(rings) * (1.0 - lowest);
            let sin = (1.0 - cos * cos).sqrt();
            let near = distance * cos - (radius * radius - distance * distance * sin * sin).max(0.0).sqrt();
            for t in 0..turns {
                let (s, c) = (f64::from(t) / f64::from(turns) * std::f64::consts::TAU).sin_cos();
                let w = axis * cos + (side * c + other * s) * sin;
                // Light travels along −w and goes on along −z.
                let phase =
                    (1.0 - g * g) / (1.0 + g * g - 2.0 * g * w.z).powf(1.5) / (4.0 * std::f64::consts::PI);
                light += phase * (-extinction * near).exp();
            }
        }
        let solid = std::f64::consts::TAU * (1.0 - lowest) / f64::from(rings * turns);
        sum += scattering * (-extinction * z).exp() * light * solid * far / f64::from(steps);
    }
    sum
}

#[test]
fn light_that_is_scattered_once_is_its_integral() {
    for (g, absorption, scattering) in [(0.0, 0.05, 0.3), (0.7, 0.1, 0.2), (-0.5, 0.0, 0.4)] {
        let mut scene = empty(camera(Vec3::ZERO, Vec3::Z, 0.02));
        let light = add_material(&mut scene, diffuse(0.0), 1.0);
        sphere(&mut scene, Vec3::new(2.0, 0.5, 3.0), 0.8, light);
        scene.medium = fog(absorption, scattering, g);
        let truth = scattered_once(
            glam::DVec3::new(2.0, 0.5, 3.0),
            f64::from(0.8f32),
            f64::from(absorption),
            f64::from(scattering),
            f64::from(g),
        );
        let frame = radiance(&scene, 2, 4096);
        let (mean, error) = average(&frame, 0);
        // The quadrature is good to 2e-4: doubling its steps changes less.
        assert!(error < 0.006 * truth, "{error} is no test of {truth}");
        assert!(
            (mean - truth).abs() < 4.5 * error + 2e-4 * truth,
            "g = {g}: {mean} ± {error}, expected {truth}"
        );
    }
}

#[test]
fn a_glowing_box_looks_the_same_through_a_medium_that_only_scatters() {
    let mut scene = empty(camera(Vec3::new(0.2, 0.1, 0.0), Vec3::new(1.0, 0.3, 0.5), 60.0));
    let wall = add_material(&mut scene, diffuse(0.0), 1.0);
    cuboid(&mut scene, Vec3::splat(-1.0), Vec3::new(1.0, 1.5, 2.0), true, wall);
    let white = add_material(&mut scene, diffuse(1.0), 0.0);
    sphere(&mut scene, Vec3::new(0.5, 0.0, 0.6), 0.3, white);
    let glass = add_material(&mut scene, Scattering::Glass { ior: 1.4 }, 0.0);
    sphere(&mut scene, Vec3::new(0.3, 0.4, 0.2), 0.2, glass);
    for g in [0.0, 0.8] {
        scene.medium = fog(0.0, 1.5, g);
        assert_radiance(&radiance(&scene, 200, 512), 1.0, 0.01);
    }
}

#[test]
fn a_coloured_medium_stays_calm_over_many_scatterings() {
    let mut scene = empty(camera(Vec3::new(0.2, 0.1, 0.0), Vec3::new(1.0, 0.3, 0.5), 60.0));
    let wall = add_material(&mut scene, diffuse(0.0), 1.0);
    cuboid(&mut scene, Vec3::splat(-1.0), Vec3::new(1.0, 1.5, 2.0), true, wall);
    scene.medium =
        Some(Medium { absorption: Vec3::ZERO, scattering: Vec3::new(0.3, 1.0, 3.0), mean_cosine: 0.0 });
    // With a choice of the colour that forgets the throughput the spread of a sample is in the hundreds.
    assert_radiance(&radiance(&scene, 300, 512), 1.0, 0.01);
}

#[test]
fn the_mean_brdf_sample_is_that_of_the_surface_behind_the_medium() {
    let mut scene = empty(camera(Vec3::new(0.0, 1.0, 3.9), Vec3::new(0.0, 1.0, 0.0), 1.0));
    let metal = add_material(&mut scene, conductor(0.9, 0.9), 0.0);
    let light = add_material(&mut scene, diffuse(0.0), 1.0);
    quad(&mut scene, Vec3::new(-1.0, 0.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0, metal);
    quad(&mut scene, Vec3::new(-1.0, 4.0, 0.0), Vec3::X * 2.0, Vec3::Z * 2.0, light);
    let of = |medium| {
        let prepared = Prepared::new(&Scene { medium, ..scene.clone() }).unwrap();
        let record = Recorded::exactly([Quantity::Brdf]);
        let frame =
            render(&RenderRequest { record, ..RenderRequest::new(&prepared, 2, 2, 64) }, &Silent).unwrap();
        frame.features[&FeatureId::Brdf].mean.clone()
    };
    // The same random numbers, whatever floats before the surface.
    assert!(of(None) == of(fog(0.1, 2.0, 0.3)));
}

#[test]
fn features_behind_mirrors_are_refused_in_a_medium() {
    let prepared = Prepared::new(&Scene { medium: fog(0.1, 0.2, 0.0), ..cornell() }).unwrap();
    let feature_hit = FeatureHit::ThroughSpecular;
    let request = RenderRequest { feature_hit, ..RenderRequest::new(&prepared, 2, 2, 2) };
    assert!(
        render(&request, &Silent).unwrap_err().to_string().starts_with("feature_hit is through-specular")
    );
}

#[test]
fn there_is_no_medium_inside_glass() {
    let mut scene = lamp(4.0);
    // An index of 1 bends nothing: the ball only takes its diameter of 1.5 from the way.
    let glass = add_material(&mut scene, Scattering::Glass { ior: 1.0 }, 0.0);
    sphere(&mut scene, Vec3::Z * 2.0, 0.75, glass);
    scene.medium = fog(0.35, 0.0, 0.0);
    let truth = (-0.35f64 * 2.5).exp();
    for value in radiance(&scene, 8, 4).color.mean.data() {
        assert!((f64::from(*value) / truth - 1.0).abs() < 2e-3, "{value}, expected {truth}");
    }
}

#[test]
fn features_and_eye_light_belong_to_the_surface_behind_the_medium() {
    let clear = cornell();
    let foggy = Scene { medium: fog(0.1, 0.4, 0.3), ..clear.clone() };
    let [clear, foggy] = [clear, foggy].map(|scene| {
        let prepared = Prepared::new(&scene).unwrap();
        render(&RenderRequest::new(&prepared, 16, 12, 8), &Silent).unwrap()
    });
    for id in [FeatureId::Albedo, FeatureId::Normal, FeatureId::Depth, FeatureId::Material] {
        assert!(clear.features[&id].mean == foggy.features[&id].mean, "{id:?}");
    }
    let light = |frame: &Frame| match &frame.flash {
        Some(Flash::Parts { light, .. }) => light.mean.clone(),
        _ => panic!("parts are recorded"),
    };
    assert!(light(&clear) == light(&foggy));
    assert!(clear.color.mean != foggy.color.mean);
}

#[test]
fn a_medium_without_meaning_or_under_a_sky_is_refused() {
    let with = |medium| Prepared::new(&Scene { medium, ..cornell() }).map(drop).map_err(|e| e.to_string());
    assert_eq!(with(fog(0.1, 0.2, 0.5)), Ok(()));
    for (medium, word) in [
        (fog(-0.1, 0.2, 0.5), "absorption"),
        (fog(0.1, f32::NAN, 0.5), "scattering"),
        (fog(0.0, 0.0, 0.5), "extinction"),
        (fog(0.1, 0.1, 1.0), "mean cosine"),
    ] {
        let message = with(medium).unwrap_err();
        assert!(message.contains(word), "{message}");
    }
    let sky = Scene { medium: fog(0.1, 0.2, 0.5), ..with_sky(cornell(), 1.0) };
    assert!(Prepared::new(&sky).unwrap_err().to_string().contains("sky"));
}
