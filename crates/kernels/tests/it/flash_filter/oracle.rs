//! The fast form and the single-precision loop against the double-precision loop.
//!
//! The membership test is one `f32` expression in all three, so no neighbour is in one result and not in the other.
//! What remains is rounding. A weight is off by some 5e-7 of itself (patch distance and exponent a few 2^-24 each,
//! 2^x 2e-7), a sum of n ≤ 961 terms by about √n·2^-24 of their size; both only count relative to the differences
//! in the window, which are below 1 here. Errors of single weights have either sign and average out: 1e-6 is above
//! what a wrong rounding can do and far below what a wrong tap or offset would.

use super::{Case, RULES, Rule};
use crate::same_bits::levels;
use noisefloor_kernels::flash_filter::naive;

const TOLERANCE: f64 = 1e-6;

fn worst(result: &[Vec<f32>; 3], oracle: &[Vec<f64>; 3]) -> f64 {
    let pairs = result.iter().flatten().zip(oracle.iter().flatten());
    pairs.map(|(&a, &b)| (f64::from(a) - b).abs()).fold(0.0, f64::max)
}

#[track_caller]
fn agrees(case: &Case) {
    let oracle = case.oracle();
    for level in levels() {
        let worst = worst(&case.filter_at(level), &oracle);

        assert!(worst < TOLERANCE, "{level}, {:?}, {:?}: off by {worst:e}", case.params, case.rule);
    }
}

#[test]
fn agrees_at_sizes_around_vectors_and_tiles() {
    for (width, height) in
        [(1, 1), (1, 9), (9, 1), (2, 2), (15, 5), (16, 17), (17, 16), (63, 15), (64, 16), (65, 17), (67, 33)]
    {
        agrees(&Case::random(width, height, 3, 2, Rule::Joint));
    }
}

#[test]
fn agrees_for_every_rule_and_patch_radius() {
    for rule in RULES {
        for patch_radius in 0..=3 {
            agrees(&Case::random(67, 21, 2, patch_radius, rule));
        }
    }
}

#[test]
fn agrees_without_a_guide() {
    for rule in RULES {
        let mut case = Case::random(66, 19, 4, 2, rule);
        case.guide = None;
        agrees(&case);
    }
}

#[test]
fn agrees_for_the_large_window() {
    for rule in [Rule::Joint, Rule::PerChannel] {
        agrees(&Case::random(65, 19, 15, 2, rule));
    }
}

#[test]
fn agrees_for_windows_larger_than_the_image() {
    for (width, height, radius) in [(5, 3, 32), (1, 1, 32), (1, 40, 20), (70, 1, 32), (33, 18, 31)] {
        agrees(&Case::random(width, height, radius, 3, Rule::Joint));
    }
}

#[test]
fn agrees_at_extreme_scales() {
    // Everything is relative: scaling the image, its half-widths and the guide scales the result.
    for scale in [1e-8f32, 1e8] {
        let mut case = Case::random(33, 18, 3, 2, Rule::Joint);
        let (guide, sigma_r2) = case.guide.as_mut().unwrap();
        for plane in case.source.iter_mut().chain(&mut case.half_width).chain(guide) {
            plane.iter_mut().for_each(|v| *v *= scale);
        }
        sigma_r2.iter_mut().for_each(|v| *v *= scale * scale);
        let oracle = case.oracle();
        for level in levels() {
            let worst = worst(&case.filter_at(level), &oracle);
            assert!(worst < TOLERANCE * f64::from(scale), "{level}, scale {scale}: off by {worst:e}");
        }
    }
}

#[test]
fn the_single_precision_loop_agrees() {
    for rule in RULES {
        let case = Case::random(40, 18, 5, 2, rule);
        let worst = worst(&naive::filter_f32(&case.params, &case.inputs()).unwrap(), &case.oracle());
        assert!(worst < TOLERANCE, "{rule:?}: off by {worst:e}");
    }
}
