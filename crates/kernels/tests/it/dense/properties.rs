//! What follows from the formulas.

use super::*;

/// Affine in position and features.
fn affine(case: &Case) -> [Vec<f32>; 3] {
    let width = case.fit.weighting.width;
    [0, 1, 2].map(|c| {
        (0..width * case.fit.weighting.height)
            .map(|p| {
                let (x, y) = ((p % width) as f32, (p / width) as f32);
                let features: f32 =
                    case.features.iter().zip([0.5, -0.25, 1.0, 0.125]).map(|(f, k)| k * f[p]).sum();
                0.5 + 0.25 * c as f32 + 0.0625 * x - 0.03125 * y + features
            })
            .collect()
    })
}

#[test]
fn colours_affine_in_position_and_features_come_out_as_they_are() {
    for solver in [Solver::Dropped, Solver::MinimalNorm] {
        let mut case = Case::random(21, 18, 4);
        // Features in steps of 2^-8: the colours are exact.
        case.features.iter_mut().flatten().for_each(|v| *v = (*v * 256.0).floor() / 256.0);
        case.fit.solver = solver;
        case.image = affine(&case);
        let exact =
            case.image.each_ref().map(|plane| plane.iter().copied().map(f64::from).collect::<Vec<_>>());
        let of_oracle = case
            .oracle()
            .iter()
            .flatten()
            .zip(exact.iter().flatten())
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(of_oracle < 1e-9, "{solver:?}: {of_oracle}");
        // Values of up to 3 in f32, and sums of predictions and weights in f32.
        let of_fast = farthest(&case.regress(), &exact);
        assert!(of_fast < 1e-6, "{solver:?}: {of_fast}");
    }
}

#[test]
fn predictions_of_a_constant_are_that_whatever_the_features() {
    for solver in [Solver::Dropped, Solver::MinimalNorm] {
        let mut case = Case::random(20, 20, 5);
        case.fit.solver = solver;
        case.features[3] = case.features[0].iter().map(|v| 1.0 - v).collect();
        case.image = [0.5, 1.0, 2.0].map(|v| vec![v; 400]);
        for (plane, expected) in case.regress().iter().zip([0.5, 1.0, 2.0]) {
            assert!(plane.iter().all(|v| (v - expected).abs() < 1e-6), "{solver:?}");
        }
    }
}

#[test]
fn without_damping_the_result_is_the_mean_of_plane_fits() {
    let (width, height) = (23, 17);
    let mut case = Case::random(width, height, 1);
    case.features[0].fill(0.5);
    case.guide.iter_mut().for_each(|[_, variance]| variance.fill(1.0));
    case.fit.weighting.k = 1000.0;
    let (mut sums, mut counts) = (vec![0.0; width * height], vec![0.0; width * height]);
    for p in 0..width * height {
        let (x, y) = (p % width, p / width);
        let window: Vec<(f64, f64, usize)> = (y.saturating_sub(9)..(y + 10).min(height))
            .flat_map(|v| {
                (x.saturating_sub(9)..(x + 10).min(width)).map(move |u| (u as f64, v as f64, v * width + u))
            })
            .collect();
        // A rectangle: x and y are apart, so each slope is its own.
        let n = window.len() as f64;
        let mean = |f: &dyn Fn(&(f64, f64, usize)) -> f64| window.iter().map(f).sum::<f64>() / n;
        let value = |q: usize| f64::from(case.image[1][q]);
        let (mx, my, mv) = (mean(&|q| q.0), mean(&|q| q.1), mean(&|q| value(q.2)));
        let slope_x = mean(&|q| (q.0 - mx) * value(q.2)) / mean(&|q| (q.0 - mx).powi(2));
        let slope_y = mean(&|q| (q.1 - my) * value(q.2)) / mean(&|q| (q.1 - my).powi(2));
        for (u, v, q) in &window {
            sums[*q] += mv + slope_x * (u - mx) + slope_y * (v - my);
            counts[*q] += 1.0;
        }
    }
    let expected: Vec<f64> = sums.iter().zip(&counts).map(|(sum, count)| sum / count).collect();
    // Weights of at least e^-1e-6.
    let far = far(&case.regress()[1], &expected);
    assert!(far < 5e-6, "{far}");
}

