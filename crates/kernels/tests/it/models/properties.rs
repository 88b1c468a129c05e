//! What must hold of any model.

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::regression::models::{Distances, Field, Planes, Rules, Start, Window, naive::Twin};

use super::Case;
use crate::same_bits::{assert_bits_of_every_processor, levels};

const K: usize = 1;

fn twin(case: &Case, center: (usize, usize), radius: usize) -> Twin {
    Twin::new(case.size, &case.planes(), &case.rules, center, radius, f64::from(case.rules.bandwidths[K]))
}

#[test]
fn rows_of_the_hat_matrix_sum_to_one_and_it_is_a_projection_without_ridge() {
    for ridge in [0.0, 1e-3, 1.0] {
        let mut case = Case::new(30, 22, 31);
        case.rules.ridge = ridge;
        let twin = twin(&case, (14, 10), 6);
        for row in &twin.hat {
            assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        }
        let twice: Vec<Vec<f64>> = twin
            .hat
            .iter()
            .map(|row| {
                (0..row.len())
                    .map(|s| row.iter().zip(&twin.hat).map(|(h, other)| h * other[s]).sum())
                    .collect()
            })
            .collect();
        let pairs = || twice.iter().flatten().zip(twin.hat.iter().flatten());
        let off = pairs().map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert_eq!(off < 1e-9, ridge == 0.0, "{ridge}: {off}");
    }
}

/// A target that is affine in the columns.
fn affine(case: &mut Case) {
    let (width, pixels) = (case.size.0, case.size.0 * case.size.1);
    for c in 0..3 {
        let at = |p: usize| {
            let sum: f32 =
                case.features.iter().enumerate().map(|(f, plane)| plane[p] * (f as f32 - 2.5)).sum();
            2.0 + 0.01 * (p % width) as f32 - 0.03 * (p / width) as f32 + sum * (1.0 + c as f32)
        };
        case.target[c] = (0..pixels).map(at).collect();
    }
}

#[test]
fn a_target_that_is_affine_in_the_columns_comes_back_whatever_the_weights() {
    let mut case = Case::new(40, 30, 32);
    case.rules.ridge = 0.0;
    affine(&mut case);
    for (center, radius) in [((20, 15), 10), ((3, 2), 10), ((39, 29), 6)] {
        let twin = twin(&case, center, radius);
        let field = case.field();
        let mut window = Window::new(&field, radius);
        let level = InstructionSet::in_use();
        window.open(&field, center, radius, &Distances::default(), level);
        window.weigh(&field, K, level);
        window.fit(&field, K, false, level);
        for c in 0..3 {
            // In f64 from values of that precision, the twin is exact.
            let exact: Vec<f64> = twin
                .pixels
                .iter()
                .map(|&p| {
                    let feature = |f: usize| f64::from(case.features[f][p]) * (f as f64 - 2.5);
                    let place = 0.01 * (p % 40) as f64 - 0.03 * (p / 40) as f64;
                    2.0 + place + (0..7).map(feature).sum::<f64>() * (1.0 + c as f64)
                })
                .collect();
            let most = exact.iter().fold(0.0f64, |most, v| most.max(v.abs()));
            for (got, exact) in twin.times(&exact).iter().zip(&exact) {
                assert!((got - exact).abs() < 1e-10 * most, "{got}, {exact}");
            }
            for (p, got) in window.pixels(K).iter().zip(window.fitted()[c]) {
                let (got, wanted) = (got + window.center()[c], case.target[c][*p as usize]);
                // In f32 from values of up to this.
                assert!((got - wanted).abs() < 2e-6 * most as f32, "{got}, {wanted}");
            }
        }
    }
}

#[test]
fn without_ridge_a_second_step_in_the_window_has_no_bias() {
    let mut case = Case::new(30, 22, 33);
    case.rules.ridge = 0.0;
    let field = case.field();
    let level = InstructionSet::in_use();
    let mut window = Window::new(&field, 8);
    window.open(&field, (14, 10), 8, &Distances::default(), level);
    window.weigh(&field, K, level);
    window.step(&field, K, Start::First, level);
    let first: Vec<f32> = window.value(K)[0].to_vec();
    window.step(&field, K, Start::Own, level);
    for (first, second) in first.iter().zip(window.value(K)[0]) {
        assert!((first - second).abs() < 1e-5, "{first}, {second}");
    }
    let twin = twin(&case, (14, 10), 8);
    let y: Vec<f64> = twin.pixels.iter().map(|p| f64::from(case.guide[0][*p])).collect();
    let once = twin.times(&y);
    assert!(once.iter().zip(twin.times(&once)).all(|(a, b)| (a - b).powi(2) < 1e-12));
}

