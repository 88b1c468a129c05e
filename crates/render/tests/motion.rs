//! Moving bodies against closed forms.

mod common;

use common::*;
use glam::Vec3;
use noisefloor_frame::{FeatureId, Frame, PixelFilter, Sampling};
use noisefloor_render::{Prepared, Quantity, Recorded, RenderRequest, Silent, render};
use noisefloor_scenes::{Body, CameraMove, Scene, Spin};

const SIZE: usize = 24;

/// An image of 24 × 24 pixels of a view whose half height is 1 at distance 1.
fn image(scene: &Scene, spp: u32, sampling: Sampling) -> Frame {
    let prepared = Prepared::new(scene).unwrap();
    let request = RenderRequest {
        sampling,
        filter: PixelFilter::Point,
        record: Recorded::color_only(),
        seed: 11,
        ..RenderRequest::new(&prepared, SIZE, SIZE, spp)
    };
    render(&request, &Silent).unwrap()
}

/// A black plane of distance 2 before a white sky.
fn silhouette(corners: [Vec3; 3]) -> Scene {
    let mut scene = with_sky(empty(camera(Vec3::ZERO, -Vec3::Z, 90.0)), 1.0);
    let black = add_material(&mut scene, diffuse(0.0), 0.0);
    scene.meshes.push(noisefloor_scenes::Mesh {
        positions: corners.map(|c| c - Vec3::Z * 2.0).to_vec(),
        triangles: vec![[0, 1, 2]],
        material: black,
        ..Default::default()
    });
    scene
}

/// Where the centre of a pixel is on the plane at distance 2.
fn center(pixel: usize) -> [f64; 2] {
    let at = |k: usize| (k as f64 + 0.5) / (SIZE as f64 / 2.0) - 1.0;
    [2.0 * at(pixel % SIZE), -2.0 * at(pixel / SIZE)]
}

/// Every pixel against the share of time in which it sees the sky.
fn assert_uncovered(scene: &Scene, truth: impl Fn([f64; 2]) -> f64) {
    let spp = 4096;
    let frame = image(scene, spp, Sampling::Independent);
    let mut partial = 0;
    for (pixel, value) in frame.color.mean.plane(0).iter().enumerate() {
        let truth = truth(center(pixel));
        // Of a proportion; 576 pixels at 4.5 standard errors are wrong by chance once in 250 tests.
        let error = (truth * (1.0 - truth) / f64::from(spp)).sqrt();
        assert!(
            (f64::from(*value) - truth).abs() <= 4.5 * error + 2e-4,
            "pixel {pixel}: {value}, expected {truth}"
        );
        partial += usize::from(truth > 0.05 && truth < 0.95);
    }
    assert!(partial > 100, "only {partial} pixels see the edge move");
    // Stratified times: no pixel's average is off by more than a few of 1024 in each half.
    let frame = image(scene, 2048, Sampling::LowDiscrepancy);
    for (pixel, value) in frame.color.mean.plane(0).iter().enumerate() {
        let truth = truth(center(pixel));
        assert!(
            (f64::from(*value) - truth).abs() <= 4.0 / 1024.0,
            "pixel {pixel}: {value}, expected {truth}"
        );
    }
}

#[test]
fn a_moving_edge_covers_each_pixel_for_its_share_of_the_time() {
    let mut scene =
        silhouette([Vec3::new(-40.0, -40.0, 0.0), Vec3::new(-1.0, -40.0, 0.0), Vec3::new(-1.0, 900.0, 0.0)]);
    // The vertical edge goes from x = −1 by 3 per frame; the shutter closes after half a frame, at x = 0.5.
    scene.add_body(0.5, Body { meshes: vec![0], translation: Vec3::X * 3.0, spin: None });
    assert_uncovered(&scene, |[x, _]| ((x + 1.0) / 1.5).clamp(0.0, 1.0));
}

#[test]
fn a_turning_wedge_covers_each_pixel_for_its_share_of_the_time() {
    // A wedge of 60° from the axis, on the right at first, that turns by 90° while the shutter is open.
    let (s, c) = (30.0f32.to_radians().sin(), 30.0f32.to_radians().cos());
    let mut scene = silhouette([Vec3::ZERO, Vec3::new(c, -s, 0.0) * 50.0, Vec3::new(c, s, 0.0) * 50.0]);
    let spin = Some(Spin { center: -Vec3::Z * 2.0, axis: Vec3::Z, degrees: 90.0 });
    scene.add_body(1.0, Body { meshes: vec![0], translation: Vec3::ZERO, spin });
    assert_uncovered(&scene, |[x, y]| {
        // Covered while the wedge's middle, at 90° times the time, is within 30° of the pixel.
        let angle = y.atan2(x).to_degrees();
        let (from, to) = (((angle - 30.0) / 90.0).clamp(0.0, 1.0), ((angle + 30.0) / 90.0).clamp(0.0, 1.0));
        1.0 - (to - from)
    });
}

