//! The twin in `f64` is the oracle.

use super::*;

/// Shares of the weights of pairs within the window that are 0, and that are between a hundredth and 1.
fn spread(case: &Case) -> [f64; 2] {
    let (width, height) = (case.fit.weighting.width as isize, case.fit.weighting.height as isize);
    let (mut all, mut none, mut some) = (0.0, 0.0, 0.0);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        for (u, v) in (0..height).flat_map(|v| (0..width).map(move |u| (u, v))) {
            let d = (u - x, v - y);
            if d != (0, 0) && d.0.abs() <= 9 && d.1.abs() <= 9 {
                let weight = naive::joined_weight(&case.fit, &case.guide(), (x, y), d);
                all += 1.0;
                none += f64::from(weight < 1e-37);
                some += f64::from((0.01..0.99).contains(&weight));
            }
        }
    }
    [none / all, some / all]
}

#[test]
fn cases_have_weights_of_every_size() {
    let [none, some] = spread(&Case::random(24, 17, 7));
    assert!(none > 0.001 && some > 0.2, "{none}, {some}");
}

#[test]
fn weights_equal_the_loops() {
    for (width, height, patch, window) in
        [(24, 17, 3, 9), (24, 17, 1, 9), (11, 40, 0, 5), (70, 20, 3, 2), (5, 3, 2, 9)]
    {
        let mut case = Case::random(width, height, 0);
        case.fit.weighting = Weighting { patch, window, ..case.fit.weighting };
        let fast = means(&case.fit.weighting, &case.alone()).unwrap();
        let slow = naive::means(&case.fit.weighting, &case.alone()).unwrap();
        for (a, b) in fast.iter().flatten().zip(slow.iter().flatten()) {
            // Sums of up to 361 values of order 1 in f32.
            assert!(far(a, b) < 2e-6, "{width}x{height}, {patch}: {}", far(a, b));
        }
    }
}

#[test]
fn regressions_equal_the_loops() {
    for (width, height, features) in
        [(24, 17, 7), (40, 35, 7), (24, 17, 0), (24, 17, 3), (9, 33, 4), (12, 12, 11), (1, 1, 7), (3, 2, 7)]
    {
        let case = Case::random(width, height, features);
        let far = farthest(&case.regress(), &case.oracle());
        assert!(far < 2e-6, "{width}x{height}, {features}: {far}");
    }
}

#[test]
fn regressions_with_other_choices_equal_the_loops() {
    for (solver, join, positions) in [
        (Solver::MinimalNorm, Join::Mean, true),
        (Solver::MinimalNorm, Join::Minimum, false),
        (Solver::Dropped, Join::Mean, false),
    ] {
        let mut case = Case::random(24, 19, 7);
        case.fit = Fit { solver, join, positions, ..case.fit };
        let far = farthest(&case.regress(), &case.oracle());
        assert!(far < 2e-6, "{solver:?}, {join:?}: {far}");
    }
}

/// A wall of constant features with an edge, and features that make each other up.
fn degenerate(width: usize, height: usize) -> Case {
    let mut case = Case::random(width, height, 7);
    for p in 0..width * height {
        let (x, y) = ((p % width) as f32, (p / width) as f32);
        case.features[1][p] = if p % width < width / 2 { 0.25 } else { 0.75 };
        case.features[2][p] = 0.5;
        case.features[3][p] = 2.0 * case.features[0][p];
        case.features[4][p] = case.features[0][p] - 2.0 * case.features[1][p];
        case.features[5][p] = 4.0 - 0.25 * x + 0.5 * y;
        case.features[6][p] = 0.0;
    }
    case
}

#[test]
fn features_that_tell_nothing_or_the_same_are_left_out_as_in_the_loops() {
    for solver in [Solver::Dropped, Solver::MinimalNorm] {
        let mut case = degenerate(24, 19);
        case.fit.solver = solver;
        let far = farthest(&case.regress(), &case.oracle());
        assert!(far < 2e-6, "{solver:?}: {far}");
        // The same without them.
        let mut fewer = case.clone();
        fewer.features.truncate(2);
        let differences = case.regress().concat().into_iter().zip(fewer.regress().concat());
        let worst = differences.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst < 2e-6, "{solver:?}: {worst}");
    }
}

#[test]
fn rounding_of_a_constant_feature_is_not_fitted() {
    let mut case = Case::random(40, 12, 3);
    case.fit.solver = Solver::MinimalNorm;
    // Far away it says something: here it is noise in units of a thousandth of that.
    let mut u = Random(5);
    case.features[2] = (0..480).map(|p| if p % 40 == 39 { 1.0 } else { 1e-8 * u.uniform() }).collect();
    let mut fewer = case.clone();
    fewer.features.truncate(2);
    let (with, without) = (case.regress(), fewer.regress());
    for (a, b) in with.iter().zip(&without) {
        // Windows of windows that do not reach the last column.
        let near = (0..480).filter(|p| p % 40 < 21).map(|p| (a[p] - b[p]).abs()).fold(0.0, f32::max);
        assert!(near < 1e-6, "{near}");
    }
    assert_ne!(with, without);
}
