//! The rules beside the printed formulas: against the twin, and what each says without it.

use super::oracle::agrees;
use super::oracle::agrees_with_running_again;
use super::*;

/// Each rule alone, some together, and both authors' programs.
fn all_rules() -> Vec<WeightRules> {
    let none = WeightRules::default();
    vec![
        WeightRules { smoothing: Smoothing::BelowPatch, ..none },
        WeightRules { smoothing: Smoothing::Patch, ..none },
        WeightRules { pairs: Pairs::Near, ..none },
        WeightRules { pairs: Pairs::Raw, ..none },
        WeightRules { border: Border::Mirrored, ..none },
        WeightRules { taps: Taps::Clipped, ..none },
        WeightRules { smoothing: Smoothing::Patch, pairs: Pairs::Near, ..none },
        WeightRules { smoothing: Smoothing::BelowPatch, border: Border::Mirrored, pairs: Pairs::Raw, ..none },
        WeightRules {
            smoothing: Smoothing::BelowPatch,
            pairs: Pairs::Near,
            border: Border::Mirrored,
            taps: Taps::Clipped,
        },
        WeightRules {
            smoothing: Smoothing::Patch,
            pairs: Pairs::Raw,
            border: Border::Mirrored,
            taps: Taps::Clipped,
        },
    ]
}

fn derivative_rules() -> Vec<WeightRules> {
    all_rules().into_iter().map(|rules| WeightRules { smoothing: Smoothing::None, ..rules }).collect()
}

/// A smooth guide under noise, of which opposite neighbours tell something.
fn ramps(mut case: Case) -> Case {
    let (w, n) = (case.params.width, case.params.width * case.params.height);
    let mut u = Random(17);
    for (c, [value, variance]) in case.frame.guide.iter_mut().enumerate() {
        *value =
            (0..n).map(|i| 0.3 + (0.02 + 0.01 * c as f32) * (i % w) as f32 + 0.02 * u.uniform()).collect();
        variance.iter_mut().for_each(|v| *v = 1e-4 + 1e-3 * u.uniform());
    }
    case
}

fn with(mut case: Case, rules: WeightRules) -> Case {
    case.params.rules = rules;
    case
}

#[test]
fn every_rule_agrees_at_every_size() {
    let passes = [pass(Some(1), 1e-3), pass(Some(3), 1e-3), pass(None, 1e-4)];
    for rules in all_rules() {
        for (width, height, radius) in [(1, 1, 3), (1, 7, 2), (7, 1, 3), (2, 2, 1), (17, 8, 2)] {
            agrees(&with(ramps(Case::random(width, height, radius, &passes, &[2, 1])), rules));
        }
    }
}

#[test]
fn every_rule_agrees_with_every_choice() {
    for rules in all_rules() {
        for (denominator, guide, center, cancellation) in [
            (Denominator::Pair, GuideDenominator::Pair, Center::LargestNeighbor { least: 1e-3 }, 1.0),
            (Denominator::Center, GuideDenominator::TwiceCenter, Center::One, 0.5),
        ] {
            let passes = [pass(Some(2), 1e-2), pass(Some(0), 1e-4)];
            let mut case = with(ramps(Case::random(17, 7, 2, &passes, &[3])), rules);
            case.params =
                NlmParams { denominator, center, cancellation, guide_denominator: guide, ..case.params };
            agrees(&case);
            case.frame = Owned::random(&mut Random(3), 119, 1, &[], 1);
            agrees(&case);
        }
    }
}

#[test]
fn derivatives_follow_the_same_rules() {
    for rules in derivative_rules() {
        for rule in [Rule::Exact, Rule::Joint] {
            for (width, height, radius) in [(1, 1, 2), (4, 3, 2), (15, 9, 3)] {
                let case = Case::random(width, height, radius, &candidates(true), &[1]);
                agrees(&with(ramps(case), rules).with_step(rule));
            }
        }
    }
}

#[test]
fn a_pair_that_the_step_takes_beyond_the_limit_keeps_its_share_only_if_all_channels_move() {
    // Both neighbours at a distance of 24.9 from the middle; the step of 1 % takes one to 29.
    let mut case = Case::random(3, 1, 1, &[Pass { patch: Some(0), floor: 1.0, derivative: true }], &[]);
    for [value, variance] in &mut case.frame.guide {
        *value = vec![0.4375, 0.5, 0.5625];
        variance.fill(3.2326e-4);
    }
    let values = [0, 1, 2].map(|c: usize| case.frame.guide[c][0].clone());
    let step = values.map(|values| values.iter().map(|v| 0.01 * v).collect());
    case.params.rules.pairs = Pairs::Near;
    let of = |rule| {
        let case = Case { step: Some((Clone::clone(&step), rule)), ..case.clone() };
        agrees(&case);
        case.fast()[0].derivative[0][1]
    };
    let (joint, exact) = (of(Rule::Joint), of(Rule::Exact));
    // Three pixels of weight 1 before and after; one channel alone takes the one to 26 and both weights to nothing.
    assert!((joint - 1.0 / 3.0).abs() < 1e-3 && (exact - 1.0 / 3.0).abs() > 1e-3, "{joint} {exact}");
}

