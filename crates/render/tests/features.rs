//! Features and the virtual flash.

mod common;

use std::collections::BTreeMap;
use std::f32::consts::PI;

use common::*;
use glam::Vec3;
use noisefloor_frame::{FeatureId, Flash, Frame, Image, PixelFilter};
use noisefloor_render::{
    FeatureHit, Keep, PixelClass, Prepared, Quantity, Recorded, RenderError, RenderRequest, Silent,
    available, pixel_classes, render,
};
use noisefloor_scenes::{Lens, Scattering, Scene};

fn parts(frame: &Frame) -> (&Image, &Image, &Image) {
    match frame.flash.as_ref().unwrap() {
        Flash::Parts { base, light, covariance } => (&base.mean, &light.mean, covariance.as_ref().unwrap()),
        Flash::Ready(_) => panic!("the renderer keeps the parts apart"),
    }
}

/// One pixel through its centre, everything recorded.
fn one_pixel(scene: &Scene, spp: u32) -> Frame {
    let prepared = Prepared::new(scene).unwrap();
    let request = RenderRequest { filter: PixelFilter::Point, ..RenderRequest::new(&prepared, 1, 1, spp) };
    render(&request, &Silent).unwrap()
}

#[test]
fn recording_changes_no_bit_of_the_colour() {
    let scene = Prepared::new(&cornell()).unwrap();
    let all = RenderRequest::new(&scene, 20, 15, 9);
    let full = render(&all, &Silent).unwrap();
    for record in
        [Recorded::color_only(), Recorded::exactly([Quantity::Flash]), Recorded::exactly([Quantity::Depth])]
    {
        let frame = render(&RenderRequest { record, ..all.clone() }, &Silent).unwrap();
        assert!(frame.color == full.color);
    }
    let only = Recorded::Exactly(BTreeMap::from([(Quantity::Depth, Keep { variance: true, halves: false })]));
    let frame = render(&RenderRequest { record: only, ..all.clone() }, &Silent).unwrap();
    let depth = &frame.features[&FeatureId::Depth];
    assert!(frame.features.len() == 1 && frame.flash.is_none());
    assert!(depth.halves.is_none() && depth.variance == full.features[&FeatureId::Depth].variance);
}

#[test]
fn direct_light_is_the_colour_at_depth_two() {
    let scene = Prepared::new(&cornell()).unwrap();
    let deep = RenderRequest::new(&scene, 20, 15, 16);
    let shallow = RenderRequest { depth: 2, ..deep.clone() };
    let (deep, shallow) = (render(&deep, &Silent).unwrap(), render(&shallow, &Silent).unwrap());
    assert!(deep.features[&FeatureId::Direct] == shallow.color);
}

#[test]
fn on_diffuse_surfaces_the_flash_base_is_direct_light() {
    let scene = Prepared::new(&cornell()).unwrap();
    let frame = render(&RenderRequest::new(&scene, 20, 15, 16), &Silent).unwrap();
    let (base, _, _) = parts(&frame);
    assert!(*base == frame.features[&FeatureId::Direct].mean);
    let below = base.data().iter().zip(frame.color.mean.data()).all(|(f, c)| f <= c);
    assert!(below, "every path's F0 is a part of its colour");
}

#[test]
fn the_eye_light_is_albedo_over_pi_times_cosine_over_squared_distance() {
    let mut scene = with_sky(empty(camera(Vec3::new(3.0, 4.0, 0.0), Vec3::ZERO, 10.0)), 1.0);
    let material = add_material(&mut scene, diffuse_rgb(Vec3::new(0.2, 0.5, 0.8)), 0.0);
    quad(&mut scene, Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, material);
    let frame = one_pixel(&scene, 4);
    let (_, light, _) = parts(&frame);
    for (c, albedo) in [0.2f32, 0.5, 0.8].into_iter().enumerate() {
        let truth = albedo / PI * 0.8 / 25.0;
        assert!((light.get(c, 0, 0) / truth - 1.0).abs() < 1e-4);
    }
}

