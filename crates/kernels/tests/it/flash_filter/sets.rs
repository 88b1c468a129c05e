//! The membership test and the views of the sets.

use super::{Case, RULES, Rule};
use crate::random::Random;
use noisefloor_kernels::flash_filter::{
    FlashFilterError, half_width, homogeneous_counts, homogeneous_window,
};

#[test]
fn the_half_width_is_the_symmetric_test_up_to_rounding() {
    let mut random = Random(3);
    let eps = f64::from(f32::EPSILON);
    for _ in 0..200_000 {
        let p = random.uniform() * 10f32.powi((random.uniform() * 12.0) as i32 - 6);
        let tolerance = if random.uniform() < 0.3 { 0.0 } else { p * random.uniform() * 1e-5 };
        // A neighbour close to the edge of the interval, on either side.
        let q = p + (random.uniform() * 4.0 - 2.0) * (tolerance + p * 6e-7);
        let distance = f64::from((q - p).abs());
        let threshold = f64::from(tolerance) + 4.0 * eps * f64::from(p.abs().max(q.abs()));
        let passes = (q - p).abs() <= half_width(tolerance, p);
        // The subtraction q - p is exact for such close values, so only the threshold is rounded.
        if distance <= threshold * (1.0 - 4.0 * eps) {
            assert!(passes, "p {p} q {q} tolerance {tolerance} must pass");
        }
        if distance > threshold * (1.0 + 8.0 * eps) {
            assert!(!passes, "p {p} q {q} tolerance {tolerance} must not pass");
        }
    }
}

#[test]
fn the_half_width_of_nothing_is_nothing_and_of_infinity_everything() {
    assert_eq!(half_width(0.0, 0.0), 0.0);
    assert!(half_width(f32::INFINITY, 1.0) > 2e30);
    assert!(half_width(0.0, 1.0) > 4.0 * f32::EPSILON && half_width(0.0, 1.0) < 4.01 * f32::EPSILON);
}

#[test]
fn counts_and_windows_tell_the_same_story() {
    for rule in RULES {
        let case = Case::random(21, 13, 4, 2, rule);
        for channel in 0..3 {
            let counts = homogeneous_counts(&case.params, &case.inputs(), channel).unwrap();
            for (x, y) in [(0, 0), (20, 12), (10, 6), (3, 11)] {
                let window = homogeneous_window(&case.params, &case.inputs(), x, y).unwrap();
                let members = window.member[channel].iter().filter(|&&m| m).count();
                assert_eq!(counts[y * 21 + x] as usize, members, "{rule:?} channel {channel} ({x}, {y})");
            }
        }
    }
}

#[test]
fn a_window_and_its_weights_reproduce_the_filtered_pixel() {
    for rule in RULES {
        let case = Case::random(21, 13, 4, 2, rule);
        let result = case.filter();
        for (x, y) in [(0usize, 0usize), (20, 12), (10, 6), (3, 11)] {
            let window = homogeneous_window(&case.params, &case.inputs(), x, y).unwrap();
            assert_eq!(window.side, 9);
            for (c, plane) in result.iter().enumerate() {
                assert_eq!((window.member[c][40], window.weight[c][40]), (true, 1.0));
                let (mut sum, mut total) = (0.0, 0.0);
                for (cell, &weight) in window.weight[c].iter().enumerate() {
                    assert!((0.0..=1.0).contains(&weight) && (weight == 0.0 || window.member[c][cell]));
                    if weight > 0.0 {
                        let (qx, qy) = (x + cell % 9 - 4, y + cell / 9 - 4);
                        sum += f64::from(weight) * f64::from(case.source[c][qy * 21 + qx]);
                        total += f64::from(weight);
                    }
                }
                let error = (f64::from(plane[y * 21 + x]) - sum / total).abs();
                assert!(error < 2e-6, "{rule:?} channel {c} ({x}, {y}): off by {error:e}");
            }
        }
    }
}

#[test]
fn infinite_tolerance_counts_the_clipped_window() {
    let mut case = Case::random(21, 13, 4, 2, Rule::Joint);
    case.half_width = [(); 3].map(|()| vec![f32::INFINITY; 21 * 13]);
    let counts = homogeneous_counts(&case.params, &case.inputs(), 0).unwrap();
    assert_eq!((counts[0], counts[6 * 21 + 10], counts[6 * 21]), (25, 81, 45));
}

#[test]
fn pixels_and_channels_that_do_not_exist_are_refused() {
    let case = Case::random(8, 6, 2, 1, Rule::Joint);
    assert_eq!(
        homogeneous_window(&case.params, &case.inputs(), 8, 0),
        Err(FlashFilterError::PixelOutside { x: 8, y: 0, width: 8, height: 6 })
    );
    assert_eq!(
        homogeneous_counts(&case.params, &case.inputs(), 3),
        Err(FlashFilterError::Channel { channel: 3 })
    );
}
