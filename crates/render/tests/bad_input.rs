//! Bad scenes and requests: typed errors or defined results.

mod common;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::*;
use glam::Vec3;
use noisefloor_frame::Sampling;
use noisefloor_render::{
    Integrator, PhotonMaps, PhotonSettings, Prepared, Recorded, RenderError, RenderRequest, Rounds, Silent,
    pixel_classes, render, render_reference,
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
fn images_beyond_the_memory_are_refused_before_they_are_taken() {
    let prepared = Prepared::new(&cornell()).unwrap();
    let request =
        RenderRequest { record: Recorded::color_only(), ..RenderRequest::new(&prepared, 16384, 16384, 4) };
    // Mean, variance and halves of three channels, for the frame and its file.
    assert_eq!(request.memory(None).unwrap(), (1 << 28) * 12 * 8);
    let error = render(&RenderRequest { max_memory: 6 << 30, ..request.clone() }, &Silent).unwrap_err();
    let RenderError::Memory { bytes, allowed, planes: 12, .. } = error else { panic!("{error}") };
    assert_eq!((bytes, allowed), ((1 << 28) * 12 * 8, 6 << 30));
    assert!(error.to_string().contains("16384×16384"), "{error}");
    // A reference: eight parts, and the mean that nothing is recorded beside.
    assert_eq!(request.memory(Some(8)).unwrap(), (1 << 28) * (3 * 8 + 3) * 8);
    let error =
        render_reference(&RenderRequest { spp: 1024 * 8, ..request.clone() }, 1024, &Silent).unwrap_err();
    assert!(matches!(error, RenderError::Memory { .. }), "more than 64 GiB by default: {error}");
    let small = RenderRequest { max_memory: 1000, ..RenderRequest::new(&prepared, 8, 8, 4) };
    assert!(matches!(Rounds::start(&small, &Silent), Err(RenderError::Memory { .. })));
}

#[test]
fn light_beyond_the_range_of_arithmetic_is_refused_where_it_stands() {
    let map =
        |texels: Vec<Vec3>| Some(Sky::Map(EnvironmentMap { width: texels.len(), height: 1, texels }.into()));
    let bright = Vec3::splat(3e38);
    let told = spoil(|s| s.sky = map(vec![Vec3::ONE, Vec3::ONE, bright]));
    assert!(told.contains("texel (2, 0)") && told.contains("at most 1e15"), "{told}");
    for told in [
        spoil(|s| s.sky = map(vec![bright])),
        spoil(|s| s.sky = Some(Sky::Constant(bright))),
        spoil(|s| s.materials[0].emission = bright),
        spoil(|s| {
            s.sun = Some(Sun { direction: Vec3::Y, half_angle_degrees: 1.0, irradiance: bright });
        }),
        spoil(|s| {
            s.sun = Some(Sun { direction: Vec3::Y, half_angle_degrees: 1e-3, irradiance: Vec3::splat(1e14) });
        }),
    ] {
        assert!(told.contains("at most 1e1"), "{told}");
    }
}

#[test]
fn the_brightest_light_that_is_allowed_gives_a_picture() {
    let white = |s: &mut Scene, light: f32| {
        s.materials.iter_mut().for_each(|m| m.emission = Vec3::ZERO);
        s.sky =
            Some(Sky::Map(EnvironmentMap { width: 1, height: 1, texels: vec![Vec3::splat(light)] }.into()));
    };
    let picture = |light: f32| {
        let mut scene = cornell();
        white(&mut scene, light);
        let prepared = Prepared::new(&scene).unwrap();
        render(
            &RenderRequest { record: Recorded::color_only(), ..RenderRequest::new(&prepared, 16, 12, 16) },
            &Silent,
        )
    };
    let (dim, bright) = (picture(1.0).unwrap(), picture(1e15).unwrap());
    for (a, b) in dim.color.mean.data().iter().zip(bright.color.mean.data()) {
        assert!((f64::from(*b) - 1e15 * f64::from(*a)).abs() <= 1e-4 * f64::from(*b), "{a} {b}");
    }
    let variance = bright.color.variance.unwrap();
    assert_eq!(variance.mean_variance().count_non_finite(), 0);
    // A scene as large as may be, under a sky of any brightness: the powers of lights do not overflow into nothing.
    let mut scene = empty(camera(Vec3::new(0.0, 0.0, 9e14), Vec3::ZERO, 30.0));
    add_material(&mut scene, diffuse(0.5), 0.0);
    sphere(&mut scene, Vec3::ZERO, 1e14, 0);
    scene.sky = Some(Sky::Constant(Vec3::splat(1e15)));
    let frame = render(&RenderRequest::new(&Prepared::new(&scene).unwrap(), 8, 6, 16), &Silent).unwrap();
    assert!(frame.color.mean.data().iter().all(|v| *v > 1e14), "{:?}", frame.color.mean.data());
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
