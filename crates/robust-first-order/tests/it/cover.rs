//! Every pixel is predicted by a model that looks like it.

use noisefloor_conformance::known::{exact, frame, step};
use noisefloor_conformance::outputs::{diagnostic, figure};
use noisefloor_denoiser::Output;
use noisefloor_frame::{FeatureId, Image};
use noisefloor_robust_first_order::{Params, Tiling};

use crate::common::diagnose;

/// Pixels that no model covers, or one that gives them less than θ.
fn uncovered(output: &Output, theta: f32) -> usize {
    let sums = diagnostic(output, "sum of weights").plane(0);
    let models = diagnostic(output, "models that cover a pixel").plane(0);
    // Each of n models adds θ at least; sums of up to 1000 weights are right to 1e-4.
    let bad = |&p: &usize| models[p] < 1.0 || sums[p] < theta * models[p] * 0.9999;
    (0..sums.len()).filter(bad).count()
}

#[test]
fn weights_sum_to_the_least_weight_at_least_at_every_size() {
    for (width, height) in [(1, 1), (31, 31), (37, 53), (5, 64)] {
        for noisy in [0.05, 0.5].map(|sd| frame(&step(width, height), sd, 31)) {
            for tiling in [Tiling::ThreeByThree, Tiling::Literal, Tiling::AllDetail, Tiling::Dense] {
                for coverage in [0.01, 0.1, 0.5, 1.0] {
                    let params = Params { coverage, tiling, ..Params::default() };
                    assert_eq!(uncovered(&diagnose(&params, &noisy), coverage as f32), 0, "{width}x{height}");
                }
            }
        }
    }
}

#[test]
fn weights_sum_to_the_least_weight_at_least_in_a_large_image() {
    // Without features and noise of its own: few models, so that the size is affordable.
    let mut large = frame(&Image::filled(800, 800, 3, 0.5), 0.01, 32);
    large.features.clear();
    let output = diagnose(&Params::default(), &large);
    assert_eq!(uncovered(&output, 0.1), 0);
    // A model for each of 26×26 tiles at least.
    assert!(figure(&output, "models") >= 676.0);
}

#[test]
fn models_are_as_few_as_the_least_weight_lets_them() {
    let noisy = frame(&step(62, 62), 0.05, 33);
    let count = |coverage| figure(&diagnose(&Params { coverage, ..Params::default() }, &noisy), "models");
    let counts = [0.01, 0.1, 0.3, 1.0].map(count);
    assert!(counts.windows(2).all(|pair| pair[0] <= pair[1]), "{counts:?}");
    // As printed, windows alone cover everything.
    assert!(count(0.0) <= 36.0 && counts[0] >= 4.0);
}

#[test]
fn detail_gets_small_windows() {
    // Squares of 4 pixels in the albedo of the left half, nothing in the right one.
    let mut noisy = frame(&Image::filled(62, 31, 3, 0.5), 0.02, 34);
    let chequered =
        Image::from_fn(62, 31, 3, |_, x, y| if x < 31 && (x / 4 + y / 4) % 2 == 0 { 1.0 } else { 0.0 });
    noisy.features.insert(FeatureId::Albedo, exact(&chequered).color);
    let output = diagnose(&Params::default(), &noisy);
    let tiles = diagnostic(&output, "detailed tiles");
    assert_eq!([tiles.get(0, 5, 5), tiles.get(0, 40, 5)], [1.0, 0.0]);
    assert_eq!(figure(&output, "share of detailed tiles"), 0.5);
    let radius = diagnostic(&output, "radius of the heaviest model");
    assert_eq!([radius.get(0, 15, 15), radius.get(0, 46, 15)], [5.0, 15.0]);
}