#[test]
fn a_model_takes_the_weight_of_the_channel_that_differs() {
    let mut case = Case::random(26, 20, 3);
    for c in [0, 2] {
        case.guide[c][0].fill(0.5);
    }
    let alone = Case { guide: vec![case.guide[1].clone()], ..case.clone() };
    assert_eq!(case.regress(), alone.regress());
    // The mean of distances is another matter.
    let mean = Case { fit: Fit { join: Join::Mean, ..case.fit }, ..case.clone() };
    assert_ne!(mean.regress(), alone.regress());
}

#[test]
fn a_scale_of_two_is_variances_twice_as_large() {
    let mut twice = Case::random(20, 20, 3);
    let case = twice.clone();
    twice.fit.weighting.scale = 1.0;
    twice.guide.iter_mut().for_each(|[_, variance]| variance.iter_mut().for_each(|v| *v *= 2.0));
    assert_eq!(case.regress(), twice.regress());
}

#[test]
fn units_of_features_do_not_matter_to_the_least_norm_and_little_to_pivots() {
    let case = Case::random(22, 20, 3);
    for (solver, factors) in [
        (Solver::MinimalNorm, vec![1e-6, 1e6]),
        // Beyond these a column counts as none beside positions of up to 9.
        (Solver::Dropped, vec![1e-3, 1e3]),
    ] {
        let base = Case { fit: Fit { solver, ..case.fit }, ..case.clone() };
        for factor in factors {
            let mut scaled = base.clone();
            scaled.features.iter_mut().flatten().for_each(|v| *v *= factor);
            let worst = base
                .regress()
                .concat()
                .iter()
                .zip(scaled.regress().concat())
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f32::max);
            assert!(worst < 2e-6, "{solver:?}, {factor}: {worst}");
        }
    }
}

#[test]
fn an_unknown_variance_keeps_its_patch_apart() {
    let mut case = Case::random(24, 20, 3);
    case.guide.iter_mut().for_each(|[_, variance]| variance[9 * 24 + 11] = f32::NAN);
    let expected = case.oracle();
    let regressed = case.regress();
    assert!(farthest(&regressed, &expected) < 2e-6);
    for (plane, image) in regressed.iter().zip(&case.image) {
        for (y, x) in (6..=12).flat_map(|y| (8..=14).map(move |x| (y, x))) {
            assert!((plane[y * 24 + x] - image[y * 24 + x]).abs() < 1e-6, "{x}, {y}");
        }
    }
}

#[test]
fn an_unknown_variance_beside_the_border_is_nothing_to_what_is_beyond_it() {
    for place in [2 * 24 + 2, 0, 10 * 24 + 23] {
        let mut case = Case::random(24, 20, 3);
        case.guide.iter_mut().for_each(|[_, variance]| variance[place] = f32::NAN);
        assert!(farthest(&case.regress(), &case.oracle()) < 2e-6, "{place}");
    }
}

#[test]
fn what_is_out_of_range_is_refused() {
    let case = Case::random(5, 4, 2);
    let refused = |change: &dyn Fn(&mut Case)| {
        let mut other = case.clone();
        change(&mut other);
        regress(&other.fit, &other.planes()).unwrap_err().to_string()
    };
    assert_eq!(refused(&|c| c.fit.weighting.k = 0.0), "k = 0: allowed 0.001 to 1000");
    assert_eq!(refused(&|c| c.fit.weighting.window = 17), "window radius = 17: allowed 0 to 16");
    assert_eq!(refused(&|c| c.guide.clear()), "guide channels = 0: allowed 1 to 32");
    assert!(refused(&|c| c.image[1][7] = f32::NAN).starts_with("plane `image` holds NaN at pixel (2, 1)"));
    assert!(refused(&|c| c.guide[0][1][3] = -1.0).starts_with("plane `variance` holds -1 at pixel (3, 0)"));
    assert_eq!(
        refused(&|c| c.features[1].truncate(3)),
        "plane `feature` holds 3 values, the image has 20 pixels"
    );
}
