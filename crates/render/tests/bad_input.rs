//! Bad scenes and requests: typed errors or defined results.

mod common;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::*;
use glam::Vec3;
use noisefloor_frame::Sampling;
use noisefloor_render::{
    Integrator, PhotonMaps, PhotonSettings, Prepared, RenderError, RenderRequest, Silent, pixel_classes,
    render, render_reference,
};
use noisefloor_scenes::{EnvironmentMap, Lens, Medium, Scattering, Scene, Sky, Sun};

/// A valid scene that a test then spoils; the message of the error.
fn spoil(change: impl FnOnce(&mut Scene)) -> String {
    let mut scene = cornell();
    change(&mut scene);
    Prepared::new(&scene).unwrap_err().to_string()
}

#[test]
fn an_empty_scene_is_refused() {
    let scene = empty(camera(Vec3::Z, Vec3::ZERO, 30.0));
    assert!(matches!(Prepared::new(&scene), Err(RenderError::EmptyScene { dropped: 0, .. })));
}

#[test]
fn the_offending_number_is_named() {
    let cases: [(&str, String); 13] = [
        ("mesh 1, vertex 2", spoil(|s| s.meshes[1].positions[2].y = f32::NAN)),
        ("mesh 3, triangle 1, vertex index is 9", spoil(|s| s.meshes[3].triangles[1][0] = 9)),
        ("mesh 0, material is 77", spoil(|s| s.meshes[0].material = 77)),
        ("mesh 2, normals is 1", spoil(|s| s.meshes[2].normals = vec![Vec3::Y])),
        ("albedo", spoil(|s| s.materials[0].scattering = diffuse(1.5))),
        ("emission", spoil(|s| s.materials[0].emission.x = f32::INFINITY)),
        ("alpha", spoil(|s| s.materials[0].scattering = conductor(0.5, 0.0))),
        ("refractive index", spoil(|s| s.materials[0].scattering = Scattering::Glass { ior: f32::NAN })),
        ("sphere 0, radius is -1", spoil(|s| sphere(s, Vec3::ZERO, -1.0, 0))),
        ("camera up", spoil(|s| s.camera.up = s.camera.target - s.camera.eye)),
        ("focus distance", spoil(|s| s.camera.lens = Some(Lens { radius: 1.0, focus_distance: 0.0 }))),
        (
            "texel (1, 0)",
            spoil(|s| {
                let texels = vec![Vec3::ONE, Vec3::splat(-1.0)];
                s.sky = Some(Sky::Map(EnvironmentMap { width: 2, height: 1, texels }.into()));
            }),
        ),
        ("sky", spoil(|s| s.sky = Some(Sky::Constant(Vec3::splat(-1.0))))),
    ];
    for (expected, message) in cases {
        assert!(message.contains(expected), "{message}");
    }
    let sun = Sun { direction: Vec3::ZERO, half_angle_degrees: 1.0, irradiance: Vec3::ONE };
    assert!(spoil(|s| s.sun = Some(sun)).contains("sun direction"));
}

#[test]
fn degenerate_triangles_are_dropped_and_counted() {
    let mut scene = cornell();
    let intact = render(&RenderRequest::new(&Prepared::new(&scene).unwrap(), 8, 6, 4), &Silent).unwrap();
    for mesh in &mut scene.meshes {
        mesh.triangles.push([0, 0, 1]);
    }
    // A light without area gives no light and takes no samples.
    quad(&mut scene, Vec3::ZERO, Vec3::ZERO, Vec3::X, 3);
    let prepared = Prepared::new(&scene).unwrap();
    assert_eq!(prepared.dropped_triangles(), scene.meshes.len() - 1 + 2);
    let frame = render(&RenderRequest::new(&prepared, 8, 6, 4), &Silent).unwrap();
    assert!(frame.color == intact.color);
    let mut nothing = empty(camera(Vec3::Z, Vec3::ZERO, 30.0));
    add_material(&mut nothing, diffuse(0.5), 1.0);
    quad(&mut nothing, Vec3::ZERO, Vec3::X, Vec3::X, 0);
    assert!(matches!(Prepared::new(&nothing), Err(RenderError::EmptyScene { dropped: 2, .. })));
}

