//! What follows from the formulas.

use super::*;

/// A filter without falloff within its window.
fn flat(radius: usize) -> Spatial {
    Spatial { sigma: 1e6, radius }
}

#[test]
fn radii_are_twice_sigma_to_the_nearest_pixel() {
    assert_eq!(SIGMAS.map(|sigma| Spatial::new(sigma).radius), [0, 1, 2, 3, 4, 6, 8, 11, 16]);
    assert_eq!([0.2, 0.25].map(|sigma| Spatial::new(sigma).radius), [0, 1]);
}

#[test]
fn without_a_sigma_planes_come_back_with_weight_one() {
    let mut case = Case::random(30, 18, 3, 2);
    case.planes[0][5] = -0.0;
    // Also where there is a window.
    case.bank = vec![Spatial::new(0.0), Spatial { sigma: 0.0, radius: 5 }, Spatial { sigma: 3.0, radius: 0 }];
    for of in case.filter() {
        assert_eq!(of.planes, case.planes);
        assert!(of.weights.iter().all(|w| *w == 1.0));
    }
    for of in case.oracle() {
        let planes: Vec<Vec<f32>> =
            of.planes.iter().map(|plane| plane.iter().map(|v| *v as f32).collect()).collect();
        assert_eq!(planes, case.planes);
        assert!(of.weights.iter().all(|w| *w == 1.0));
    }
}

#[test]
fn weights_sum_to_at_least_one_and_grow_with_the_window() {
    let case = Case::random(67, 20, 7, 1);
    let out = case.filter();
    assert!(out.iter().flat_map(|of| &of.weights).all(|w| *w >= 1.0));
    for (small, large) in out.iter().zip(&out[1..]) {
        assert!(small.weights.iter().zip(&large.weights).all(|(a, b)| a <= b));
    }
}

#[test]
fn a_constant_plane_stays_constant() {
    let mut case = Case::random(50, 20, 3, 2);
    case.planes[0].fill(-0.25);
    case.planes[1].fill(0.3);
    for of in case.filter() {
        // As W, times a power of two.
        assert!(of.planes[0].iter().all(|v| *v == -0.25));
        // Sums of 33 terms, then of 33 of those.
        assert!(of.planes[1].iter().all(|v| (v / 0.3 - 1.0).abs() < 67.0 * f32::EPSILON / 2.0));
    }
}

#[test]
fn without_guides_and_falloff_it_is_the_mean_of_the_window_in_the_image() {
    let (width, height, radius) = (67, 19, 3);
    let mut case = Case::random(width, height, 0, 1);
    case.bank = vec![flat(radius)];
    let out = &case.filter()[0];
    for p in 0..width * height {
        let (x, y) = (p % width, p / width);
        let columns = x.saturating_sub(radius)..(x + radius + 1).min(width);
        let rows = y.saturating_sub(radius)..(y + radius + 1).min(height);
        let count = columns.len() * rows.len();
        assert_eq!(out.weights[p], count as f32, "{x}, {y}");
        let sum: f64 = rows
            .flat_map(|j| columns.clone().map(move |i| j * width + i))
            .map(|q| f64::from(case.planes[0][q]))
            .sum();
        // Sums of 7 terms, then of 7 of those, of values of at most 1.
        assert!((f64::from(out.planes[0][p]) - sum / count as f64).abs() < 1e-6, "{x}, {y}");
    }
}

#[test]
fn a_pair_has_one_weight_from_both_sides() {
    let case = Case { bank: vec![Spatial::new(2.0)], ..Case::random(9, 7, 3, 1) };
    let all: Vec<usize> = (0..63).collect();
    let to = case.weights_to(&all);
    for (p, to_p) in to.iter().enumerate() {
        assert!((to_p[p] - 1.0).abs() < 1e-15);
        for (q, w) in to_p.iter().enumerate() {
            assert!((w - to[q][p]).abs() < 1e-15, "{p}, {q}");
        }
    }
}