#[test]
fn a_constant_comes_back_exactly_and_costs_no_variance_where_there_is_none() {
    let mut case = Case::new(30, 22, 34);
    for plane in case.guide.iter_mut().chain(&mut case.target) {
        plane.fill(17.3);
    }
    case.variance.fill(0.0);
    let field = case.field();
    let level = InstructionSet::in_use();
    let mut window = Window::new(&field, 10);
    window.open(&field, (14, 10), 10, &Distances::default(), level);
    for k in 0..3 {
        window.weigh(&field, k, level);
        assert_eq!(window.step(&field, k, Start::First, level), 0.0);
        window.fit(&field, k, false, level);
        assert!(window.fitted().iter().all(|plane| plane.iter().all(|v| *v == 0.0)));
        assert_eq!(window.center(), [17.3; 3]);
    }
}

#[test]
fn rows_of_the_hat_matrix_sum_to_one() {
    // What is fitted is constant, the guide and its weights are not.
    for ridge in [0.1, 1e-3, 0.0] {
        let mut case = Case::new(30, 22, 34);
        case.rules.ridge = ridge;
        case.target.iter_mut().for_each(|plane| plane.fill(17.3));
        let field = case.field();
        let level = InstructionSet::in_use();
        let mut window = Window::new(&field, 10);
        window.open(&field, (14, 10), 10, &Distances::default(), level);
        let center = window.center();
        for k in 0..3 {
            window.weigh(&field, k, level);
            window.fit(&field, k, false, level);
            for (plane, center) in window.fitted().into_iter().zip(center) {
                let count = window.pixels(k).len();
                // 17 plus and minus sums of 10 columns.
                assert!(plane[..count].iter().all(|v| (v + center - 17.3).abs() < 2e-4), "{ridge}, {k}");
            }
        }
    }
}

#[test]
fn a_ridge_that_rounding_would_eat_is_none() {
    let fitted = |ridge: f64| {
        let mut case = Case::new(30, 22, 36);
        case.features[2] = case.features[1].clone();
        case.rules.ridge = ridge;
        let field = case.field();
        let level = InstructionSet::in_use();
        let mut window = Window::new(&field, 8);
        window.open(&field, (14, 10), 8, &Distances::default(), level);
        window.weigh(&field, 1, level);
        window.fit(&field, 1, false, level);
        window.fitted().map(<[f32]>::to_vec)
    };
    assert_eq!(fitted(1e-18), fitted(0.0));
    assert!(fitted(1e-10).iter().flatten().all(|v| v.is_finite()));
}

#[test]
fn without_noise_only_equal_patches_weigh() {
    // Var = 0: documented as 0/0 = 0 and x/0 = 1e4.
    let mut case = Case::new(30, 22, 35);
    case.guide_variance.iter_mut().for_each(|plane| plane.fill(0.0));
    for plane in &mut case.guide {
        for (p, v) in plane.iter_mut().enumerate() {
            *v = if p % 30 < 15 { 1.0 } else { 2.0 };
        }
    }
    let field = case.field();
    let level = InstructionSet::in_use();
    let mut window = Window::new(&field, 10);
    window.open(&field, (6, 10), 10, &Distances::default(), level);
    window.weigh(&field, K, level);
    for (p, w) in window.pixels(K).iter().zip(window.weights(K)) {
        // A patch of radius 3 around columns up to 11 does not see the edge.
        assert_eq!((p % 30 < 12, *w), (true, 1.0));
    }
    assert_eq!(window.pixels(K).len(), 12 * 21);
}

/// Fitted values of one channel, and the sum of the first step.
fn fitted(case: &Case) -> (Vec<f32>, f64) {
    let field = case.field();
    let level = InstructionSet::in_use();
    let mut window = Window::new(&field, 10);
    window.open(&field, (16, 12), 10, &Distances::default(), level);
    window.weigh(&field, K, level);
    let sum = window.step(&field, K, Start::First, level);
    window.fit(&field, K, false, level);
    (window.fitted()[0].to_vec(), sum)
}

