use noisefloor_conformance::change::{exposed, set_variance};
use noisefloor_conformance::known::{Normals, estimate, exact, frame};
use noisefloor_conformance::outputs::{self, largest_difference, light, squared_error};
use noisefloor_conformance::{Tolerance, assert_conforms};
use noisefloor_denoiser::{Output, StageTimer};
use noisefloor_frame::{Estimate, Frame, Image, Variance};
use noisefloor_kernels::regression::dense::{Channel, Fit, Join, Planes, Solver, Weighting, naive};

use super::candidates::{self, Color, filter_maps};
use super::features::{Noisy, prefilter};
use super::kernel::{Guided, Sizes, regress};
use super::params::{Exposure, Params, Profile};
use super::settings::Settings;
use super::{Nfor, algorithm};

/// A texture on a ramp, and a step.
fn truth(width: usize, height: usize) -> Image {
    Image::from_fn(width, height, 3, |c, x, y| {
        let side = if 2 * x < width { 0.3 } else { 0.8 };
        side + 0.1 * ((x / 3 + y / 3 + c) % 2) as f32 + 0.2 * y as f32 / height as f32
    })
}

fn run(params: Params, frame: &Frame) -> Output {
    outputs::run(&Nfor::new(params).unwrap(), frame)
}

fn of(profile: Profile) -> Params {
    Params { profile, ..Params::default() }
}

const PROFILES: [Profile; 3] = [Profile::Program, Profile::Paper, Profile::Best];

#[test]
fn it_conforms() {
    for profile in PROFILES {
        assert_conforms(&Nfor::new(of(profile)).unwrap());
    }
}

#[test]
fn a_constant_stays_in_every_profile() {
    for profile in PROFILES {
        let mut frame = frame(&Image::filled(23, 19, 3, 0.3), 0.0, 1);
        set_variance(&mut frame.color, |_| 0.01);
        let out = run(of(profile), &frame).image;
        assert!(largest_difference(&out, &frame.color.mean) < 1e-6, "{profile:?}");
    }
}

#[test]
fn clean_colours_that_are_far_apart_stay() {
    // Every pixel more than 0.1 from every other in each channel: 25 columns times 20 rows of steps of 0.11.
    let image = Image::from_fn(25, 20, 3, |c, x, y| {
        let order = (x + 25 * y) * [1, 7, 11][c] % 500;
        0.11 * order as f32
    });
    let frame = Frame { color: exact(&image).color, ..frame(&truth(25, 20), 0.1, 2) };
    // Δ² is cut at 1e4: of 49 taps each, weights e^-1e4.
    assert!(largest_difference(&run(Params::default(), &frame).image, &image) <= 1e-5);
}

#[test]
fn without_features_planes_come_out_as_they_are() {
    let plane = Image::from_fn(31, 24, 3, |c, x, y| 0.2 + 0.02 * x as f32 - 0.01 * (c as f32) * y as f32);
    let mut frame = exact(&plane);
    set_variance(&mut frame.color, |_| 0.05);
    for profile in [Profile::Program, Profile::Best] {
        let far = largest_difference(&run(of(profile), &frame).image, &plane);
        assert!(far < 2e-6, "{profile:?}: {far}");
    }
}

#[test]
fn the_error_estimate_of_a_fixed_filter_is_right_on_average() {
    // Weights from the truth, so that they have nothing to do with the noise.
    let truth = truth(16, 16);
    let (sd, flat) = (0.1f32, Image::filled(16, 16, 3, 0.01));
    let settings = Settings::of(&Params::default());
    let sizes = Sizes { patch: 1, window: 3, k: 1.0, scale: 2.0, epsilon: 1e-7 };
    let mut normals = Normals::new(3);
    let differences: Vec<f64> = (0..1000)
        .map(|_| {
            let Estimate { mean, halves, .. } = estimate(&truth, sd, &mut normals);
            let halves = halves.unwrap();
            let guide = Guided { image: &truth, variance: &flat };
            let filtered = halves.each_ref().map(|half| regress(half, guide, &[], &sizes, &settings).unwrap());
            let color = Color { mean: &mean, halves: &halves, variance: &flat, epsilon: 1e-7 };
            let estimated = candidates::squared_error(&color, &filtered);
            let output = super::half::mean(&filtered[0], &filtered[1]);
            light(&estimated) / estimated.data().len() as f64 - squared_error(&output, &truth)
        })
        .collect();
    let tolerance = Tolerance::of_mean(0.0, &differences).with_z(3.0);
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    tolerance.near(mean).unwrap();
    // The noise that is taken off twice is far beyond that: twice or half of it would show.
    assert!(tolerance.standard_error < f64::from(sd * sd) / 100.0);
}

