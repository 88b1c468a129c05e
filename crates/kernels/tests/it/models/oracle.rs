//! The fast form against a hat matrix.

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::regression::models::{Area, Distances, Start, Window, naive::Twin};

use super::Case;

/// Largest difference of two columns over the pixels that the window kept.
fn off(fast: &[f32], center: f32, slow: &[f64], kept: &[usize]) -> f64 {
    fast.iter()
        .zip(kept)
        .map(|(a, j)| (f64::from(*a) + f64::from(center) - slow[*j]).abs())
        .fold(0.0, f64::max)
}

#[test]
fn weights_fits_biases_and_variances_are_those_of_the_hat_matrix() {
    for (width, height, center, radius) in [
        (40, 30, (20, 15), 10),
        (40, 30, (0, 29), 5),
        (9, 1, (4, 0), 15),
        (1, 1, (0, 0), 5),
        (33, 12, (30, 3), 15),
    ] {
        for ridge in [1e-3, 0.1, 0.0] {
            let mut case = Case::new(width, height, 21);
            case.rules.ridge = ridge;
            let field = case.field();
            let mut window = Window::new(&field, radius);
            let level = InstructionSet::in_use();
            window.open(&field, center, radius, &Distances::default(), level);
            let m = window.center();
            for (k, bandwidth) in case.rules.bandwidths.iter().enumerate() {
                let twin =
                    Twin::new(case.size, &case.planes(), &case.rules, center, radius, f64::from(*bandwidth));
                let of = |plane: &[f32]| twin.pixels.iter().map(|p| f64::from(plane[*p])).collect::<Vec<_>>();
                let kept: Vec<usize> = window
                    .pixels(k)
                    .iter()
                    .map(|p| twin.pixels.iter().position(|q| *q == *p as usize).unwrap())
                    .collect();
                window.weigh(&field, k, level);
                // e^x is right to 3e-7 times 1 + |x|, and |x| is at most 14.
                assert!(off(window.weights(k), 0.0, &twin.weights, &kept) < 5e-6);
                let weighed: f64 = twin.weights.iter().sum();
                assert!((window.weight_sum(k) - weighed).abs() < 1e-5 * weighed);

                // Two steps, the second from images that the first one's tests made.
                let mut value = [0, 1, 2].map(|c| of(&case.guide[c]));
                let mut variance = of(&case.variance);
                for t in 0..2 {
                    let start = if t == 0 { Start::First } else { Start::Own };
                    let sum = window.step(&field, k, start, level);
                    let next = value.each_ref().map(|y| twin.times(y));
                    let spread = twin.variance(&variance);
                    let importance = of(&case.importance);
                    let mut expected = 0.0;
                    for j in 0..twin.pixels.len() {
                        let bias: f64 = (0..3).map(|c| (next[c][j] - value[c][j]).powi(2)).sum();
                        expected += twin.weights[j] * importance[j] * (bias / 3.0 + spread[j]);
                    }
                    for ((got, next), m) in window.value(k).iter().zip(&next).zip(m) {
                        assert!(off(got, m, next, &kept) < 1e-4, "step {t}");
                    }
                    // Variances are at most 0.05.
                    assert!(off(window.variance(k), 0.0, &spread, &kept) < 1e-5, "step {t}");
                    assert!((sum - expected).abs() < 1e-4 * expected + 1e-9, "step {t}: {sum}, {expected}");
                    (value, variance) = (next, spread);
                }
                window.fit(&field, k, false, level);
                for (c, m) in m.into_iter().enumerate() {
                    let (u, g) = (twin.times(&of(&case.target[c])), twin.times(&of(&case.guide[c])));
                    assert!(off(window.fitted()[c], m, &u, &kept) < 1e-4);
                    assert!(off(window.refitted()[c], m, &g, &kept) < 1e-4);
                }
                window.fit(&field, k, true, level);
                assert_eq!(window.fitted(), window.refitted());
            }
        }
    }
}

#[test]
fn a_step_from_images_is_a_step_from_the_same_values_in_the_window() {
    let case = Case::new(30, 25, 22);
    let field = case.field();
    let level = InstructionSet::in_use();
    let run = |start: Start<'_>| {
        let mut window = Window::new(&field, 8);
        window.open(&field, (12, 9), 8, &Distances::default(), level);
        window.weigh(&field, 1, level);
        let sum = window.step(&field, 1, start, level);
        (sum, window.value(1).map(<[f32]>::to_vec), window.variance(1).to_vec(), window.error(1).to_vec())
    };
    let value = case.guide.each_ref().map(Vec::as_slice);
    assert_eq!(run(Start::First), run(Start::Images { value, variance: &case.variance }));
}

#[test]
fn distances_that_are_kept_are_those_from_the_centre() {
    for (width, height) in [(50, 40), (9, 50), (31, 3), (1, 1)] {
        for patch_radius in 0..=3 {
            let mut case = Case::new(width, height, 23);
            case.rules.patch_radius = patch_radius;
            case.rules.least_weight = 0.0;
            let field = case.field();
            let level = InstructionSet::in_use();
            let (mut kept, mut window) = (Distances::default(), Window::new(&field, 6));
            let area =
                Area { x: width / 3, y: height / 3, width: width.div_ceil(2), height: height.div_ceil(2) };
            kept.fill(&field, area, 6, level);
            for y in area.y..area.y + area.height {
                for x in area.x..area.x + area.width {
                    for radius in [3, 6] {
                        assert!(kept.holds((x, y), radius));
                        let mut run = |known: &Distances| {
                            window.open(&field, (x, y), radius, known, level);
                            window.weigh(&field, 0, level);
                            (window.pixels(0).to_vec(), window.weights(0).to_vec())
                        };
                        assert!(run(&kept) == run(&Distances::default()), "({x}, {y})");
                    }
                }
            }
            assert!(!kept.holds((area.x, area.y), 7) && !kept.holds((area.x + area.width, area.y), 3));
            kept.clear();
            assert!(!kept.holds((area.x, area.y), 3));
        }
    }
}