#[test]
fn neighbouring_frames_follow_the_same_rules() {
    for rules in derivative_rules() {
        let case = ramps(Case::random(12, 7, 2, &candidates(true), &[2]));
        agrees(&with(case, rules).with_neighbors(1).with_step(Rule::Exact));
    }
    for rules in all_rules() {
        agrees(&with(ramps(Case::random(9, 6, 2, &candidates(false), &[2])), rules).with_neighbors(2));
    }
}

#[test]
fn the_derivative_with_pairs_is_that_of_running_the_filter_again() {
    let (w, h) = (21, 15);
    let passes = [Pass { patch: Some(1), floor: 1.0, derivative: true }];
    for pairs in [Pairs::Near, Pairs::Raw] {
        let rules = WeightRules { pairs, ..WeightRules::default() };
        let case = with(ramps(Case::random(w, h, 3, &passes, &[])), rules).with_step(Rule::Exact);
        agrees_with_running_again(&case, [(5, 5), (10, 7), (14, 9)]);
    }
}

#[test]
fn constants_stay_constant() {
    for rules in all_rules() {
        let mut case = with(ramps(Case::random(40, 20, 5, &candidates(false), &[3])), rules);
        case.frame.targets = vec![vec![3.7; 800], vec![0.0; 800]];
        for filtered in case.fast() {
            // Sums of 121 terms.
            assert!(filtered.planes[0].iter().all(|v| (v / 3.7 - 1.0).abs() < 4e-6));
            assert!(filtered.planes[1].iter().all(|v| *v == 0.0));
        }
    }
}

#[test]
fn smoothing_changes_nothing_of_equal_weights() {
    // Noise far above all differences: every distance is negative and every weight 1.
    let mut case = Case::random(40, 20, 5, &[pass(Some(3), 1.0)], &[]);
    case.frame.guide.iter_mut().for_each(|[_, variance]| variance.fill(100.0));
    let plain = with(case.clone(), WeightRules { taps: Taps::Clipped, ..WeightRules::default() }).fast();
    for smoothing in [Smoothing::BelowPatch, Smoothing::Patch] {
        let rules = WeightRules { smoothing, taps: Taps::Clipped, ..WeightRules::default() };
        assert_eq!(with(case.clone(), rules).fast(), plain);
    }
    // And it does of unequal ones.
    let case = ramps(case);
    let rules = WeightRules { smoothing: Smoothing::Patch, ..WeightRules::default() };
    assert_ne!(with(case.clone(), rules).fast(), with(case, WeightRules::default()).fast());
}

#[test]
fn smoothing_of_a_weight_spreads_it_over_a_box() {
    // One pixel of a flat guide without noise differs: only its own weights are 0.
    let (w, h) = (21, 9);
    let mut case = Case::random(w, h, 1, &[pass(Some(1), 1.0)], &[]);
    case.passes[0].patch = Some(0);
    for [value, variance] in &mut case.frame.guide {
        value.fill(0.5);
        variance.fill(0.0);
    }
    case.frame.guide[0][0][4 * w + 10] = 0.7;
    let unlike = |patch: usize| {
        let mut case = case.clone();
        case.passes[0].patch = Some(patch);
        let rules = WeightRules { smoothing: Smoothing::Patch, ..WeightRules::default() };
        with(case, rules).fast()[0].weight_sum.clone()
    };
    // Radius 0: the pixel has its own weight alone, its neighbours miss one.
    assert_eq!(unlike(0)[4 * w + 10], 1.0);
    assert_eq!(unlike(0)[4 * w + 11], 8.0);
    // Radius 1: of a weight's map, 9 pixels around the odd one and 9 around its neighbour have distances, so pixels
    // three columns away are the first with all weights.
    assert!(unlike(1)[4 * w + 13] < 9.0);
    assert_eq!(unlike(1)[4 * w + 14], 9.0);
}

#[test]
fn pairs_change_nothing_where_both_neighbours_equal_their_mean() {
    let (w, h) = (24, 12);
    // Columns of a guide that is constant down each: vertical pairs are alike; a window one column wide has no others.
    for pairs in [Pairs::Near, Pairs::Raw] {
        let mut case = Case::random(w, h, 2, &[pass(Some(0), 1.0)], &[]);
        for [value, variance] in &mut case.frame.guide {
            value.fill(0.5);
            variance.fill(0.0);
        }
        let plain =
            with(case.clone(), WeightRules { border: Border::Mirrored, ..WeightRules::default() }).fast();
        let rules = WeightRules { pairs, border: Border::Mirrored, ..WeightRules::default() };
        assert_eq!(with(case.clone(), rules).fast(), plain);
    }
}

