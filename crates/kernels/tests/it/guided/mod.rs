//! Tests of the guided filter.

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::guided::{GuidedParams, filter, filter_at, naive};

use crate::random::Random;
use crate::same_bits::{assert_bits_of_every_processor, assert_same_bits};

fn case(width: usize, height: usize, channels: usize, seed: u64) -> (Vec<Vec<f32>>, Vec<Vec<f32>>) {
    let mut random = Random(seed);
    let mut planes = |n: usize| -> Vec<Vec<f32>> {
        (0..n).map(|_| (0..width * height).map(|_| random.uniform()).collect()).collect()
    };
    (planes(channels), planes(2))
}

fn slices(planes: &[Vec<f32>]) -> Vec<&[f32]> {
    planes.iter().map(Vec::as_slice).collect()
}

#[test]
fn the_fast_form_is_the_formula() {
    for (width, height) in [(1, 1), (1, 9), (13, 2), (23, 19), (9, 71)] {
        for radius in [0, 1, 2, 4, 5, 7, 30] {
            for channels in [1, 2, 4] {
                let (guide, targets) = case(width, height, channels, 1 + radius as u64);
                let params = GuidedParams { width, height, radius, epsilon: 1e-2 };
                let (guide, targets) = (slices(&guide), slices(&targets));
                let fast = filter(&params, &guide, &targets).unwrap();
                let slow = naive::filter_f64(&params, &guide, &targets).unwrap();
                for (fast, slow) in fast.iter().flatten().zip(slow.iter().flatten()) {
                    // Results are below 3 and rounded once to 24 bits.
                    assert!(
                        (f64::from(*fast) - slow).abs() < 2e-7,
                        "{width}x{height}, {radius}: {fast}, {slow}"
                    );
                }
            }
        }
    }
}

#[test]
fn without_a_penalty_a_guide_comes_back_and_with_a_large_one_twice_the_box_mean() {
    let (width, height, radius) = (31, 17, 2);
    let (guide, _) = case(width, height, 1, 5);
    let guide = slices(&guide);
    let with = |epsilon| filter(&GuidedParams { width, height, radius, epsilon }, &guide, &guide).unwrap();
    for (out, guide) in with(0.0)[0].iter().zip(guide[0]) {
        assert!((out - guide).abs() < 1e-6);
    }
    let mean = |values: &[f64]| -> Vec<f64> {
        let at = |x: usize, y: usize| {
            let columns = x.saturating_sub(radius)..(x + radius + 1).min(width);
            let rows = y.saturating_sub(radius)..(y + radius + 1).min(height);
            let n = (columns.len() * rows.len()) as f64;
            rows.map(|j| columns.clone().map(|i| values[j * width + i]).sum::<f64>()).sum::<f64>() / n
        };
        (0..width * height).map(|p| at(p % width, p / width)).collect()
    };
    let twice = mean(&mean(&guide[0].iter().copied().map(f64::from).collect::<Vec<_>>()));
    for (out, twice) in with(1e12)[0].iter().zip(twice) {
        assert!((f64::from(*out) - twice).abs() < 1e-6);
    }
}

#[test]
fn a_target_that_is_affine_in_the_guide_comes_back_as_far_as_epsilon_lets_it() {
    let (width, height) = (40, 11);
    let (guide, _) = case(width, height, 3, 8);
    let target: Vec<f32> =
        (0..width * height).map(|p| 0.5 + 2.0 * guide[0][p] - guide[1][p] + 0.25 * guide[2][p]).collect();
    let params = GuidedParams { width, height, radius: 3, epsilon: 1e-9 };
    let out = filter(&params, &slices(&guide), &[&target]).unwrap();
    for (out, target) in out[0].iter().zip(&target) {
        assert!((out - target).abs() < 1e-5, "{out}, {target}");
    }
}