#[test]
fn halves_that_change_places_give_the_same_bits() {
    for profile in PROFILES {
        let straight = frame(&truth(29, 21), 0.1, 4);
        let mut swapped = straight.clone();
        let swap = |estimate: &mut Estimate| estimate.halves.as_mut().unwrap().swap(0, 1);
        swap(&mut swapped.color);
        swapped.features.values_mut().for_each(swap);
        let (a, b) = (run(of(profile), &straight), run(of(profile), &swapped));
        assert_eq!((a.image, a.error_estimate), (b.image, b.error_estimate), "{profile:?}");
    }
}

#[test]
fn the_filtered_choice_is_a_share() {
    let frame = frame(&truth(40, 30), 0.2, 5);
    let (halves, variance) = (frame.color.halves.as_ref().unwrap(), frame.color.variance.as_ref().unwrap());
    let color =
        Color { mean: &frame.color.mean, halves, variance: variance.mean_variance(), epsilon: 1e-7 };
    let choice = Image::from_fn(40, 30, 3, |c, x, y| f32::from((x * 7 + y * 3 + c) % 5 < 2));
    let [share] = filter_maps(&color, [&choice], &Params::default()).unwrap();
    assert!(share.data().iter().all(|t| (0.0..=1.0 + 1e-6).contains(t)));
    assert!(share.data().iter().any(|t| (0.2..0.8).contains(t)));
}

#[test]
fn the_last_regression_doubles_variances_and_equals_the_loops() {
    let frame = frame(&truth(24, 17), 0.15, 6);
    let params = Params { window_radius_px: 4, patch_radius_px: 2, ..Params::default() };
    let settings = Settings::of(&params);
    let variance = frame.color.variance.as_ref().unwrap().mean_variance();
    let halves = frame.color.halves.as_ref().unwrap();
    let color = Color { mean: &frame.color.mean, halves, variance, epsilon: 1e-7 };
    let done = algorithm::denoise(&frame, &color, &params, &settings, &mut StageTimer::start()).unwrap();
    let [a, b] = &done.selection.halves;
    let doubled = a.zip_map(b, |a, b| 2.0 * ((b - a) / 2.0).powi(2));
    let oracle = |scale: f32| {
        let weighting =
            Weighting { width: 24, height: 17, window: 4, patch: 2, k: 1.0, scale, epsilon: 1e-7 };
        let fit = Fit { weighting, join: Join::Minimum, solver: Solver::Dropped, positions: true };
        let guide = done.selected.planes().zip(doubled.planes());
        let planes = Planes {
            guide: guide.map(|(value, variance)| Channel { value, variance }).collect(),
            features: done.features.iter().flat_map(Image::planes).collect(),
            image: [0, 1, 2].map(|c| done.selected.plane(c)),
        };
        let out = naive::regress(&fit, &planes).unwrap().concat();
        Image::from_vec(24, 17, 3, out.into_iter().map(|v| v as f32).collect()).unwrap()
    };
    let far = largest_difference(&done.image, &oracle(1.0));
    assert!(far < 1e-5, "{far}");
    // With the variances as they are it is another image.
    assert!(largest_difference(&done.image, &oracle(0.5)) > 1e-3);
}

