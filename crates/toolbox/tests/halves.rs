//! Variances from halves, and box means, against obvious loops.

use noisefloor_frame::{Image, Samples};
use noisefloor_stats::random::Normals;
use noisefloor_toolbox::{box_mean, scaled_sample_variance, smoothed_half_variance};

fn mean(image: &Image) -> f64 {
    image.data().iter().copied().map(f64::from).sum::<f64>() / image.data().len() as f64
}

#[test]
fn half_differences_average_to_the_variance_and_scaling_ignores_the_scale_of_samples() {
    let (w, h) = (64, 48);
    // Their mean has the standard deviation 0.2.
    let mut normals = Normals::new(5);
    let mut half =
        || Image::from_fn(w, h, 1, |_, _, _| 0.5 + 0.2 * std::f32::consts::SQRT_2 * normals.next() as f32);
    let halves = [half(), half()];
    let samples = Samples::uniform(16);
    let smooth = smoothed_half_variance(&halves, &samples, f32::MAX);
    let average = mean(&smooth);
    // A squared normal number has relative variance 2; smoothing mixes 9 pixels and the border a few more.
    let error = 0.04 * (2.0f64 / (w * h) as f64).sqrt();
    assert!((average - 0.04).abs() < 4.0 * error, "{average}");

    let mut normals = Normals::new(6);
    let sample = Image::from_fn(w, h, 1, |_, _, _| 0.03 + 0.02 * normals.uniform() as f32);
    let scaled = scaled_sample_variance(&sample, &halves, &samples, f32::MAX);
    let average = mean(&scaled);
    assert!((average - 0.04).abs() < 4.0 * error, "{average}");
    // 10⁻¹⁰ beside 10⁻² is what the guard changes.
    for factor in [0.1, 100.0] {
        let again = scaled_sample_variance(&sample.map(|v| factor * v), &halves, &samples, f32::MAX);
        for (a, b) in scaled.data().iter().zip(again.data()) {
            assert!((a / b - 1.0).abs() < 1e-6);
        }
    }
}

#[test]
fn a_variance_that_is_no_number_is_none_and_tells_nothing_of_its_neighbours() {
    let (w, h) = (40, 30);
    let mut normals = Normals::new(7);
    let mut half = || Image::from_fn(w, h, 1, |_, _, _| normals.next() as f32);
    let halves = [half(), half()];
    let mut sample = Image::from_fn(w, h, 1, |_, x, _| 0.1 + 0.01 * x as f32);
    let whole = scaled_sample_variance(&sample, &halves, &Samples::uniform(8), f32::MAX);
    sample.set(0, 20, 15, f32::NAN);
    let spoilt = scaled_sample_variance(&sample, &halves, &Samples::uniform(8), f32::MAX);
    for (p, (a, b)) in whole.data().iter().zip(spoilt.data()).enumerate() {
        // The mean of the box without one of its 441 values, all of which are within a factor of two of it.
        let same = (b / a - 1.0).abs() < 1.0 / 300.0;
        assert_eq!(b.is_nan(), p == 15 * w + 20);
        assert!(b.is_nan() || same, "{p}: {a}, {b}");
    }
    let nothing = Image::filled(w, h, 1, f32::NAN);
    let none = scaled_sample_variance(&nothing, &halves, &Samples::uniform(8), f32::MAX);
    assert!(none.data().iter().all(|v| v.is_nan()));
}

#[test]
fn unequal_halves_count_by_their_samples() {
    let halves = [Image::filled(5, 4, 1, 3.0), Image::filled(5, 4, 1, 1.0)];
    for (n, a) in [(16u32, 8u32), (7, 4), (3, 2), (2, 1)] {
        let variance = smoothed_half_variance(&halves, &Samples::uniform(n), f32::MAX);
        let expected = 4.0 * f64::from(a) * f64::from(n - a) / f64::from(n * n);
        assert!(variance.data().iter().all(|v| (f64::from(*v) - expected).abs() < 1e-6), "{n}");
    }
}

#[test]
fn box_means_are_those_of_a_loop_and_forget_what_left_the_box() {
    let mut normals = Normals::new(8);
    for (w, h) in [(1, 1), (1, 30), (30, 1), (22, 21), (43, 17)] {
        let values: Vec<f64> = (0..w * h).map(|_| normals.uniform()).collect();
        for radius in [0, 1, 10] {
            let means = box_mean(&values, w, radius);
            for (p, mean) in means.iter().enumerate() {
                let (x, y) = (p % w, p / w);
                let mut sum = (0.0, 0.0);
                for (q, value) in values.iter().enumerate() {
                    if (q % w).abs_diff(x) <= radius && (q / w).abs_diff(y) <= radius {
                        sum = (sum.0 + value, sum.1 + 1.0);
                    }
                }
                assert!((mean - sum.0 / sum.1).abs() < 1e-12, "{w}×{h}, {radius}");
            }
        }
    }
    let mut row = vec![1e-9; 100];
    let clean = box_mean(&row, 100, 10);
    row[30] = 1e20;
    let spoilt = box_mean(&row, 100, 10);
    assert!((0..100usize).filter(|x| x.abs_diff(30) > 10).all(|x| clean[x] == spoilt[x]));
}
