//! The built-in scenes whose image is known: whole images against their formulas, and how fast errors fall.

use noisefloor_frame::{Frame, PixelFilter, Sampling};
use noisefloor_render::{Prepared, Recorded, RenderRequest, Silent, render};
use noisefloor_scenes::analytic::{BALL_OFFSET, ball_irradiance, panel_irradiance, panel_irradiance_at};
use noisefloor_scenes::{Rays, Scene, closed_form, find};

const WIDTH: usize = 16;
const HEIGHT: usize = 12;

fn scene(id: &str) -> Scene {
    (find(id).unwrap().build)()
}

fn image(scene: &Prepared, spp: u32, seed: u64, sampling: Sampling) -> Frame {
    let request = RenderRequest {
        seed,
        sampling,
        depth: 2,
        filter: PixelFilter::Point,
        record: Recorded::color_only(),
        ..RenderRequest::new(scene, WIDTH, HEIGHT, spp)
    };
    render(&request, &Silent).unwrap()
}

/// Where the ray through the centre of each pixel meets the plane y = 0.
fn points(scene: &Scene) -> Vec<glam::DVec3> {
    let camera = &scene.camera;
    let (eye, target, up) = (camera.eye.as_dvec3(), camera.target.as_dvec3(), camera.up.as_dvec3());
    let forward = (target - eye).normalize();
    let right = forward.cross(up).normalize();
    let above = right.cross(forward);
    let half = (0.5 * f64::from(camera.vertical_fov_degrees).to_radians()).tan();
    (0..WIDTH * HEIGHT)
        .map(|p| {
            let x = ((p % WIDTH) as f64 + 0.5 - 0.5 * WIDTH as f64) / (0.5 * HEIGHT as f64);
            let y = (0.5 * HEIGHT as f64 - (p / WIDTH) as f64 - 0.5) / (0.5 * HEIGHT as f64);
            let ray = forward + right * (x * half) + above * (y * half);
            eye - ray * (eye.y / ray.y)
        })
        .collect()
}

/// 0.7/π times the irradiance of the lamp of `gradient`.
fn gradient_truth() -> Vec<f64> {
    let aside = |p: glam::DVec3| (p.x + f64::from(BALL_OFFSET)).hypot(p.z);
    points(&scene("gradient"))
        .into_iter()
        .map(|p| 0.7 / std::f64::consts::PI * ball_irradiance(f64::from(0.9f32), 2.0, aside(p)))
        .collect()
}

#[test]
fn the_gradient_scene_is_its_formula_in_every_pixel() {
    let frame = image(&Prepared::new(&scene("gradient")).unwrap(), 1024, 5, Sampling::Independent);
    let variance = frame.color.variance.as_ref().unwrap().mean_variance().plane(1).to_vec();
    let z: Vec<f64> = (0..WIDTH * HEIGHT)
        .zip(gradient_truth())
        .map(|(p, truth)| {
            let (value, error) = (f64::from(frame.color.mean.plane(1)[p]), f64::from(variance[p]).sqrt());
            assert!(error < 0.02 * truth, "pixel {p}: {error} is no test of {truth}");
            (value - truth) / error
        })
        .collect();
    // 192 independent pixels: the largest |z| exceeds 4.2 with probability 0.5 %; χ² has 192 ± 19.6.
    assert!(z.iter().all(|z| z.abs() < 4.2), "{z:?}");
    let chi = z.iter().map(|z| z * z).sum::<f64>();
    assert!((chi - 192.0).abs() < 4.0 * 19.6, "{chi}");
}

#[test]
fn the_direct_scene_is_its_formula_below_the_lamp() {
    let described = scene("direct");
    let target = Prepared::new(&described).unwrap();
    let request = RenderRequest {
        depth: 2,
        filter: PixelFilter::Point,
        record: Recorded::color_only(),
        ..RenderRequest::new(&target, 1, 1, 16_384)
    };
    let frame = render(&request, &Silent).unwrap();
    let truth = 0.6 / std::f64::consts::PI * panel_irradiance(1.0, 1.5);
    let value = f64::from(frame.color.mean.plane(0)[0]);
    let error = f64::from(frame.color.variance.as_ref().unwrap().mean_variance().plane(0)[0]).sqrt();
    assert!(error < 0.01 * truth && (value - truth).abs() < 4.0 * error, "{value} ± {error}, {truth}");
}

#[test]
fn the_furnace_is_the_geometric_sum_of_its_depth() {
    let furnace = Prepared::new(&scene("furnace")).unwrap();
    for depth in [1, 2, 5] {
        let request = RenderRequest { depth, seed: 3, ..RenderRequest::new(&furnace, 24, 18, 256) };
        let frame = render(&request, &Silent).unwrap();
        let truth = 2.0 * (1.0 - 0.5f64.powi(depth as i32));
        let n = frame.pixels() as f64;
        let mean = frame.color.mean.plane(0).iter().map(|v| f64::from(*v)).sum::<f64>() / n;
        let variance = frame.color.variance.as_ref().unwrap().mean_variance();
        let error = variance.plane(0).iter().map(|v| f64::from(*v)).sum::<f64>().sqrt() / n;
        assert!(error < 0.005 && (mean - truth).abs() < 4.0 * error + 1e-5, "{mean} ± {error}, {truth}");
    }
}

