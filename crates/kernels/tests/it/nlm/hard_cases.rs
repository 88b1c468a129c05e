//! Extreme and wrong inputs.

use super::*;

fn finite(filtered: &[Filtered]) {
    for f in filtered {
        let all = f.planes.iter().chain([&f.weight_sum, &f.center_share]).chain(&f.derivative);
        assert!(all.flatten().all(|v| v.is_finite()));
        assert!(f.center_share.iter().all(|s| *s > 0.0 && *s <= 1.0));
    }
}

#[test]
fn extreme_values_give_finite_results() {
    for scale in [0.0, 1e-20, 1e-8, 1.0, 1e8, MAX_VALUE] {
        for variance in [0.0, scale * scale, MAX_VARIANCE] {
            for center in [Center::One, Center::LargestNeighbor { least: 1e-3 }] {
                for k in [MIN_K, 0.45, MAX_K] {
                    let mut case = Case::random(18, 5, 3, &candidates(true), &[1, 2]).with_step(Rule::Exact);
                    let mut u = Random(5);
                    let mut wild = |plane: &mut Vec<f32>| {
                        plane.iter_mut().for_each(|v| {
                            *v = if u.uniform() < 0.5 { scale } else { -scale * u.uniform() };
                        });
                    };
                    for [value, v] in &mut case.frame.guide {
                        wild(value);
                        v.fill(variance);
                    }
                    for [value, v, spread] in case.frame.features.iter_mut().flatten() {
                        wild(value);
                        v.fill(variance);
                        spread.fill(variance);
                    }
                    case.frame.targets.iter_mut().for_each(&mut wild);
                    case.params = NlmParams { center, k, feature_k: k, ..case.params };
                    finite(&case.fast());
                    for pairs in [Pairs::Near, Pairs::Raw] {
                        case.params.rules = WeightRules { pairs, ..WeightRules::default() };
                        finite(&case.fast());
                    }
                }
            }
        }
    }
}

#[test]
fn a_firefly_does_not_spoil_the_windows_after_it() {
    let mut case = Case::random(40, 9, 3, &candidates(false), &[]);
    let clean = case.fast();
    case.frame.guide[0][0][4 * 40 + 10] = 1e12;
    let spoilt = case.fast();
    // Pixels whose windows and patches do not reach the firefly.
    for (a, b) in clean.iter().zip(&spoilt) {
        for i in (0..9 * 40).filter(|i| i % 40 > 10 + 3 + 3) {
            assert_eq!(a.planes[0][i].to_bits(), b.planes[0][i].to_bits());
        }
    }
}

#[test]
fn what_is_out_of_range_is_named() {
    let good = Case::random(4, 3, 2, &candidates(true), &[1]).with_step(Rule::Exact);
    let error = |change: &dyn Fn(&mut Case)| {
        let mut case = good.clone();
        change(&mut case);
        filter(&case.params, &case.passes, &case.inputs()).unwrap_err().to_string()
    };
    let told = |change: &dyn Fn(&mut Case), words: &[&str]| {
        let message = error(change);
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    told(&|c| c.params.width = 0, &["0x3", "at least 1"]);
    told(&|c| c.params.width = 5, &["step 0", "12 values", "15 pixels"]);
    told(&|c| c.params.window_radius = 33, &["window radius = 33", "0 to 32"]);
    told(&|c| c.params.k = f32::NAN, &["k = NaN"]);
    told(&|c| c.params.k = 0.0, &["k = 0"]);
    told(&|c| c.params.cancellation = -1.0, &["cancellation = -1"]);
    told(&|c| c.params.feature_k = f32::INFINITY, &["feature k = inf"]);
    told(&|c| c.params.center = Center::LargestNeighbor { least: 0.0 }, &["least centre weight = 0"]);
    told(&|c| c.passes.clear(), &["number of passes = 0"]);
    told(&|c| c.passes[0].patch = Some(4), &["patch radius = 4", "0 to 3"]);
    told(&|c| c.passes[0].floor = 0.0, &["floor = 0"]);
    told(&|c| c.frame.guide.clear(), &["no guide"]);
    told(&|c| c.frame.guide.truncate(1), &["3 channels", "it has 1"]);
    told(&|c| c.step = None, &["perturbation"]);
    told(&|c| c.step.as_mut().unwrap().0[1][5] = -1.0, &["step 1", "-1", "(1, 1)"]);
    told(&|c| c.frame.guide[2][0][6] = f32::NAN, &["guide channel 2", "NaN", "(2, 1)"]);
    told(&|c| c.frame.guide[2][1][0] = -1e-9, &["variance of guide channel 2", "(0, 0)"]);
    told(&|c| c.frame.features[0][0][2][11] = 1e31, &["spread of feature channel 0", "(3, 2)"]);
    told(&|c| c.frame.targets[1][4] = 2e15, &["target 1", "(0, 1)"]);
    told(&|c| c.frame.features = vec![vec![]], &["channels of a feature = 0"]);
    told(
        &|c| {
            c.neighbors = vec![c.frame.clone()];
            c.neighbors[0].targets.pop();
        },
        &["neighbouring frame 0"],
    );
}