#[test]
fn a_feature_of_unknown_variance_is_left_as_it_is_in_the_patch_around_it() {
    let mut normals = Normals::new(7);
    let clean = Image::from_fn(24, 20, 1, |_, x, _| 0.1 * (x / 6) as f32);
    let noisy = estimate(&clean, 0.05, &mut normals);
    let mut variance = noisy.variance.unwrap().into_mean_variance();
    variance.set(0, 11, 9, f32::NAN);
    let halves = noisy.halves.unwrap();
    let params = Params::default();
    let filtered =
        prefilter(&Noisy { halves: halves.clone(), variance: Some(variance) }, &params, &Settings::of(&params))
            .unwrap();
    let mut moved = [0; 2];
    for y in 0..20usize {
        for x in 0..24usize {
            let distance = x.abs_diff(11).max(y.abs_diff(9));
            for (i, (filtered, half)) in filtered.iter().zip(&halves).enumerate() {
                let difference = (filtered.get(0, x, y) - half.get(0, x, y)).abs();
                // Its own weight alone, once as a factor and once as a divisor.
                assert!(distance > 3 || difference < 1e-7, "{x}, {y}: {difference}");
                moved[i] += usize::from(distance == 4 && difference > 1e-3);
            }
        }
    }
    // Most of the 32 pixels beside them.
    assert!(moved.iter().all(|count| *count > 16), "{moved:?}");
}

#[test]
fn a_frame_with_a_variance_that_is_no_number_is_filtered() {
    let mut frame = frame(&truth(24, 20), 0.1, 8);
    let mut spoilt = frame.color.variance.take().unwrap().into_mean_variance();
    spoilt.set(1, 12, 10, f32::NAN);
    frame.color.variance = Some(Variance::of_mean(spoilt));
    let out = run(Params::default(), &frame).image;
    assert!(out.data().iter().all(|v| v.is_finite()));
    // Scaled variances come from boxes of 21×21 pixels; one that is unknown spoils none of its neighbours.
    frame.sampling = noisefloor_frame::Sampling::LowDiscrepancy;
    let spoilt = run(of(Profile::Best), &frame).image;
    let moved = |x: usize, y: usize| (spoilt.get(1, x, y) - frame.color.mean.get(1, x, y)).abs() > 1e-3;
    let far: Vec<bool> = (0..20).flat_map(|y| (0..6).map(move |x| (x, y))).map(|(x, y)| moved(x, y)).collect();
    assert!(far.iter().filter(|moved| **moved).count() > 100, "noise is taken out far from it");
}

#[test]
fn it_removes_noise_keeps_the_light_and_knows_its_error() {
    let truth = truth(64, 48);
    let frame = frame(&truth, 0.2, 9);
    for profile in PROFILES {
        let out = run(of(profile), &frame);
        let (before, after) = (squared_error(&frame.color.mean, &truth), squared_error(&out.image, &truth));
        assert!(after < 0.1 * before, "{profile:?}: {after} of {before}");
        assert!((light(&out.image) / light(&frame.color.mean) - 1.0).abs() < 2e-3, "{profile:?}");
        let (name, image) = out.estimate_of.unwrap();
        assert_eq!(name, "before the last regression");
        let values = image.data().len() as f64;
        let (estimated, actual) =
            (light(&out.error_estimate.unwrap()), values * squared_error(&image, &truth));
        // Each of the 9216 values is off by about 2V = 0.08, in all 7.7: four times that.
        assert!((estimated - actual).abs() < 31.0, "{profile:?}: {estimated} of {actual}");
    }
}

#[test]
fn a_common_exposure_makes_results_follow_it() {
    let bright = frame(&truth(33, 20), 0.1, 10);
    let dark = exposed(&bright, 1.0 / 1024.0);
    let params = Params { exposure: Some(Exposure::Common), ..Params::default() };
    let [a, b] = [&bright, &dark].map(|frame| run(params.clone(), frame).image);
    assert_eq!(a.map(|v| v / 1024.0), b);
    // Else ε, beside variances of 1e-8, keeps noise apart.
    let [a, b] = [&bright, &dark].map(|frame| run(Params::default(), frame).image);
    assert!(largest_difference(&a, &b.map(|v| v * 1024.0)) > 1e-3);
}

#[test]
fn diagnostics_show_the_choice_and_the_features() {
    let frame = frame(&truth(20, 20), 0.1, 11);
    let out = outputs::diagnose(&Nfor::default(), &frame);
    let names: Vec<&str> = out.diagnostics.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(names[0], "share of the wider candidate");
    assert_eq!(names.len(), 6);
}
