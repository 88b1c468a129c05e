//! The fast form against the f64 twin.

use super::*;

/// Filtered values of order 1, weight sums and shares. A weight of exponent −x has a relative error of about 2x·2⁻²⁴
/// from the division and the sums in single precision, and what weighs anything has x below 16.
const TOLERANCE: f64 = 4e-6;
/// Finite differences lose the two digits of δ = 1 %.
const DERIVATIVE: f64 = 2.5e-4;

#[track_caller]
pub(super) fn agrees(case: &Case) {
    let worst = deviations(&case.fast(), &case.oracle());
    let limits = [TOLERANCE, TOLERANCE, TOLERANCE, DERIVATIVE];
    let size = (case.params.width, case.params.height, case.params.window_radius);
    assert!(worst.iter().zip(limits).all(|(w, l)| *w < l), "{size:?}: off by {worst:?}");
}

#[test]
fn every_size_and_border_agrees() {
    for (width, height, radius) in [
        (1, 1, 10),
        (1, 9, 2),
        (9, 1, 3),
        (2, 2, 1),
        (15, 17, 5),
        (16, 16, 3),
        (17, 15, 4),
        (65, 18, 2),
        (67, 45, 3),
    ] {
        agrees(&Case::random(width, height, radius, &candidates(true), &[3, 1]).with_step(Rule::Exact));
    }
}

#[test]
fn every_window_radius_of_the_method_agrees() {
    for radius in [0, 1, 5, 7, 10, 20] {
        agrees(&Case::random(23, 12, radius, &candidates(false), &[1]));
    }
}

#[test]
fn every_combination_of_patches_agrees() {
    let patches = [None, Some(0), Some(1), Some(2), Some(3)];
    for a in patches {
        for b in patches {
            let both = [(a, 1e-2), (b, 1e-4)].map(|(patch, floor)| pass(patch, floor));
            agrees(&Case::random(21, 11, 4, &both, &[2]));
        }
    }
}

#[test]
fn more_patches_and_floors_than_one_sweep_serves_agree() {
    let all = [(Some(1), 1e-1), (Some(2), 1e-2), (Some(3), 1e-3), (None, 1e-4)];
    agrees(&Case::random(20, 10, 3, &all.map(|(patch, floor)| pass(patch, floor)), &[1, 2]));
}

#[test]
fn guides_of_any_number_of_channels_agree() {
    for channels in 1..=4 {
        let mut case = Case::random(19, 9, 3, &[pass(Some(2), 1.0)], &[]);
        case.frame = Owned::random(&mut Random(3), 19 * 9, channels, &[], 1);
        agrees(&case);
    }
}

#[test]
fn no_features_and_many_features_agree() {
    for features in [&[][..], &[3, 1, 3, 1, 2][..]] {
        agrees(&Case::random(33, 9, 5, &candidates(true), features).with_step(Rule::Exact));
    }
}

#[test]
fn the_other_choices_agree() {
    for (denominator, center, cancellation, rule) in [
        (Denominator::Pair, Center::One, 1.0, Rule::Exact),
        (Denominator::Center, Center::LargestNeighbor { least: 1e-3 }, 1.0, Rule::Exact),
        (Denominator::Pair, Center::LargestNeighbor { least: 1e-3 }, 0.5, Rule::Joint),
        (Denominator::Center, Center::One, 4.0, Rule::Joint),
    ] {
        let mut case = Case::random(22, 13, 5, &candidates(true), &[3, 1]).with_step(rule);
        case.params = NlmParams { denominator, center, cancellation, k: 1.0, ..case.params };
        agrees(&case);
    }
}

#[test]
fn the_other_guide_denominator_and_other_epsilons_agree() {
    for rule in [Rule::Exact, Rule::Joint] {
        for epsilon in [1e-20, 1e-10, 1e-2] {
            let mut case = Case::random(22, 13, 5, &candidates(true), &[3, 1]).with_step(rule);
            case.params.guide_denominator = GuideDenominator::TwiceCenter;
            case.params.epsilon = epsilon;
            agrees(&case);
            let twice = case.fast();
            case.params.guide_denominator = GuideDenominator::Pair;
            agrees(&case);
            assert_ne!(twice, case.fast(), "the denominator has a say");
        }
    }
}

#[test]
fn neighbouring_frames_agree() {
    for rule in [Rule::Exact, Rule::Joint] {
        agrees(&Case::random(20, 11, 3, &candidates(true), &[2]).with_neighbors(2).with_step(rule));
    }
    let mut case = Case::random(20, 11, 3, &candidates(true), &[2]).with_neighbors(1).with_step(Rule::Exact);
    case.params.denominator = Denominator::Pair;
    agrees(&case);
}

#[test]
fn the_single_precision_twin_agrees_too() {
    let case = Case::random(18, 9, 3, &candidates(true), &[3, 1]).with_step(Rule::Exact);
    let naive = naive::filter_f32(&case.params, &case.passes, &case.inputs()).unwrap();
    let worst = deviations(&naive, &case.oracle());
    assert!(worst[0] < TOLERANCE && worst[1] < TOLERANCE && worst[2] < TOLERANCE, "{worst:?}");
}

#[test]
fn the_derivative_is_that_of_running_the_filter_again() {
    // Moves one value of the guide and filters everything again, twin and fast form alike.
    let (w, h, f) = (21, 15, 1);
    let passes = [Pass { patch: Some(f), floor: 1.0, derivative: true }];
    let case = Case::random(w, h, 3, &passes, &[1]).with_step(Rule::Exact);
    agrees_with_running_again(&case, [(4, 4), (10, 7), (16, 10)]);
}

/// Moves one value of the guide at each place and filters everything again: the twin tells the derivative of that.
pub(super) fn agrees_with_running_again(case: &Case, places: [(usize, usize); 3]) {
    let told = &case.oracle()[0].derivative;
    for (x, y) in places {
        let p = y * case.params.width + x;
        for (c, told) in told.iter().enumerate() {
            let step = case.step.as_ref().unwrap().0[c][p];
            if step == 0.0 {
                continue;
            }
            let run = |moved: bool| {
                let mut again = case.clone();
                again.frame.guide[c][0][p] += if moved { step } else { 0.0 };
                again.frame.targets = vec![again.frame.guide[c][0].clone()];
                again.step = None;
                again.passes[0].derivative = false;
                (again.oracle()[0].planes[0][p], f64::from(again.frame.guide[c][0][p]))
            };
            let ((before, from), (after, to)) = (run(false), run(true));
            let truth = (after - before) / (to - from);
            // The moved value is rounded to f32, the twin's is not: the steps differ by 2⁻²⁵/0.01 of themselves.
            assert!((told[p] - truth).abs() < 1e-4, "({x}, {y}), {c}: {} not {truth}", told[p]);
        }
    }
}