#[test]
fn a_mirror_is_followed_and_lit_straight_from_the_eye() {
    // Eye at height 1 looks down into a mirror at 45°, which shows a wall at x = 3.
    let mut scene = empty(camera(Vec3::new(0.0, 1.0, 0.0), Vec3::ZERO, 10.0));
    let mirror = add_material(&mut scene, Scattering::Mirror { reflectance: Vec3::splat(0.5) }, 0.0);
    let wall = add_material(&mut scene, diffuse(0.6), 0.0);
    let light = add_material(&mut scene, diffuse(0.0), 7.0);
    quad(&mut scene, Vec3::new(-0.1, 0.1, -0.1), Vec3::Z * 0.2, Vec3::new(0.2, -0.2, 0.0), mirror);
    quad(&mut scene, Vec3::new(3.0, -2.0, -2.0), Vec3::Z * 4.0, Vec3::Y * 4.0, wall);
    sphere(&mut scene, Vec3::new(1.5, 2.0, 0.0), 0.3, light);
    let frame = one_pixel(&scene, 4096);
    let (base, eye_light, _) = parts(&frame);
    let squared = 10.0f32; // from (0, 1, 0) to (3, 0, 0)
    let truth = 0.5 * 0.6 / PI * (3.0 / squared.sqrt()) / squared;
    assert!((eye_light.get(0, 0, 0) / truth - 1.0).abs() < 1e-4);
    // F0 at the wall: the ball's irradiance, reflected by both.
    let squared = 1.5f64 * 1.5 + 4.0;
    let truth = 0.5 * 0.6 * 7.0 * (0.09 / squared) * (1.5 / squared.sqrt());
    assert!((f64::from(base.get(0, 0, 0)) / truth - 1.0).abs() < 0.02, "{} {truth}", base.get(0, 0, 0));
    assert_eq!(
        frame.features[&FeatureId::Visibility].mean.get(0, 0, 0),
        0.0,
        "no shadow ray leaves a mirror"
    );
    assert_eq!(frame.features[&FeatureId::Albedo].mean.get(0, 0, 0), 0.5);
}

#[test]
fn a_glossy_surface_adds_its_eye_light_and_hands_on() {
    let mut scene = with_sky(empty(camera(Vec3::new(0.0, 2.0, 0.0), Vec3::ZERO, 10.0)), 1.0);
    let metal = add_material(&mut scene, conductor(0.7, 0.4), 0.0);
    quad(&mut scene, Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, metal);
    let frame = one_pixel(&scene, 64);
    let (base, light, _) = parts(&frame);
    // Looking straight down: D(n) = 1/(π α²), F = f0, G₂ = 1, so f·cos = f0/(4π α²).
    let truth = 0.7 / (4.0 * PI * 0.16) / 4.0;
    assert!((light.get(0, 0, 0) / truth - 1.0).abs() < 1e-3);
    assert!(*base == frame.color.mean, "nothing diffuse: the whole path is reused");
}

#[test]
fn the_eye_light_stops_growing_close_to_the_eye() {
    let mut scene = with_sky(empty(camera(Vec3::new(0.0, 0.01, 0.0), Vec3::ZERO, 10.0)), 1.0);
    let material = add_material(&mut scene, diffuse(1.0), 0.0);
    quad(&mut scene, Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, material);
    let frame = one_pixel(&scene, 2);
    let radius = 50.0f32.sqrt();
    let truth = 1.0 / PI / (0.01 * radius).powi(2);
    assert!((parts(&frame).1.get(0, 0, 0) / truth - 1.0).abs() < 1e-3);
}