#[test]
fn constant_equal_and_differently_scaled_features_change_nothing() {
    for ridge in [1e-3, 0.0] {
        let mut case = Case::new(34, 26, 36);
        case.rules.ridge = ridge;
        case.features.truncate(3);
        let (before, sum) = fitted(&case);
        let close = |case: &Case, most: f32, what: &str| {
            let (after, other) = fitted(case);
            let off = before.iter().zip(&after).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(off <= most, "{what}, ridge {ridge}: {off}");
            assert!((other / sum - 1.0).abs() <= f64::from(most) * 10.0, "{what}: {other}, {sum}");
        };
        let with = |change: &dyn Fn(&mut Case)| {
            let mut other = Case::new(34, 26, 36);
            other.rules.ridge = ridge;
            other.features.truncate(3);
            change(&mut other);
            other
        };
        let constant = with(&|case| case.features.push(vec![0.7; 34 * 26]));
        close(&constant, 0.0, "constant");
        for scale in [1e-6f32, 1e6] {
            let scaled = with(&|case| case.features[1].iter_mut().for_each(|v| *v *= scale));
            // Differences of features keep 20 bits.
            close(&scaled, 2e-5, "scaled");
        }
        // Twice the same feature shares its slope: with ridge that is half the ridge for it.
        let equal = with(&|case| case.features.push(case.features[1].clone()));
        close(&equal, if ridge > 0.0 { 1e-2 } else { 2e-5 }, "equal");
    }
}

/// Windows of three sizes with all bandwidths, every number that they hold.
fn bits_at(field: &Field, level: InstructionSet) -> Vec<u32> {
    let mut out: Vec<u32> = Vec::new();
    let mut window = Window::new(field, 15);
    for (center, radius) in [((20, 15), 15), ((3, 30), 10), ((43, 2), 5)] {
        window.open(field, center, radius, &Distances::default(), level);
        out.extend(window.pixels(2));
        for k in 0..3 {
            window.weigh(field, k, level);
            for start in [Start::First, Start::Own] {
                let sum = window.step(field, k, start, level).to_bits();
                out.extend([sum as u32, (sum >> 32) as u32]);
            }
            window.fit(field, k, false, level);
            let columns = window.fitted().into_iter().chain(window.value(k)).chain(window.refitted());
            let columns = columns.chain([window.weights(k), window.variance(k), window.error(k)]);
            out.extend(columns.flatten().map(|v| v.to_bits()));
        }
    }
    out
}

#[test]
fn bits_are_equal_on_every_instruction_set_and_processor() {
    for (ridge, expected) in [(1e-3, 0xa636_c94f_41bb_b53f), (0.0, 0x2d66_d260_6ebb_2d60)] {
        let mut case = Case::new(44, 36, 37);
        case.rules.ridge = ridge;
        let field = case.field();
        let portable = bits_at(&field, InstructionSet::Portable);
        for level in levels() {
            assert!(bits_at(&field, level) == portable, "{level}");
        }
        assert_bits_of_every_processor(|level| bits_at(&field, level), expected);
    }
}

#[test]
fn what_is_out_of_range_is_refused() {
    let case = Case::new(8, 5, 38);
    let refuse = |rules: Rules| Field::new(8, 5, &case.planes(), rules).unwrap_err().to_string();
    let good = || case.rules.clone();
    for (rules, what) in [
        (Rules { patch_radius: 4, ..good() }, "patch radius = 4"),
        (Rules { range_sigma: 0.0, ..good() }, "range sigma = 0"),
        (Rules { bandwidths: vec![], ..good() }, "bandwidths = 0"),
        (Rules { bandwidths: vec![2.0, 1.0], ..good() }, "ascend"),
        (Rules { least_weight: 0.75, ..good() }, "least weight = 0.75"),
        (Rules { ridge: f64::NAN, ..good() }, "ridge = NaN"),
    ] {
        assert!(refuse(rules).contains(what));
    }
    let mut planes = case.planes();
    planes.variance = &planes.variance[1..];
    let told = |planes: &Planes<'_>| Field::new(8, 5, planes, good()).unwrap_err().to_string();
    assert!(told(&planes).contains("`variance` holds 39 values"), "{}", told(&planes));
    let spoilt: Vec<f32> = (0..40).map(|p| if p == 7 { f32::NAN } else { 0.0 }).collect();
    planes = case.planes();
    planes.guide[1] = &spoilt;
    assert!(told(&planes).contains("`guide channel 1` holds NaN at pixel (7, 0)"), "{}", told(&planes));
}
