//! The fast form against the twin.

use super::*;

/// Half of the last place, relative.
const U: f64 = 1.0 / (1u64 << 24) as f64;

/// Largest relative error of W, and of means relative to the largest value.
///
/// Rounding moves D by 20 U of itself: those of differences, denominators and of at most four pairs of guides. The exponential and
/// the spatial factor add 8 U. Of N weights of at most 1 whose sum is at least 1 the mean exponent is at most ln N. Sums are of
/// 2r + 1 terms, then of 2r + 1 of those.
fn tolerances(spatial: &Spatial, size: (usize, usize)) -> (f64, f64) {
    let side = |n: usize| (2 * spatial.radius + 1).min(n) as f64;
    let (across, down) = (side(size.0), side(size.1));
    let weights = 22.0 * (across * down).ln() + 8.0 + across + down;
    (weights * U, (2.0 * weights + 1.0) * U)
}

/// Holds a case to the twin.
fn hold(what: &str, case: &Case) {
    let largest = f64::from(case.planes.iter().flatten().fold(0.0f32, |most, v| most.max(v.abs())));
    for ((fast, slow), spatial) in case.filter().iter().zip(&case.oracle()).zip(&case.bank) {
        let (of_weight, of_mean) = tolerances(spatial, (case.params.width, case.params.height));
        for (fast, slow) in fast.weights.iter().zip(&slow.weights) {
            let error = (f64::from(*fast) / slow - 1.0).abs();
            assert!(error <= of_weight, "{what}, {spatial:?}: W {fast}, {slow}");
        }
        assert_eq!(fast.planes.len(), case.planes.len());
        for (fast, slow) in fast.planes.iter().flatten().zip(slow.planes.iter().flatten()) {
            let error = (f64::from(*fast) - slow).abs();
            assert!(error <= of_mean * largest, "{what}, {spatial:?}: {fast}, {slow}");
        }
    }
}

#[test]
fn the_fast_form_is_the_formula() {
    for (width, height) in [(1, 1), (1, 8), (7, 3), (24, 17), (66, 18)] {
        for guides in [0, 1, 2, 7] {
            hold(&format!("{width}x{height}, {guides}"), &Case::random(width, height, guides, 2));
        }
    }
}

#[test]
fn any_number_of_planes_is_averaged() {
    for planes in 1..=7 {
        hold(&format!("{planes} planes"), &Case::random(19, 6, 3, planes));
    }
}

#[test]
fn windows_may_be_larger_than_the_image_and_than_twice_sigma() {
    let mut case = Case::random(24, 17, 3, 2);
    case.bank = vec![
        Spatial { sigma: 30.0, radius: MAX_RADIUS },
        Spatial { sigma: 0.3, radius: 40 },
        Spatial { sigma: 1e6, radius: 1 },
        Spatial { sigma: 1e-30, radius: 2 },
    ];
    hold("24x17", &case);
    case.params = BilateralParams { width: 17, height: 24, floor: 0.5 };
    hold("17x24", &case);
}

#[test]
fn guides_at_the_limits_are_guides_like_others() {
    let (most, wide) = (MAX_VALUE, MAX_VARIANCE);
    for floor in [1e-12, 1e6] {
        for sigma in [1e-3, 1e2] {
            let mut case = Case::random(20, 3, 4, 1);
            case.params.floor = floor;
            for (k, (value, variance, of)) in case.guides.iter_mut().enumerate() {
                for (p, (value, variance)) in value.iter_mut().zip(variance).enumerate() {
                    *value = [most, -most, most, 1e-20][(p + k) % 4];
                    *variance = [0.0, wide, wide, 1e-20][(p / 2 + k) % 4];
                }
                *of = if k % 2 == 0 { sigma } else { 1.0 };
            }
            hold(&format!("floor {floor}, sigma {sigma}"), &case);
        }
    }
}

#[test]
fn the_naive_loop_in_f32_is_the_same_program() {
    let case = Case::random(24, 17, 7, 2);
    let single = naive::filter_f32(&case.params, &case.guides(), &case.planes(), &case.bank).unwrap();
    for (single, double) in single.iter().zip(&case.oracle()) {
        for (a, b) in single.planes.iter().flatten().zip(double.planes.iter().flatten()) {
            assert!((f64::from(*a) - b).abs() < 1e-5, "{a}, {b}");
        }
    }
}