#[test]
fn image_means_are_those_of_the_formulas() {
    for (id, filter, rays) in [
        ("furnace", PixelFilter::Box, Rays::Area),
        ("direct", PixelFilter::Box, Rays::Area),
        ("direct", PixelFilter::Point, Rays::Centres),
        ("gradient", PixelFilter::Box, Rays::Area),
        ("gradient", PixelFilter::Point, Rays::Centres),
    ] {
        let target = Prepared::new(&scene(id)).unwrap();
        for (width, height) in [(16, 12), (12, 14)] {
            let request = RenderRequest {
                seed: 9,
                depth: 4,
                filter,
                record: Recorded::color_only(),
                ..RenderRequest::new(&target, width, height, 1024)
            };
            let frame = render(&request, &Silent).unwrap();
            let pixels = frame.pixels() as f64;
            let mean = frame.color.mean.plane(1).iter().map(|v| f64::from(*v)).sum::<f64>() / pixels;
            let variance = frame.color.variance.as_ref().unwrap().mean_variance();
            let error = variance.plane(1).iter().map(|v| f64::from(*v)).sum::<f64>().sqrt() / pixels;
            let truth = closed_form(id, 4, rays, (width, height)).unwrap();
            // Ten cells, each beyond four standard errors with probability 6e-5.
            assert!(
                error < 0.003 * truth && (mean - truth).abs() < 4.0 * error,
                "{id}: {mean} ± {error}, {truth}"
            );
        }
    }
}

/// 0.6/π times the irradiance of the lamp of `direct`, where a pixel sees the plane.
fn direct_truth() -> Vec<Option<f64>> {
    let inside = |p: &glam::DVec3| p.x.abs() < 4.5 && p.z.abs() < 4.5;
    let value = |p: glam::DVec3| 0.6 / std::f64::consts::PI * panel_irradiance_at(1.0, 1.5, p.x, p.z);
    // Rays that rise meet the plane behind the eye.
    let falls = |pixel: usize| pixel / WIDTH >= HEIGHT / 2;
    let points = points(&scene("direct")).into_iter().enumerate();
    points.map(|(pixel, p)| (falls(pixel) && inside(&p)).then(|| value(p))).collect()
}

/// Slope of log RMS error against log samples, one value per random seed.
fn slopes(id: &str, truth: &[Option<f64>], sampling: Sampling) -> Vec<f64> {
    let prepared = Prepared::new(&scene(id)).unwrap();
    (0..8)
        .map(|seed| {
            let points: Vec<(f64, f64)> = [16u32, 64, 256, 1024]
                .into_iter()
                .map(|spp| {
                    let frame = image(&prepared, spp, seed, sampling);
                    let known =
                        frame.color.mean.plane(1).iter().zip(truth).filter_map(|(v, t)| Some((*v, (*t)?)));
                    let mse = known.map(|(v, t)| (f64::from(v) - t).powi(2)).sum::<f64>();
                    (f64::from(spp).ln(), 0.5 * mse.ln())
                })
                .collect();
            let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / points.len() as f64;
            let (x, y) = (mean(|p| p.0), mean(|p| p.1));
            let across = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>();
            across / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
        })
        .collect()
}

#[test]
fn low_discrepancy_errors_fall_faster_than_independent_ones() {
    let gradient: Vec<Option<f64>> = gradient_truth().into_iter().map(Some).collect();
    let direct = direct_truth();
    assert!(direct.iter().flatten().count() >= WIDTH * HEIGHT / 3);
    for (id, truth) in [("gradient", &gradient), ("direct", &direct)] {
        compare_slopes(id, truth);
    }
}

fn compare_slopes(id: &str, truth: &[Option<f64>]) {
    let told = |sampling| {
        let slopes = slopes(id, truth, sampling);
        let n = slopes.len() as f64;
        let mean = slopes.iter().sum::<f64>() / n;
        let variance = slopes.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (n - 1.0);
        (mean, (variance / n).sqrt())
    };
    // t with 7 degrees of freedom at one side 0.1 %: 4.79.
    let (independent, error) = told(Sampling::Independent);
    println!("{id}: independent {independent:.3} ± {error:.3}");
    assert!((independent + 0.5).abs() < 4.79 * error, "{id}: {independent} ± {error}");
    let (low, error) = told(Sampling::LowDiscrepancy);
    println!("{id}: low-discrepancy {low:.3} ± {error:.3}");
    assert!(low + 4.79 * error < -0.5, "{id}: {low} ± {error} is no faster than n^-½");
}
