//! Limiting cases.

use noisefloor_conformance::known::{Normals, estimate, exact, frame, step};
use noisefloor_conformance::outputs::largest_difference;
use noisefloor_frame::{FeatureId, Frame, Image};
use noisefloor_robust_first_order::{Params, VarianceKind};

use crate::common::run;

fn settings() -> [Params; 4] {
    let default = Params::default();
    [
        Params { ridge: 0.0, ..default.clone() },
        Params { variance: VarianceKind::Raw, ..default.clone() },
        Params { iterations: 3, ..default.clone() },
        default,
    ]
}

#[test]
fn constants_stay_constant() {
    let flat = Image::filled(45, 38, 3, 3.7);
    let mut plain = exact(&flat);
    let noisy = frame(&step(45, 38), 0.1, 1);
    for params in settings() {
        assert!(largest_difference(&run(&params, &plain).image, &flat) < 1e-6 * 3.7);
    }
    plain.features = noisy.features;
    for params in settings() {
        let output = run(&params, &plain);
        assert!(largest_difference(&output.image, &flat) < 1e-6 * 3.7);
        // Nothing is wrong, and it says so.
        assert!(output.error_estimate.unwrap().data().iter().all(|v| *v < 1e-12));
    }
}

#[test]
fn a_black_image_stays_black() {
    let mut black = exact(&Image::new(40, 33, 3));
    black.features = frame(&step(40, 33), 0.1, 2).features;
    for params in settings() {
        assert!(run(&params, &black).image.data().iter().all(|v| *v == 0.0));
    }
}

#[test]
fn without_noise_the_input_comes_back() {
    // Variances are 0: only equal patches weigh, and models are of pixels that are alike.
    let truth = step(48, 40);
    let mut still = exact(&truth);
    still.features.insert(FeatureId::Albedo, exact(&truth).color);
    for params in settings() {
        assert!(largest_difference(&run(&params, &still).image, &truth) < 1e-5);
    }
}

/// A lamp of radiance 17 on a wall of 0.1, in the middle of one tile, with a little noise.
fn lamp_on_a_wall(seed: u64) -> (Image, Frame) {
    let truth =
        Image::from_fn(
            31,
            31,
            3,
            |_, x, y| {
                if (12..19).contains(&x) && (12..19).contains(&y) { 17.0 } else { 0.1 }
            },
        );
    let mut normals = Normals::new(seed);
    let mut noisy = frame(&truth, 0.0, seed);
    // Noise in proportion to the light.
    let mut half = || truth.map(|v| v * (1.0 + 0.002 * normals.next() as f32));
    let halves = [half(), half()];
    noisy.color.mean = halves[0].zip_map(&halves[1], |a, b| 0.5 * (a + b));
    noisy.color.halves = Some(halves);
    noisy.color.variance =
        Some(noisefloor_frame::Variance::of_mean(truth.map(|v| 0.5 * (0.002 * v) * (0.002 * v))));
    // Features do not see it.
    let flat = estimate(&Image::filled(31, 31, 3, 0.5), 0.01, &mut normals);
    noisy.features.insert(FeatureId::Albedo, flat);
    (truth, noisy)
}

/// The largest relative error.
fn relative(image: &Image, truth: &Image) -> f32 {
    image.data().iter().zip(truth.data()).fold(0.0, |most, (a, b)| most.max((a / b - 1.0).abs()))
}

#[test]
fn a_lamp_and_its_wall_do_not_reach_each_other_unless_all_of_a_window_is_covered() {
    for seed in 1..4 {
        let (truth, noisy) = lamp_on_a_wall(seed);
        let off = relative(&run(&Params::default(), &noisy).image, &truth);
        assert!(off < 0.01, "{off}");
        // As printed, models of the wall predict the lamp, and the other way round.
        let printed = Params { coverage: 0.0, ..Params::default() };
        let off = relative(&run(&printed, &noisy).image, &truth);
        assert!(off > 0.5, "{off}");
    }
}
