//! Noise of known law.

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::regression::models::{Distances, Start, Window};

use super::Case;
use crate::random::Random;

/// Replicates; a variance from them has a relative standard deviation of √(2/1500) = 3.7 %.
const REPLICATES: usize = 1500;

#[test]
fn the_variance_of_a_model_with_fixed_weights_is_that_of_its_replicates() {
    // The guide, and with it all weights, stays; the target is noise of the stated variance around a slope.
    let mut case = Case::new(24, 20, 41);
    let truth: [Vec<f32>; 3] = case.target.clone();
    let (level, k) = (InstructionSet::in_use(), 1);
    let mut random = Random(42);
    let mut sums: Vec<[f64; 2]> = Vec::new();
    for _ in 0..REPLICATES {
        for (plane, truth) in case.target.iter_mut().zip(&truth) {
            for ((value, truth), variance) in plane.iter_mut().zip(truth).zip(&case.variance) {
                *value = truth + variance.sqrt() * random.normal();
            }
        }
        let field = case.field();
        let mut window = Window::new(&field, 6);
        window.open(&field, (11, 10), 6, &Distances::default(), level);
        window.weigh(&field, k, level);
        window.fit(&field, k, false, level);
        let fitted = window.fitted();
        sums.resize(fitted[0].len(), [0.0; 2]);
        for (sums, value) in sums.iter_mut().zip(fitted[0]) {
            let value = f64::from(*value);
            sums[0] += value;
            sums[1] += value * value;
        }
    }
    let field = case.field();
    let mut window = Window::new(&field, 6);
    window.open(&field, (11, 10), 6, &Distances::default(), level);
    window.weigh(&field, k, level);
    window.step(&field, k, Start::First, level);
    let n = REPLICATES as f64;
    let (mut told, mut found) = (0.0, 0.0);
    for ((sums, variance), weight) in sums.iter().zip(window.variance(k)).zip(window.weights(k)) {
        // Pixels that hardly weigh are extrapolated, and would rule the sum.
        if *weight > 0.1 {
            let mean = sums[0] / n;
            let spread = (sums[1] / n - mean * mean) * n / (n - 1.0);
            // Each for itself: five standard deviations.
            assert!((spread / f64::from(*variance) - 1.0).abs() < 0.185, "{spread}, {variance}");
            told += f64::from(*variance);
            found += spread;
        }
    }
    // Together: fitted values share their noise, so that a sum is hardly surer than one of them.
    assert!((found / told - 1.0).abs() < 0.11, "{found}, {told}");
}
