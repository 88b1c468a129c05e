//! The twin in `f64` is the oracle.

use super::*;

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
