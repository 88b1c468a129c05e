//! What the formula says without any oracle.

use super::*;

#[test]
fn constants_stay_constant() {
    let mut case = Case::random(40, 20, 5, &candidates(true), &[3]).with_step(Rule::Exact);
    case.frame.targets = vec![vec![3.7; 800], vec![0.0; 800]];
    for filtered in case.fast() {
        assert!(filtered.planes[0].iter().all(|v| (v / 3.7 - 1.0).abs() < 1e-6));
        assert!(filtered.planes[1].iter().all(|v| *v == 0.0));
    }
}

#[test]
fn without_patch_and_features_it_is_the_clipped_box_mean() {
    let (w, h, r) = (20, 9, 3);
    let case = Case::random(w, h, r, &[pass(None, 1.0)], &[]);
    let filtered = &case.fast()[0];
    for (y, x) in (0..h).flat_map(|y| (0..w).map(move |x| (y, x))) {
        let rows = y.saturating_sub(r)..(y + r + 1).min(h);
        let columns = x.saturating_sub(r)..(x + r + 1).min(w);
        let window = rows.flat_map(|j| columns.clone().map(move |i| (j, i)));
        let values: Vec<f64> = window.map(|(j, i)| f64::from(case.frame.targets[0][j * w + i])).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        assert!((f64::from(filtered.planes[0][y * w + x]) - mean).abs() < 1e-6);
        assert_eq!(filtered.weight_sum[y * w + x], values.len() as f32);
    }
}

#[test]
fn a_patch_of_none_ignores_the_guide() {
    let case = Case::random(30, 12, 4, &[pass(None, 1e-3)], &[1]);
    let mut other = case.clone();
    other.frame.guide = Owned::random(&mut Random(99), 360, 3, &[], 0).guide;
    assert_eq!(case.fast(), other.fast());
    // And a guide with a patch does not.
    let with = |c: &Case| Case { passes: vec![pass(Some(1), 1e-3)], ..c.clone() }.fast();
    assert_ne!(with(&case), with(&other));
}

#[test]
fn the_order_of_features_changes_nothing() {
    let case = Case::random(30, 12, 4, &candidates(true), &[3, 1, 2]).with_step(Rule::Exact);
    let mut other = case.clone();
    other.frame.features.rotate_left(1);
    assert_eq!(case.fast(), other.fast());
}

#[test]
fn weights_lie_between_zero_and_one() {
    // Filtering an indicator of one pixel with a known weight sum gives that pixel's weight at every other.
    let (w, h) = (15, 11);
    let mut case = Case::random(w, h, 10, &candidates(false), &[2]);
    // Variances far above the differences: every distance is negative before it is clamped.
    case.frame.guide.iter_mut().for_each(|[_, variance]| variance.fill(100.0));
    case.frame.features.iter_mut().flatten().for_each(|[_, variance, spread]| {
        variance.fill(50.0);
        spread.fill(50.0);
    });
    for p in [0, 37, w * h - 1] {
        case.frame.targets = vec![vec![0.0; w * h]];
        case.frame.targets[0][p] = 1.0;
        for filtered in case.fast() {
            for q in 0..w * h {
                let weight = filtered.planes[0][q] * filtered.weight_sum[q];
                assert!((0.0..=1.0 + 1e-5).contains(&weight), "{weight}");
            }
            assert_eq!(filtered.center_share[p], 1.0 / filtered.weight_sum[p]);
        }
    }
}

#[test]
fn a_feature_step_lets_nothing_across_and_a_ramp_little() {
    let (w, h) = (24, 5);
    let flat = vec![0.0; w * h];
    let feature = |value: Vec<f32>, spread: Vec<f32>| vec![vec![[value, vec![0.0; w * h], spread]]];
    let mut case = Case::random(w, h, 10, &[pass(None, 1e-3)], &[]);
    case.frame.features = feature((0..w * h).map(|i| f32::from(i % w >= 12)).collect(), flat.clone());
    case.frame.targets = vec![(0..w * h).map(|i| if i % w >= 12 { 1e6 } else { 0.0 }).collect()];
    let filtered = &case.fast()[0].planes[0];
    assert!((0..w * h).all(|i| filtered[i] == if i % w >= 12 { 1e6 } else { 0.0 }));
    // A slope g has |Grad|² = (g/2)², so the next pixel's weight is exp(−4/0.36).
    let slope = 0.5f32;
    let ramp = (0..w * h).map(|i| slope * (i % w) as f32).collect();
    case.frame.features = feature(ramp, vec![slope * slope / 4.0; w * h]);
    case.frame.targets = vec![(0..w * h).map(|i| f32::from(i % w == 12)).collect()];
    let filtered = &case.fast()[0];
    let i = 2 * w + 11;
    let weights = f64::from(filtered.planes[0][i] * filtered.weight_sum[i]);
    assert!((weights / (5.0 * (-4.0f64 / 0.36).exp()) - 1.0).abs() < 1e-4, "{weights}");
}

#[test]
fn without_noise_only_equal_pixels_count() {
    let mut case = Case::random(30, 12, 10, &candidates(true)[..2], &[]).with_step(Rule::Exact);
    case.frame.guide.iter_mut().for_each(|[_, variance]| variance.fill(0.0));
    case.frame.targets = vec![case.frame.guide[0][0].clone()];
    for filtered in case.fast() {
        assert_eq!(filtered.planes[0], case.frame.targets[0]);
        assert!(filtered.weight_sum.iter().all(|w| *w == 1.0));
    }
}

#[test]
fn identical_neighbouring_frames_double_every_weight_but_the_centre() {
    let mut case = Case::random(30, 12, 4, &candidates(false), &[1]);
    let alone = case.fast();
    case.neighbors = vec![case.frame.clone()];
    for (one, two) in alone.iter().zip(case.fast()) {
        for (a, b) in one.weight_sum.iter().zip(two.weight_sum) {
            // The pixel's own weight of 1 counts once in each frame.
            assert!((2.0 * a / b - 1.0).abs() < 1e-6);
        }
        for (a, b) in one.planes[1].iter().zip(&two.planes[1]) {
            assert!((a - b).abs() < 1e-6);
        }
    }
}
