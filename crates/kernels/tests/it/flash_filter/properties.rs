//! What the method promises for any input.

use super::{Case, RULES, Rule};
use crate::random::Random;
use crate::same_bits::levels;

#[test]
fn constant_source_is_unchanged() {
    for rule in RULES {
        let mut case = Case::random(70, 20, 5, 2, rule);
        case.source = [0.1, 7.0, 1e6].map(|v| vec![v; 70 * 20]);
        assert_eq!(case.filter(), case.source, "{rule:?}");
    }
}

#[test]
fn zero_tolerance_leaves_distinct_means_alone() {
    for rule in [Rule::Joint, Rule::PerChannel] {
        let mut case = Case::random(70, 20, 5, 2, rule);
        // Distinct by far more than the rounding allowance.
        for (c, plane) in case.source.iter_mut().enumerate() {
            for (i, v) in plane.iter_mut().enumerate() {
                *v = 1.0 + (c + i) as f32 / 4096.0;
            }
        }
        case.half_width = [(); 3].map(|()| vec![0.0; 70 * 20]);
        assert_eq!(case.filter(), case.source, "{rule:?}");
    }
}

#[test]
fn zero_tolerance_averages_what_differs_by_rounding_only() {
    // Two values one unit in the last place apart, everywhere: all are members, and nothing moves further than that.
    let (low, high) = (0.7f32, 0.7f32.next_up());
    let mut case = Case::random(40, 20, 3, 1, Rule::Joint);
    case.half_width = [(); 3].map(|()| vec![0.0; 800]);
    case.source = [(); 3].map(|()| (0..800).map(|i| if i % 3 == 0 { low } else { high }).collect());
    let counts =
        noisefloor_kernels::flash_filter::homogeneous_counts(&case.params, &case.inputs(), 0).unwrap();
    assert_eq!(counts[10 * 40 + 20], 49);
    assert!(case.filter().iter().flatten().all(|v| (low..=high).contains(v)));
}

/// Random images with heavy tails: exponential means, half-widths from none to everything, fireflies of 10^6.
fn wild(rule: Rule, round: u64) -> Case {
    let mut random = Random(round);
    let mut case = Case::random(75, 35, 3 + 4 * round as usize, 2, rule);
    let n = 75 * 35;
    case.source = random.planes(n, |random| {
        let value = -(1.0 - random.uniform()).ln();
        if random.uniform() < 0.01 { 1e6 * value } else { value }
    });
    case.half_width = random.planes(n, |random| match random.uniform() {
        u if u < 0.1 => 0.0,
        u if u < 0.15 => f32::INFINITY,
        u if u < 0.2 => 1e6 * random.uniform(),
        _ => 0.5 * random.uniform(),
    });
    case
}