#[test]
fn constants_and_equal_channels_do_no_harm() {
    let (width, height) = (20, 9);
    let (guide, targets) = case(width, height, 1, 9);
    let constant = vec![0.5f32; width * height];
    let params = GuidedParams { width, height, radius: 2, epsilon: 0.0 };
    // A constant target stays constant, also far from 0.
    let bright = vec![1e6f32; width * height];
    assert!(filter(&params, &[&guide[0]], &[&bright]).unwrap()[0].iter().all(|v| *v == 1e6));
    let one = filter(&params, &[&guide[0]], &slices(&targets)).unwrap();
    for others in [vec![&guide[0], &constant], vec![&guide[0], &guide[0]], vec![&constant, &guide[0]]] {
        let others: Vec<&[f32]> = others.into_iter().map(Vec::as_slice).collect();
        let several = filter(&params, &others, &slices(&targets)).unwrap();
        for (a, b) in one.iter().flatten().zip(several.iter().flatten()) {
            assert!((a - b).abs() < 1e-5, "{a}, {b}");
        }
    }
}

#[test]
fn a_bright_pixel_is_forgotten_beyond_its_windows() {
    let (width, height, radius) = (60, 50, 6);
    let (guide, targets) = case(width, height, 1, 10);
    let params = GuidedParams { width, height, radius, epsilon: 1e-3 };
    let before = filter(&params, &[&guide[0]], &[&targets[0]]).unwrap();
    let mut bright = targets[0].clone();
    bright[20 * width + 20] = 1e9;
    let after = filter(&params, &[&guide[0]], &[&bright]).unwrap();
    for p in 0..width * height {
        let (x, y) = (p % width, p / width);
        if x.abs_diff(20).max(y.abs_diff(20)) > 2 * radius {
            // The mean that is taken off is 3e5: that and 53 bits leave 1e-10.
            assert!((before[0][p] - after[0][p]).abs() < 1e-6);
        }
    }
}

fn bits_at(
    params: &GuidedParams,
    guide: &[Vec<f32>],
    targets: &[Vec<f32>],
    level: InstructionSet,
) -> Vec<u32> {
    let out = filter_at(params, &slices(guide), &slices(targets), level).unwrap();
    out.into_iter().flatten().map(f32::to_bits).collect()
}

#[test]
fn every_instruction_set_and_number_of_threads_gives_the_same_bits() {
    for (width, height, radius, channels) in [(83, 70, 2, 1), (40, 150, 9, 3)] {
        let (guide, targets) = case(width, height, channels, 11);
        let params = GuidedParams { width, height, radius, epsilon: 1e-3 };
        // One that this machine lacks runs in plain Rust.
        let run = |level| bits_at(&params, &guide, &targets, level);
        assert_same_bits(&format!("{width}x{height}"), InstructionSet::ALL, run);
    }
}

#[test]
fn bits_are_those_of_every_processor() {
    let (guide, targets) = case(23, 17, 3, 11);
    let params = GuidedParams { width: 23, height: 17, radius: 4, epsilon: 1e-3 };
    assert_bits_of_every_processor(|level| bits_at(&params, &guide, &targets, level), 0x1e72_7683_9ed6_ebc0);
}

#[test]
fn what_is_out_of_range_is_refused() {
    let plane = [0.0f32; 6];
    let good = GuidedParams { width: 3, height: 2, radius: 1, epsilon: 0.0 };
    let refuse = |params: GuidedParams, guide: &[&[f32]]| filter(&params, guide, &[&plane]).unwrap_err();
    for (params, guide, words) in [
        (GuidedParams { width: 0, ..good }, &[plane.as_slice()][..], "image of 0x2 pixels"),
        (GuidedParams { radius: 5000, ..good }, &[&plane], "radius = 5000: allowed 0 to 4096"),
        (GuidedParams { epsilon: -1.0, ..good }, &[&plane], "epsilon = -1"),
        (GuidedParams { epsilon: f64::NAN, ..good }, &[&plane], "epsilon = NaN"),
        (good, &[], "guide channels = 0: allowed 1 to 8"),
        (good, &[&plane[1..]], "`guide channel 0` holds 5 values"),
    ] {
        let told = refuse(params, guide).to_string();
        assert!(told.contains(words), "{told}");
    }
}