#[test]
fn requests_out_of_range_name_their_parameter() {
    let prepared = Prepared::new(&cornell()).unwrap();
    let good = RenderRequest::new(&prepared, 4, 4, 16);
    let cases = [
        ("width × height", RenderRequest { width: 0, ..good.clone() }),
        ("width × height", RenderRequest { height: usize::MAX, ..good.clone() }),
        ("spp", RenderRequest { spp: 0, ..good.clone() }),
        ("sample_start", RenderRequest { sample_start: u32::MAX, ..good.clone() }),
        ("depth", RenderRequest { depth: 0, ..good.clone() }),
        ("depth", RenderRequest { depth: 5000, ..good.clone() }),
        ("spp", RenderRequest { sampling: Sampling::LowDiscrepancy, spp: 131_074, ..good.clone() }),
    ];
    for (parameter, request) in cases {
        let error = render(&request, &Silent).unwrap_err().to_string();
        assert!(error.starts_with(parameter), "{error}");
    }
    for (parameter, spp, parts) in [("parts", 16, 4), ("spp", 17, 8), ("spp", 65_537 * 8, 8)] {
        let error = render_reference(&RenderRequest { spp, ..good.clone() }, parts, &Silent).unwrap_err();
        assert!(error.to_string().starts_with(parameter), "{error}");
    }
    assert!(pixel_classes(&prepared, 3, 0).is_err());
}

#[test]
fn progress_adds_up_and_can_cancel() {
    let prepared = Prepared::new(&cornell()).unwrap();
    let request = RenderRequest::new(&prepared, 33, 17, 500);
    let seen = AtomicUsize::new(0);
    let count = |pixels| {
        seen.fetch_add(pixels, Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    render(&RenderRequest { spp: 2, ..request.clone() }, &count).unwrap();
    assert_eq!(seen.into_inner(), 33 * 17);
    let stop = |_: usize| ControlFlow::Break(());
    assert_eq!(render(&request, &stop), Err(RenderError::Cancelled));
}

#[test]
fn an_eye_inside_a_wall_or_on_a_surface_gives_finite_frames() {
    for eye in [Vec3::new(0.0, 0.0, 0.0), Vec3::new(-0.35, 0.5, -0.35), Vec3::new(0.0, 2.0, 0.5)] {
        for way in ["paths", "photons", "medium"] {
            let mut scene = cornell();
            scene.camera.eye = eye;
            scene.camera.target = Vec3::new(0.3, 0.9, -0.9);
            if way == "medium" {
                let (absorption, scattering) = (Vec3::splat(0.1), Vec3::splat(0.5));
                scene.medium = Some(Medium { absorption, scattering, mean_cosine: 0.4 });
            }
            let prepared = Prepared::new(&scene).unwrap();
            let few = PhotonSettings { paths: 2000, caustic_paths: 2000, ..PhotonSettings::default() };
            let maps = (way == "photons").then(|| PhotonMaps::new(&prepared, &few, 0).unwrap());
            let mut request = RenderRequest::new(&prepared, 16, 12, 16);
            if maps.is_some() {
                request.integrator = Integrator::PhotonMapping;
                request.photons = maps.as_ref();
            }
            let frame = render(&request, &Silent).unwrap();
            assert_eq!(frame.color.mean.count_non_finite(), 0, "{way} {eye}");
            assert!(!frame.provenance.extra.contains_key("non_finite_samples"), "{way} {eye}");
        }
    }
}

#[test]
fn tiny_and_huge_scenes_look_alike() {
    let image = |scale: f32| {
        let mut scene = cornell();
        scene.camera.eye *= scale;
        scene.camera.target *= scale;
        scene.meshes.iter_mut().flat_map(|m| &mut m.positions).for_each(|p| *p *= scale);
        let prepared = Prepared::new(&scene).unwrap();
        render(&RenderRequest::new(&prepared, 24, 18, 64), &Silent).unwrap().color.mean
    };
    let one = image(1.0);
    for scale in [1e-4f32, 1e4] {
        let other = image(scale);
        let difference: f64 =
            one.data().iter().zip(other.data()).map(|(a, b)| f64::from(a - b)).sum::<f64>().abs();
        let total: f64 = one.data().iter().map(|&v| f64::from(v)).sum();
        // The same random numbers: only rounding tells the images apart.
        assert!(difference < 2e-3 * total, "scale {scale}: {}", difference / total);
    }
}