#[test]
fn result_stays_within_the_half_width_in_every_tested_channel() {
    for rule in [Rule::Joint, Rule::PerChannel] {
        for round in 0..3 {
            let case = wild(rule, round);
            for level in levels() {
                for (c, plane) in case.filter_at(level).iter().enumerate() {
                    for (i, &d) in plane.iter().enumerate() {
                        let (x, bound) = (f64::from(case.source[c][i]), f64::from(case.half_width[c][i]));
                        let allowed = bound * (1.0 + 1e-6) + 8.0 * f64::from(f32::EPSILON) * x.abs();
                        let moved = (f64::from(d) - x).abs();
                        assert!(
                            moved <= allowed,
                            "{level} {rule:?} channel {c} pixel {i}: {moved} > {allowed}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn luminance_stays_within_its_half_width() {
    for round in 0..3 {
        let case = wild(Rule::Luminance, round);
        let result = case.filter();
        let luminance = |planes: &[Vec<f32>; 3], i: usize| {
            let [r, g, b] = planes.each_ref().map(|plane| f64::from(plane[i]));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for i in 0..75 * 35 {
            let moved = (luminance(&result, i) - luminance(&case.source, i)).abs();
            // Luminance of rounded means: rounding counts relative to the largest channel that was mixed in.
            let scale = luminance(&case.source, i) + f64::from(case.half_width[0][i]);
            let allowed = f64::from(case.half_width[0][i]) + 1e-5 * scale;
            assert!(moved <= allowed, "pixel {i}: {moved} > {allowed}");
        }
    }
}

#[test]
fn infinite_tolerance_without_guide_is_a_clipped_gaussian_blur() {
    let (w, h, r, sigma) = (70, 23, 6, 2.5f64);
    for rule in [Rule::Joint, Rule::PerChannel, Rule::Luminance] {
        let mut case = Case::random(w, h, r, 2, rule);
        case.params.spatial_sigma = sigma as f32;
        case.guide = None;
        case.half_width = [(); 3].map(|()| vec![f32::INFINITY; w * h]);
        let result = case.filter();
        // A Gaussian is separable, also when clipped and normalised: rows, then columns.
        let blur = |values: &[f64], i: usize| -> f64 {
            let (mut sum, mut total) = (0.0, 0.0);
            for (j, value) in values.iter().enumerate().filter(|(j, _)| j.abs_diff(i) <= r) {
                let weight = (-(j.abs_diff(i) as f64 / sigma).powi(2) / 2.0).exp();
                sum += weight * value;
                total += weight;
            }
            sum / total
        };
        for (source, result) in case.source.iter().zip(&result) {
            let source: Vec<f64> = source.iter().map(|&v| f64::from(v)).collect();
            let rows: Vec<f64> = (0..w * h).map(|p| blur(&source[p / w * w..][..w], p % w)).collect();
            for p in 0..w * h {
                let column: Vec<f64> = rows[p % w..].iter().step_by(w).copied().collect();
                let error = (f64::from(result[p]) - blur(&column, p / w)).abs();
                assert!(error < 1e-6, "{rule:?} pixel {p}: off by {error:e}");
            }
        }
    }
}

#[test]
fn a_constant_guide_changes_nothing() {
    let mut case = Case::random(70, 20, 5, 2, Rule::Joint);
    let (planes, _) = case.guide.as_mut().unwrap();
    *planes = [(); 3].map(|()| vec![0.3; 1400]);
    let guided = case.filter();
    case.guide = None;
    let plain = case.filter();
    for (a, b) in guided.iter().flatten().zip(plain.iter().flatten()) {
        // The spatial weight comes from the polynomial in one, from the library in the other.
        assert!((a - b).abs() < 2e-6, "{a} {b}");
    }
}

#[test]
fn a_noise_free_guide_admits_equal_patches_only() {
    // σ_r at its floor: the weight is 1 where the patches are equal and 0 where they are not.
    let (w, h) = (64, 20);
    let mut case = Case::random(w, h, 4, 1, Rule::Off);
    let step: Vec<f32> = (0..w * h).map(|i| if i % w < 30 { 0.2 } else { 0.8 }).collect();
    case.guide = Some(([step.clone(), step.clone(), step], vec![f32::MIN_POSITIVE; w * h]));
    case.params.spatial_sigma = f32::INFINITY;
    case.source[0] = (0..w * h).map(|i| if i % w < 29 { 0.0 } else { 1.0 }).collect();
    let result = case.filter();
    for (i, &v) in result[0].iter().enumerate() {
        // Columns 29 and 30 have the edge in their patch and match only themselves.
        let expected = if i % w < 29 { 0.0 } else { 1.0 };
        assert_eq!(v, expected, "column {}", i % w);
    }
}

#[test]
fn no_pixel_crosses_a_step_of_20_standard_errors() {
    let (w, h) = (80, 24);
    let mut random = Random(7);
    let mut case = Case::random(w, h, 15, 2, Rule::Joint);
    let mean = |i: usize| if i % w < 37 { 1.0 } else { 21.0 };
    for plane in &mut case.source {
        for (i, v) in plane.iter_mut().enumerate() {
            *v = mean(i) + random.normal();
        }
    }
    // The 99 % quantile of Student's t at 15 degrees of freedom, for standard errors of 1.
    case.half_width = [(); 3].map(|()| vec![2.9467; w * h]);
    case.guide = None;
    let result = case.filter();
    let mut squares = [0.0f64; 2];
    for (before, after) in case.source.iter().zip(&result) {
        for (i, (before, after)) in before.iter().zip(after).enumerate() {
            assert!((after - mean(i)).abs() < 10.0, "pixel {i} crossed to {after}");
            squares[0] += f64::from(before - mean(i)).powi(2);
            squares[1] += f64::from(after - mean(i)).powi(2);
        }
    }
    assert!(squares[1] < 0.25 * squares[0], "noise went down by {} only", squares[0] / squares[1]);
}

#[test]
fn a_joint_set_keeps_channels_together_where_separate_sets_do_not() {
    // Left and right differ in blue alone, and red is noisy. One set for all channels keeps the sides apart in red
    // too; a set per channel mixes red across the edge.
    let (w, h) = (40, 12);
    let mut case = Case::random(w, h, 5, 1, Rule::Joint);
    case.guide = None;
    case.source = [(); 3].map(|()| vec![0.5; w * h]);
    for i in 0..w * h {
        case.source[0][i] = if i % w < 20 { 0.4 } else { 0.6 };
        case.source[2][i] = if i % w < 20 { 0.0 } else { 1.0 };
    }
    case.half_width = [(); 3].map(|()| vec![0.3; w * h]);
    let joint = case.filter();
    assert_eq!(joint, case.source);
    case.rule = Rule::PerChannel;
    let separate = case.filter();
    assert_eq!(separate[2], case.source[2]);
    assert!(separate[0][5 * w + 19] > 0.45, "red stayed at {}", separate[0][5 * w + 19]);
}
