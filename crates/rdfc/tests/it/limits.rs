//! Limiting cases.

use noisefloor_conformance::known::{self, frame, ramp, step};
use noisefloor_conformance::outputs::{diagnose, diagnostic, largest_difference, run};
use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_frame::{FeatureId, Frame, Image, Sampling};
use noisefloor_rdfc::{Choice, Gradient, Params, Rdfc};

use crate::common::{methods, profiles};

/// A frame without any noise, whose sample variance is scaled to that of its halves: 0 to 0.
fn exact(truth: &Image) -> Frame {
    Frame { sampling: Sampling::LowDiscrepancy, ..known::exact(truth) }
}

#[test]
fn without_noise_the_input_comes_back_in_either_profile() {
    let truth = step(30, 22);
    let mut still = exact(&truth);
    still.features.insert(FeatureId::Albedo, exact(&Image::filled(30, 22, 3, 0.5)).color);
    for profile in profiles() {
        for params in [profile.clone(), Params { features: vec![], ..profile }] {
            for method in [
                Rdfc::new(params.clone()).unwrap(),
                Rdfc::candidate(Choice::First, params.clone()).unwrap(),
                Rdfc::candidate(Choice::Second, params.clone()).unwrap(),
            ] {
                let off = largest_difference(&run(&method, &still).image, &truth);
                assert!(off < 1e-5 * 0.7, "{}: {off}", method.card().id);
            }
            // Features alone do not see the picture.
            let third = Rdfc::candidate(Choice::Third, params).unwrap();
            assert!(largest_difference(&run(&third, &still).image, &truth) > 0.05);
        }
    }
}

#[test]
fn constants_stay_constant() {
    let flat = Image::filled(25, 18, 3, 3.7);
    for params in profiles() {
        for method in methods(&params) {
            let off = largest_difference(&run(&method, &exact(&flat)).image, &flat);
            assert!(off < 1e-6 * 3.7 * 4.0, "{off}");
        }
    }
}

#[test]
fn a_black_image_stays_black() {
    let black = Image::new(25, 18, 3);
    let mut frame = exact(&black);
    frame.features.insert(FeatureId::Depth, exact(&Image::new(25, 18, 1)).color);
    for params in profiles() {
        for method in methods(&params) {
            let output = run(&method, &frame);
            assert!(output.image.data().iter().all(|v| *v == 0.0));
            assert!(output.error_estimate.unwrap().data().iter().all(|v| v.is_finite()));
            let density = method.adaptive().unwrap().density(&Input::new(&frame)).unwrap();
            assert!(density.data().iter().all(|v| *v == 0.0));
        }
    }
}

#[test]
fn features_alone_without_any_are_a_clipped_box_mean() {
    let noisy = frame(&ramp(20, 14), 0.1, 1);
    let params = Params { features: vec![], window_radius_px: 2, ..Params::default() };
    let image = run(&Rdfc::candidate(Choice::Third, params).unwrap(), &noisy).image;
    for (x, y) in [(0, 0), (10, 7), (19, 3)] {
        let columns = usize::saturating_sub(x, 2)..(x + 3).min(20);
        let rows = usize::saturating_sub(y, 2)..(y + 3).min(14);
        let values: Vec<f64> = rows
            .flat_map(|j| columns.clone().map(move |i| (i, j)))
            .map(|(i, j)| f64::from(noisy.color.mean.get(1, i, j)))
            .collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        assert!((f64::from(image.get(1, x, y)) - mean).abs() < 1e-6);
    }
}

#[test]
fn a_feature_step_lets_nothing_across() {
    let truth = Image::filled(24, 16, 3, 0.5);
    let mut noisy = frame(&truth, 0.1, 2);
    let side = Image::from_fn(24, 16, 1, |_, x, _| f32::from(x >= 12));
    noisy.features.clear();
    let known = FeatureId::Extra("side".into());
    noisy.features.insert(known, exact(&side).color);
    // The smaller of both one-sided slopes is 0 on either side of a step.
    let gradient = Some(Gradient::MinHalf);
    let params = Params { features: vec!["side".into()], gradient, ..Params::default() };
    let third = Rdfc::candidate(Choice::Third, params).unwrap();
    let before = run(&third, &noisy).image;
    let mut other = noisy.clone();
    for half in other.color.halves.iter_mut().flatten().chain([&mut other.color.mean]) {
        for (c, x, y) in (0..3).flat_map(|c| (12..24).flat_map(move |x| (0..16).map(move |y| (c, x, y)))) {
            half.set(c, x, y, 100.0);
        }
    }
    let after = run(&third, &other).image;
    assert!((0..3).all(|c| (0..16).all(|y| (0..12).all(|x| before.get(c, x, y) == after.get(c, x, y)))));
    assert!((12..24).all(|x| (after.get(0, x, 5) - 100.0).abs() < 1e-3));
}

#[test]
fn the_first_pass_lies_between_its_candidates_with_weights_that_sum_to_one() {
    for params in profiles() {
        let output = diagnose(&Rdfc::new(params).unwrap(), &frame(&step(40, 30), 0.1, 3));
        let (weights, binary) = (diagnostic(&output, "selection"), diagnostic(&output, "selection, binary"));
        let candidates = ["FIRST", "SECOND", "THIRD"].map(|n| diagnostic(&output, &format!("candidate {n}")));
        let pass = diagnostic(&output, "first pass");
        for p in 0..weights.pixels() {
            let of = |image: &Image| [0, 1, 2].map(|k| image.plane(k)[p]);
            assert!(of(weights).iter().all(|w| (0.0..=1.0).contains(w)));
            assert!((of(weights).iter().sum::<f32>() - 1.0).abs() < 1e-6);
            let mut chosen = of(binary);
            chosen.sort_by(f32::total_cmp);
            assert_eq!(chosen, [0.0, 0.0, 1.0]);
            for c in 0..3 {
                let values = candidates.map(|image| image.plane(c)[p]);
                let (low, high) =
                    values.iter().fold((f32::MAX, f32::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
                assert!((low - 1e-6..=high + 1e-6).contains(&pass.plane(c)[p]));
            }
        }
        // All three have a say somewhere, or the test says little.
        assert!((0..3).all(|k| binary.plane(k).contains(&1.0)));
        let shares: f64 =
            output.figures.iter().filter(|f| f.name.starts_with("share")).map(|f| f.value).sum();
        assert!((shares - 1.0).abs() < 1e-6);
    }
}