#[test]
fn pairs_keep_a_gradient() {
    // A ramp with little noise: alone no neighbour counts, opposite ones average to the pixel itself.
    let (w, h) = (33, 15);
    let mut case = Case::random(w, h, 3, &[pass(Some(1), 1.0)], &[]);
    for [value, variance] in &mut case.frame.guide {
        *value = (0..w * h).map(|i| 0.0625 * (i % w) as f32 + 0.125 * (i / w) as f32).collect();
        variance.fill(1e-3);
    }
    case.frame.targets = vec![case.frame.guide[0][0].clone()];
    let run = |pairs: Pairs| {
        let filtered = with(case.clone(), WeightRules { pairs, ..WeightRules::default() }).fast().remove(0);
        (filtered.planes[0].clone(), filtered.weight_sum)
    };
    let ((alone, few), (raw, most), (near, some)) = (run(Pairs::None), run(Pairs::Raw), run(Pairs::Near));
    for (y, x) in (4..h - 4).flat_map(|y| (4..w - 4).map(move |x| (y, x))) {
        let i = y * w + x;
        for filtered in [&alone, &raw, &near] {
            assert!((filtered[i] - case.frame.targets[0][i]).abs() < 1e-5);
        }
        // 48 neighbours and the pixel itself, but for those that alone differ by more than the limit.
        assert!(few[i] < 6.0 && (most[i] - 49.0).abs() < 1e-3, "{} {}", few[i], most[i]);
        assert!(some[i] > few[i] + 1.0 && some[i] < most[i] - 1.0, "{}", some[i]);
    }
}

#[test]
fn clipped_taps_are_mirrored_ones_away_from_the_border() {
    let (w, h, f) = (30, 20, 2);
    for smoothing in [Smoothing::None, Smoothing::BelowPatch] {
        let case = ramps(Case::random(w, h, 3, &[pass(Some(f), 1.0)], &[]));
        let run = |taps| {
            // Of the same form, whatever the taps.
            let rules = WeightRules { taps, smoothing, pairs: Pairs::Near, ..WeightRules::default() };
            with(case.clone(), rules).fast().remove(0)
        };
        let (clipped, mirrored) = (run(Taps::Clipped), run(Taps::Mirrored));
        let margin = f + smoothing.radius(f);
        let inner = |i: usize| {
            let (x, y) = (i % w, i / w);
            (margin..w - margin).contains(&x) && (margin..h - margin).contains(&y)
        };
        for i in (0..w * h).filter(|i| inner(*i)) {
            assert_eq!(clipped.planes[0][i].to_bits(), mirrored.planes[0][i].to_bits());
        }
        assert_ne!(clipped.planes[0], mirrored.planes[0]);
    }
}

#[test]
fn mirrored_windows_have_all_their_pixels() {
    let (w, h, r) = (12, 9, 3);
    let case = Case::random(w, h, r, &[pass(None, 1.0)], &[]);
    let rules = WeightRules { border: Border::Mirrored, ..WeightRules::default() };
    let filtered = &with(case.clone(), rules).fast()[0];
    let mirror = |i: isize, n: usize| noisefloor_kernels::mirror(i, n);
    for (y, x) in (0..h).flat_map(|y| (0..w).map(move |x| (y, x))) {
        let window = (-3..=3).flat_map(|dy| (-3..=3).map(move |dx| (dx, dy)));
        let mean = window
            .map(|(dx, dy)| {
                let (i, j) = (mirror(x as isize + dx, w), mirror(y as isize + dy, h));
                f64::from(case.frame.targets[0][j * w + i])
            })
            .sum::<f64>()
            / 49.0;
        assert!((f64::from(filtered.planes[0][y * w + x]) - mean).abs() < 1e-6);
        assert_eq!(filtered.weight_sum[y * w + x], 49.0);
    }
}

#[test]
fn a_mirrored_image_gives_the_mirrored_result() {
    let (w, h) = (23, 14);
    for rules in all_rules() {
        let case = with(ramps(Case::random(w, h, 4, &candidates(false), &[1])), rules);
        let flip = |plane: &mut Vec<f32>| plane.chunks_mut(w).for_each(<[f32]>::reverse);
        let mut other = case.clone();
        other.frame.guide.iter_mut().flatten().for_each(flip);
        other.frame.features.iter_mut().flatten().flatten().for_each(flip);
        other.frame.targets.iter_mut().for_each(flip);
        for (a, mut b) in case.fast().into_iter().zip(other.fast()) {
            flip(&mut b.planes[0]);
            assert!(a.planes[0].iter().zip(&b.planes[0]).all(|(a, b)| (a - b).abs() < 1e-5));
        }
    }
}

#[test]
fn smoothed_weights_have_no_derivative() {
    let rules = WeightRules { smoothing: Smoothing::BelowPatch, ..WeightRules::default() };
    let case = with(Case::random(4, 3, 1, &candidates(true), &[1]), rules).with_step(Rule::Exact);
    let error = filter(&case.params, &case.passes, &case.inputs()).unwrap_err().to_string();
    assert!(error.contains("derivative"), "{error}");
    // That by features alone has nothing to do with the guide.
    let alone = Case { passes: vec![Pass { patch: None, floor: 1.0, derivative: true }], ..case };
    agrees(&alone);
}
