//! Planes that are summed along: the double-precision loop, equal bits, limiting cases.

use super::{Case, RULES, Rule};
use crate::same_bits::{levels, on_threads};
use noisefloor_kernels::flash_filter::{Carried, filter_carrying, naive};

/// Rounding of sums of up to 81 terms below 1, relative to the largest value; see the tests against the oracle.
const TOLERANCE: f64 = 1e-6;

#[test]
fn sums_agree_with_the_double_precision_loop_for_every_rule() {
    for rule in RULES {
        for (guided, patch_radius) in [(true, 0), (true, 1), (true, 2), (true, 3), (false, 2)] {
            let mut case = Case::random(67, 21, 4, patch_radius, rule);
            if !guided {
                case.guide = None;
            }
            for variances in [true, false] {
                let carried = case.carried(variances);
                let oracle = naive::filter_carrying_f64(&case.params, &case.inputs(), &carried).unwrap();
                for level in levels() {
                    let result = case.carrying_at(level, variances);
                    let pairs = result.carried.iter().flatten().zip(oracle.carried.iter().flatten());
                    let worst = pairs.map(|(&a, &b)| (f64::from(a) - b).abs()).fold(0.0, f64::max);
                    assert!(worst < TOLERANCE, "{level}, {rule:?}, patch {patch_radius}: off by {worst:e}");
                }
            }
        }
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits_and_the_image_stays_what_it_is() {
    for rule in RULES {
        for guided in [true, false] {
            let mut case = Case::random(83, 37, 3, 2, rule);
            if !guided {
                case.guide = None;
            }
            for variances in [true, false] {
                let portable = case.carrying_at(noisefloor_kernels::InstructionSet::Portable, variances);
                for level in levels() {
                    assert_eq!(case.carrying_at(level, variances), portable, "{level}, {rule:?}");
                    assert_eq!(case.filter_at(level), portable.image, "{level}, {rule:?}");
                }
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let case = Case::random(150, 70, 3, 2, Rule::PerChannel);
    let run = |threads| {
        on_threads(threads, || filter_carrying(&case.params, &case.inputs(), &case.carried(true)).unwrap())
    };
    let one = run(1);
    for threads in [2, 5] {
        assert!(run(threads) == one, "{threads} threads");
    }
}

#[test]
fn a_mean_of_equal_weights_divides_the_variance_by_the_number_of_members() {
    let mut case = Case::random(40, 20, 3, 1, Rule::Joint);
    case.guide = None;
    case.params.spatial_sigma = f32::INFINITY;
    case.carried = [(); 3].map(|()| vec![0.49; 800]);
    let counts =
        noisefloor_kernels::flash_filter::homogeneous_counts(&case.params, &case.inputs(), 0).unwrap();
    let result = case.carrying_at(noisefloor_kernels::InstructionSet::best(), true);
    for (value, count) in result.carried[1].iter().zip(counts) {
        assert!((value * count as f32 / 0.49 - 1.0).abs() < 1e-5, "{value} for {count} members");
    }
}

#[test]
fn a_carried_source_is_the_image() {
    // Σ w·x̄_q / Σ w is x̄_p + Σ w·(x̄_q − x̄_p) / Σ w up to rounding.
    for rule in RULES {
        let mut case = Case::random(70, 20, 5, 2, rule);
        case.carried = case.source.clone();
        let result = case.carrying_at(noisefloor_kernels::InstructionSet::best(), false);
        for (a, b) in result.image.iter().flatten().zip(result.carried.iter().flatten()) {
            assert!((a - b).abs() < 1e-6, "{rule:?}: {a} and {b}");
        }
    }
}

#[test]
fn largest_values_end_as_infinity_and_never_as_no_number() {
    for rule in RULES {
        let mut case = Case::random(70, 20, 5, 2, rule);
        case.carried = [(); 3].map(|()| (0..1400).map(|i| [f32::MAX, 0.0, 1.0][i % 3]).collect());
        for level in levels() {
            let result = case.carrying_at(level, true);
            assert!(result.carried.iter().flatten().all(|v| *v >= 0.0), "{level}, {rule:?}");
        }
    }
}

#[test]
fn planes_out_of_range_are_refused() {
    let case = Case::random(8, 8, 2, 1, Rule::Joint);
    let planes = case.carried.each_ref().map(Vec::as_slice);
    let refusal = |carried: Carried<'_>| {
        let refused = filter_carrying(&case.params, &case.inputs(), &carried).unwrap_err().to_string();
        let twin = naive::filter_carrying_f64(&case.params, &case.inputs(), &carried).unwrap_err();
        assert_eq!(twin.to_string(), refused);
        refused
    };
    let negative = [-1.0; 64];
    let bad = [planes[0], &negative, planes[2]];
    assert_eq!(
        refusal(Carried::Variances(bad)),
        "plane `carried 1` holds -1 at pixel (0, 0): allowed is finite and at least 0"
    );
    assert!(filter_carrying(&case.params, &case.inputs(), &Carried::Values(bad)).is_ok());
    let endless = [f32::INFINITY; 64];
    assert!(refusal(Carried::Values([&endless; 3])).contains("any finite value"));
    assert!(refusal(Carried::Variances([&endless; 3])).contains("finite and at least 0"));
    assert_eq!(
        refusal(Carried::Values([&planes[0][..63], planes[1], planes[2]])),
        "plane `carried 0` holds 63 values, the image has 64 pixels"
    );
}