#[test]
fn a_closed_shutter_shows_everything_where_it_starts() {
    let still = cornell();
    let mut moving = still.clone();
    let block: Vec<usize> = (6..12).collect();
    let spin = Some(Spin { center: Vec3::ZERO, axis: Vec3::Y, degrees: 40.0 });
    moving.add_body(0.0, Body { meshes: block, translation: Vec3::X, spin });
    let (still, moving) = (image(&still, 4, Sampling::Independent), image(&moving, 4, Sampling::Independent));
    // The same paths, but for the few that rounding in other hierarchies sends elsewhere at an edge: less than 3 in 100.
    let values = still.color.mean.data().iter().zip(moving.color.mean.data());
    let far = values.filter(|(a, b)| (**a - **b).abs() > 1e-3 * (1.0 + a.abs())).count();
    assert!(far < 3 * SIZE * SIZE * 3 / 100, "{far}");
}

#[test]
fn a_turning_body_in_a_furnace_loses_nothing() {
    let mut scene = with_sky(empty(camera(Vec3::Z * 4.0, Vec3::ZERO, 40.0)), 1.0);
    let white = add_material(&mut scene, diffuse(1.0), 0.0);
    cuboid(&mut scene, -Vec3::splat(0.6), Vec3::splat(0.6), false, white);
    // Axes count as unit vectors up to rounding; the turn must be a rotation all the same, or the cube shadows itself.
    for length in [1.0, 1.0 - 9e-5, 1.0 + 9e-5] {
        let spin = Some(Spin { center: Vec3::ZERO, axis: Vec3::new(0.6, 0.8, 0.0) * length, degrees: 200.0 });
        let body = Body { meshes: (0..6).collect(), translation: Vec3::new(0.5, 0.1, -1.0), spin };
        let mut scene = scene.clone();
        scene.add_body(1.0, body);
        let prepared = Prepared::new(&scene).unwrap();
        let request =
            RenderRequest { record: Recorded::color_only(), ..RenderRequest::new(&prepared, 8, 8, 512) };
        assert_radiance(&render(&request, &Silent).unwrap(), 1.0, 0.01);
    }
}

fn motion(scene: &Scene) -> Frame {
    let prepared = Prepared::new(scene).unwrap();
    let record = Recorded::exactly([Quantity::Motion]);
    let filter = PixelFilter::Point;
    let request = RenderRequest { record, filter, ..RenderRequest::new(&prepared, SIZE, SIZE, 16) };
    render(&request, &Silent).unwrap()
}

#[test]
fn motion_is_where_the_point_goes_on_the_image() {
    // A plane that fills the view, at distance 2: one unit is a quarter of 24 pixels.
    let corners = [Vec3::new(-90.0, -90.0, 0.0), Vec3::new(90.0, -90.0, 0.0), Vec3::new(0.0, 180.0, 0.0)];
    let mut body = silhouette(corners);
    body.add_body(0.7, Body { meshes: vec![0], translation: Vec3::new(0.5, 0.25, 0.0), spin: None });
    let camera = CameraMove { translation: Vec3::new(-0.5, -0.25, 0.0), orbit_degrees: 0.0 };
    let panned = silhouette(corners).with_camera_move(camera);
    for (what, scene) in [("body", body), ("camera", panned)] {
        let frame = motion(&scene);
        let motion = &frame.features[&FeatureId::Motion];
        assert_eq!(motion.mean.channels(), 2);
        for (x, y) in motion.mean.plane(0).iter().zip(motion.mean.plane(1)) {
            // Half a unit to the right is 3 pixels; up is negative.
            assert!((x - 3.0).abs() < 2e-3 && (y + 1.5).abs() < 2e-3, "{what}: {x} {y}");
        }
    }
    // Half a turn about the line of sight, seen at its beginning: every point goes to the opposite side of the middle.
    let mut turning = silhouette(corners);
    let spin = Some(Spin { center: Vec3::ZERO, axis: Vec3::Z, degrees: 180.0 });
    turning.add_body(0.0, Body { meshes: vec![0], translation: Vec3::ZERO, spin });
    let frame = motion(&turning);
    let motion = &frame.features[&FeatureId::Motion];
    for (pixel, (x, y)) in motion.mean.plane(0).iter().zip(motion.mean.plane(1)).enumerate() {
        let [right, up] = center(pixel).map(|c| c * 6.0);
        let far = (f64::from(*x) + 2.0 * right).hypot(f64::from(*y) - 2.0 * up);
        assert!(far < 2e-3, "pixel {pixel}: {x} {y}");
    }
}

#[test]
fn a_scene_that_stands_still_has_no_motion_to_record() {
    let prepared = Prepared::new(&cornell()).unwrap();
    let request = RenderRequest {
        record: Recorded::exactly([Quantity::Motion]),
        ..RenderRequest::new(&prepared, 2, 2, 2)
    };
    assert!(render(&request, &Silent).unwrap_err().to_string().contains("motion"));
    // With an animation of nothing, motion is 0.
    let still = cornell().with_camera_move(CameraMove::default());
    assert!(motion(&still).features[&FeatureId::Motion].mean.data().iter().all(|v| *v == 0.0));
}