#[test]
fn covariance_of_the_flash_parts_is_that_between_seeds() {
    // Pixels that straddle two albedos: F0 and S vary together.
    let mut scene = with_sky(empty(camera(Vec3::new(0.0, 4.0, 0.0), Vec3::ZERO, 40.0)), 1.0);
    for (albedo, x) in [(0.2, -5.0), (0.9, 0.0)] {
        let material = add_material(&mut scene, diffuse(albedo), 0.0);
        quad(&mut scene, Vec3::new(x, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 5.0, material);
    }
    let prepared = Prepared::new(&scene).unwrap();
    let mut differences = Vec::new();
    let frames: Vec<Frame> = (0..40)
        .map(|seed| {
            render(&RenderRequest { seed, ..RenderRequest::new(&prepared, 1, 60, 8) }, &Silent).unwrap()
        })
        .collect();
    let mut sum = 0.0;
    for y in 0..60 {
        let n = frames.len() as f64;
        let value = |f: &Frame, k: usize| {
            let p = parts(f);
            f64::from([p.0, p.1, p.2][k].get(1, 0, y))
        };
        let mean = |k| frames.iter().map(|f| value(f, k)).sum::<f64>() / n;
        let (mf, ms, within) = (mean(0), mean(1), mean(2));
        let between = frames.iter().map(|f| (value(f, 0) - mf) * (value(f, 1) - ms)).sum::<f64>() / (n - 1.0);
        differences.push(between - within);
        sum += within;
    }
    let z = differences.iter().sum::<f64>() / differences.iter().map(|d| d * d).sum::<f64>().sqrt();
    assert!(z.abs() < 4.0, "{z}");
    assert!(sum > 0.0, "brighter albedo brightens both");
}

#[test]
fn visibility_is_the_reached_share_of_shadow_rays() {
    let mut scene = empty(camera(Vec3::new(0.0, 4.0, 0.0), Vec3::ZERO, 10.0));
    let white = add_material(&mut scene, diffuse(0.5), 0.0);
    let light = add_material(&mut scene, diffuse(0.0), 1.0);
    quad(&mut scene, Vec3::new(-5.0, 0.0, -5.0), Vec3::Z * 10.0, Vec3::X * 10.0, white);
    quad(&mut scene, Vec3::new(1.0, 3.0, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0, light);
    let seen =
        |scene: &Scene| f64::from(one_pixel(scene, 2048).features[&FeatureId::Visibility].mean.data()[0]);
    assert_eq!(seen(&scene), 1.0);
    let mut half = scene.clone();
    // Halfway up, hides from the origin the half of the light with z > 0.
    quad(&mut half, Vec3::new(0.2, 1.5, 0.0), Vec3::X * 2.0, Vec3::Z * 2.0, white);
    // Binomial: four standard errors of 2048 trials.
    assert!((seen(&half) - 0.5).abs() < 4.0 * (0.25f64 / 2048.0).sqrt());
    let halves = one_pixel(&half, 2048).features[&FeatureId::Visibility].clone();
    let [a, b] = halves.halves.unwrap();
    assert!((0.5 * (a.data()[0] + b.data()[0]) - halves.mean.data()[0]).abs() < 1e-3);
    // R(1−R)/(n−1) where every sample traces a shadow ray.
    let (share, n) = (f64::from(halves.mean.data()[0]), 2048.0);
    let expected = share * (1.0 - share) / (n - 1.0);
    let variance = f64::from(halves.variance.unwrap().mean_variance().data()[0]);
    assert!((variance - expected).abs() < 1e-5 * expected, "{variance} {expected}");
    quad(&mut half, Vec3::new(0.2, 1.5, -2.0), Vec3::X * 2.0, Vec3::Z * 2.0, white);
    assert_eq!(seen(&half), 0.0);
}

#[test]
fn samples_without_a_shadow_ray_do_not_dilute_the_visibility() {
    // Box filter over the edge of a lit quad: samples beside it trace nothing.
    let mut scene = empty(camera(Vec3::new(0.0, 4.0, 0.0), Vec3::ZERO, 10.0));
    let white = add_material(&mut scene, diffuse(0.5), 0.0);
    let light = add_material(&mut scene, diffuse(0.0), 1.0);
    quad(&mut scene, Vec3::new(-5.0, 0.0, 0.0), Vec3::Z * 5.0, Vec3::X * 10.0, white);
    quad(&mut scene, Vec3::new(1.0, 3.0, 1.0), Vec3::X * 2.0, Vec3::Z * 2.0, light);
    let prepared = Prepared::new(&scene).unwrap();
    let frame = render(&RenderRequest::new(&prepared, 1, 1, 256), &Silent).unwrap();
    let depth = frame.features[&FeatureId::Depth].mean.data()[0];
    assert!(depth > 1.0 && depth < 3.5, "about half of the samples hit: {depth}");
    assert_eq!(frame.features[&FeatureId::Visibility].mean.data(), [1.0]);
}

#[test]
fn background_is_named_and_dark() {
    let mut scene = empty(camera(Vec3::Z * 5.0, Vec3::ZERO, 10.0));
    let white = add_material(&mut scene, diffuse(0.5), 0.0);
    sphere(&mut scene, Vec3::X * 3.0, 0.5, white);
    let frame = one_pixel(&scene, 2);
    assert_eq!(frame.features[&FeatureId::Material].mean.data(), [-1.0]);
    assert_eq!(frame.features[&FeatureId::Depth].mean.data(), [0.0]);
    let names: Vec<&str> = available(&scene).into_iter().map(Quantity::name).collect();
    assert_eq!(names, ["albedo", "normal", "depth", "material", "brdf"], "there is no light");
    let prepared = Prepared::new(&scene).unwrap();
    let record = Recorded::exactly([Quantity::Flash]);
    let error =
        render(&RenderRequest { record, ..RenderRequest::new(&prepared, 1, 1, 2) }, &Silent).unwrap_err();
    assert!(matches!(error, RenderError::Unavailable { quantity: "flash", .. }), "{error}");
    assert!(error.to_string().ends_with("it can give: albedo, normal, depth, material, brdf"), "{error}");
}

#[test]
fn the_mean_brdf_sample_is_the_reflectance_of_the_surface() {
    let of = |scattering: Scattering, spp: u32| {
        let mut scene = with_sky(empty(camera(Vec3::Z * 4.0, Vec3::ZERO, 5.0)), 1.0);
        let material = add_material(&mut scene, scattering, 0.0);
        sphere(&mut scene, Vec3::ZERO, 1.0, material);
        let prepared = Prepared::new(&scene).unwrap();
        let record = Recorded::exactly([Quantity::Brdf, Quantity::Albedo]);
        render(&RenderRequest { record, depth: 2, ..RenderRequest::new(&prepared, 1, 1, spp) }, &Silent)
            .unwrap()
    };
    for (scattering, truth) in [
        (diffuse(0.3), 0.3),
        (Scattering::Mirror { reflectance: Vec3::splat(0.8) }, 0.8),
        (Scattering::Glass { ior: 1.5 }, 1.0),
    ] {
        let brdf = &of(scattering, 16).features[&FeatureId::Brdf];
        assert!(brdf.mean.data().iter().all(|v| (v - truth).abs() < 1e-6));
        assert!(brdf.variance.as_ref().unwrap().mean_variance().data().iter().all(|v| *v < 1e-12));
    }
    // Under a white sky a surface looks as bright as it reflects: two estimates of the same integral.
    let frame = of(conductor(0.9, 0.6), 4096);
    let brdf = &frame.features[&FeatureId::Brdf];
    let at = |estimate: &noisefloor_frame::Estimate| {
        let variance = estimate.variance.as_ref().unwrap().mean_variance().data()[0];
        (f64::from(estimate.mean.data()[0]), f64::from(variance))
    };
    let ((a, va), (b, vb)) = (at(brdf), at(&frame.color));
    assert!((a - b).abs() < 4.5 * (va + vb).sqrt(), "{a} {b}");
    assert!(va > 0.0 && a < 0.9 && (va + vb).sqrt() < 0.01, "{a} ± {}", va.sqrt());
    assert_eq!(frame.features[&FeatureId::Albedo].mean.data()[0], 0.9);
}

#[test]
fn rare_features_change_nothing_else() {
    let prepared = Prepared::new(&cornell()).unwrap();
    let with = |record| {
        render(&RenderRequest { record, ..RenderRequest::new(&prepared, 12, 9, 8) }, &Silent).unwrap()
    };
    let usual = [
        Quantity::Albedo,
        Quantity::Normal,
        Quantity::Depth,
        Quantity::Visibility,
        Quantity::Direct,
        Quantity::Flash,
    ];
    let few = with(Recorded::exactly(usual));
    let many = with(Recorded::Available);
    assert!(few.color == many.color && few.flash == many.flash);
    for (id, feature) in &few.features {
        assert!(*feature == many.features[id], "{id:?}");
    }
    assert!(many.features.contains_key(&FeatureId::Brdf) && !few.features.contains_key(&FeatureId::Brdf));
    assert!(many.flash == with(Recorded::exactly([Quantity::Flash, Quantity::Brdf])).flash);
}

#[test]
fn classes_follow_the_first_hit() {
    let mut scene = with_sky(empty(camera(Vec3::Z * 10.0, Vec3::ZERO, 30.0)), 1.0);
    let kinds = [diffuse(0.5), conductor(0.5, 0.2), diffuse(0.0)];
    for (k, kind) in kinds.into_iter().enumerate() {
        let emission = if k == 2 { 1.0 } else { 0.0 };
        let material = add_material(&mut scene, kind, emission);
        sphere(&mut scene, Vec3::X * (2.0 * k as f32 - 3.0), 0.9, material);
    }
    let classes = |scene: &Scene| pixel_classes(&Prepared::new(scene).unwrap(), 4, 1).unwrap().classes;
    scene.camera.vertical_fov_degrees = 2.0 * (1.0f32 / 10.0).atan().to_degrees();
    let expected = [PixelClass::Plain, PixelClass::Glossy, PixelClass::Emitter, PixelClass::Background];
    assert_eq!(classes(&scene), expected);
    scene.camera.lens = Some(Lens { radius: 2.0, focus_distance: 2.0 });
    assert_eq!(classes(&scene)[0], PixelClass::OutOfFocus);
}

/// A mirror floor below a wall: the ray goes 2 units down to the mirror and 3 on to the wall.
fn mirrored() -> Scene {
    let eye = Vec3::new(0.0, 1.2, -1.6);
    let mut scene = empty(camera(eye, Vec3::ZERO, 1.0));
    let mirror = add_material(&mut scene, Scattering::Mirror { reflectance: Vec3::new(0.9, 0.5, 0.3) }, 0.0);
    let wall = add_material(&mut scene, diffuse_rgb(Vec3::new(0.8, 0.6, 0.4)), 0.0);
    quad(&mut scene, Vec3::new(-9.0, 0.0, -9.0), 18.0 * Vec3::Z, 18.0 * Vec3::X, mirror);
    // The reflected ray runs along (0, 0.6, 0.8): it meets z = 2.4 after 3 units.
    quad(&mut scene, Vec3::new(-9.0, -9.0, 2.4), 18.0 * Vec3::Y, 18.0 * Vec3::X, wall);
    with_sky(scene, 1.0)
}

#[test]
fn features_are_taken_behind_mirrors_if_asked_and_colour_does_not_change() {
    let scene = Prepared::new(&mirrored()).unwrap();
    let first = RenderRequest { filter: PixelFilter::Point, ..RenderRequest::new(&scene, 1, 1, 64) };
    let through = RenderRequest { feature_hit: FeatureHit::ThroughSpecular, ..first.clone() };
    let (first, through) = (render(&first, &Silent).unwrap(), render(&through, &Silent).unwrap());
    assert!(first.color == through.color && first.flash == through.flash);
    let value = |frame: &Frame, id: FeatureId| frame.features[&id].mean.data().to_vec();
    let near = |found: Vec<f32>, expected: &[f32]| {
        assert!(
            found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4),
            "{found:?}, expected {expected:?}"
        );
    };
    near(value(&first, FeatureId::Depth), &[2.0]);
    near(value(&first, FeatureId::Albedo), &[0.9, 0.5, 0.3]);
    near(value(&first, FeatureId::Visibility), &[0.0]);
    near(value(&through, FeatureId::Depth), &[5.0]);
    near(value(&through, FeatureId::Albedo), &[0.72, 0.3, 0.12]);
    near(value(&through, FeatureId::Normal), &[0.0, 0.0, -1.0]);
    near(value(&through, FeatureId::Material), &[1.0]);
    assert!(value(&through, FeatureId::Visibility)[0] > 0.0, "shadow rays start at the wall");
    let direct = value(&through, FeatureId::Direct);
    assert!(direct[0] > 0.0 && direct != value(&first, FeatureId::Direct), "{direct:?}");
    assert_eq!(through.provenance.extra["feature_hit"], "through-specular");
    assert!(!first.provenance.extra.contains_key("feature_hit"));
}

#[test]
fn what_a_mirror_shows_of_the_sky_is_background_and_without_mirrors_nothing_changes() {
    let through = |scene: &Scene, depth: u32| {
        let scene = Prepared::new(scene).unwrap();
        let first = RenderRequest { depth, ..RenderRequest::new(&scene, 12, 9, 8) };
        let through = RenderRequest { feature_hit: FeatureHit::ThroughSpecular, ..first.clone() };
        (render(&first, &Silent).unwrap().features, render(&through, &Silent).unwrap().features)
    };
    let (first, followed) = through(&cornell(), 8);
    assert!(first == followed, "no specular surface");
    let mut open = mirrored();
    open.meshes.truncate(1);
    let (_, followed) = through(&open, 8);
    assert!(followed[&FeatureId::Depth].mean.data().iter().all(|d| *d == 0.0));
    assert!(followed[&FeatureId::Material].mean.data().iter().all(|m| *m == -1.0));
    let (first, followed) = through(&open, 1);
    assert!(first == followed, "a path that ends on the mirror has its features");
}