#[test]
fn nothing_crosses_a_step_of_a_guide_without_variance() {
    // D = 1/0.01/(2·0.25²) = 800.
    let step: Vec<f32> = (0..70).map(|x| f32::from(x >= 33)).collect();
    let case = Case::row(&step, 0.0, 0.25, flat(40));
    let out = &case.filter()[0];
    assert_eq!(out.planes[0], step);
    // All on one's own side that the window reaches.
    assert_eq!((out.weights[0], out.weights[32], out.weights[33]), (33.0, 33.0, 37.0));
    assert!(case.weights_to(&[32])[0][33] == 0.0);
}

#[test]
fn a_step_within_the_variance_counts_as_the_variance_says() {
    // D = 1/(0.5 + 0.5)/(2·0.25²) = 8.
    let case = Case::row(&[0.0, 1.0], 0.5, 0.25, flat(1));
    let weight = (-8.0f64).exp();
    for to in case.weights_to(&[0, 1]) {
        assert!(to.iter().all(|w| [1.0, weight].iter().any(|expected| (w / expected - 1.0).abs() < 1e-11)));
    }
    let out = &case.filter()[0];
    assert!((f64::from(out.weights[0]) - 1.0 - weight).abs() < 1e-7);
    assert!((f64::from(out.planes[0][0]) / (weight / (1.0 + weight)) - 1.0).abs() < 1e-6);
}

#[test]
fn distance_in_the_image_and_in_a_guide_add_up_in_the_exponent() {
    // |p − q|² = 4, so 4/(2·1.5²), and D = 1/1/(2·0.5²).
    let mut case = Case::row(&[0.0, 0.0, 1.0], 0.5, 0.5, Spatial::new(1.5));
    case.planes = vec![vec![0.0, 0.0, 1.0]];
    let out = &case.filter()[0];
    let weight = f64::from(out.planes[0][0]) * f64::from(out.weights[0]);
    assert!((weight / (-4.0f64 / 4.5 - 2.0).exp() - 1.0).abs() < 1e-6, "{weight}");
}

#[test]
fn weights_are_zero_beyond_an_exponent_of_87() {
    // D of the neighbour 86, then 89, with the share of distance below and beyond 87.
    for (d, sigma, zero) in [(86.0f32, 10.0, false), (86.0, 0.5, true), (89.0, 10.0, true)] {
        let mut case = Case::row(&[0.0, (d * 0.02).sqrt()], 0.0, 1.0, Spatial { sigma, radius: 1 });
        case.planes = vec![vec![0.0, 1e30]];
        let out = &case.filter()[0];
        assert_eq!(out.planes[0][0] == 0.0, zero, "{d}, {sigma}");
        assert_eq!(case.oracle()[0].planes[0][0] == 0.0, zero, "{d}, {sigma}");
    }
}

#[test]
fn averaging_is_linear() {
    let mut case = Case::random(41, 18, 3, 2);
    let both = case.planes[0].iter().zip(&case.planes[1]).map(|(a, b)| a - 2.0 * b).collect();
    case.planes.push(both);
    let mut negative = false;
    for of in case.filter() {
        for p in 0..of.weights.len() {
            let (a, b, both) = (of.planes[0][p], of.planes[1][p], of.planes[2][p]);
            // Values of up to 3 and sums of 33 terms, then of 33 of those.
            assert!((both - (a - 2.0 * b)).abs() < 3.0 * 67.0 * f32::EPSILON, "{p}: {a}, {b}, {both}");
            negative |= both < -0.01;
        }
    }
    assert!(negative);
}

#[test]
fn the_order_of_guides_and_a_guide_that_says_nothing_change_no_more_than_rounding() {
    let case = Case::random(40, 17, 3, 1);
    let mut other = case.clone();
    other.guides.reverse();
    other.guides.insert(1, (vec![7.0; 680], vec![0.0; 680], 0.1));
    for (a, b) in case.filter().iter().zip(&other.filter()) {
        assert!(a.planes[0].iter().zip(&b.planes[0]).all(|(a, b)| (a - b).abs() < 2e-6));
    }
}
