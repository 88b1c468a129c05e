//! What must change nothing, or does what it says.

use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_frame::{Estimate, FeatureId, Frame, Image, Samples, Sampling};
use noisefloor_rdfc::{
    CenterWeight, Choice, DerivativeRule, FeatureDenominator, Params, Profile, Rdfc, SecondPass, Ties,
};

use crate::common::{Normals, authors, estimate, frame, methods, ramp, run, step};

#[test]
fn the_order_of_features_and_those_that_are_missing_change_nothing() {
    let noisy = frame(&step(30, 22), 0.1, 4);
    let with = |names: &[&str]| {
        let features = names.iter().map(|n| (*n).to_owned()).collect();
        run(&Rdfc::new(Params { features, ..Params::default() }).unwrap(), &noisy)
    };
    let all = with(&["albedo", "normal", "depth"]).image;
    assert_eq!(all, with(&["depth", "albedo", "normal"]).image);
    assert_eq!(all, with(&["visibility", "albedo", "normal", "albedo", "depth"]).image);
    assert_eq!(all, run(&Rdfc::default(), &noisy).image);
    assert_ne!(all, with(&["albedo", "normal"]).image);
    assert_ne!(all, with(&[]).image);
}

#[test]
fn features_may_be_extra_ones_or_lack_halves_and_variance() {
    let mut noisy = frame(&step(30, 22), 0.1, 4);
    let before = run(&Rdfc::default(), &noisy).image;
    let shadow = Image::from_fn(30, 22, 1, |_, x, _| f32::from(x > 20));
    let id = FeatureId::Extra("shadow".into());
    noisy.features.insert(id.clone(), estimate(&shadow, 0.05, &mut Normals::new(9)));
    assert_eq!(run(&Rdfc::default(), &noisy).image, before);
    let params = Params { features: vec!["albedo".into(), "shadow".into()], ..Params::default() };
    let method = Rdfc::new(params).unwrap();
    let whole = run(&method, &noisy).image;
    assert_ne!(whole, before);
    let feature = noisy.features.get_mut(&id).unwrap();
    feature.halves = None;
    let without_halves = run(&method, &noisy).image;
    *noisy.features.get_mut(&id).unwrap() = Estimate::from_mean(shadow);
    let exact = run(&method, &noisy).image;
    assert!(whole != without_halves && without_halves != exact);
    assert!(exact.data().iter().all(|v| v.is_finite()));
}

#[test]
fn choices_that_are_left_open_are_those_of_the_profile() {
    let noisy = frame(&step(30, 22), 0.1, 5);
    let told = |profile, denominator, center, derivative, ties, pass, patch| Params {
        profile,
        feature_denominator: Some(denominator),
        center_weight: Some(center),
        derivative: Some(derivative),
        ties: Some(ties),
        second_pass: Some(pass),
        map_patch_radius_px: Some(patch),
        ..Params::default()
    };
    let paper = told(
        Profile::Paper,
        FeatureDenominator::Centre,
        CenterWeight::One,
        DerivativeRule::Exact,
        Ties::Earlier,
        SecondPass::Text,
        1,
    );
    let program = told(
        Profile::Authors,
        FeatureDenominator::Pair,
        CenterWeight::LargestNeighbor,
        DerivativeRule::Joint,
        Ties::Later,
        SecondPass::Code,
        3,
    );
    let image = |params: &Params| run(&Rdfc::new(params.clone()).unwrap(), &noisy).image;
    assert_eq!(image(&paper), image(&Params::default()));
    assert_eq!(image(&program), image(&authors()));
    assert_ne!(image(&paper), image(&program));
    // Each choice has a say of its own.
    for single in [
        Params { feature_denominator: program.feature_denominator, ..Params::default() },
        Params { center_weight: program.center_weight, ..Params::default() },
        Params { derivative: program.derivative, ..Params::default() },
        Params { second_pass: program.second_pass, ..Params::default() },
        Params { second_pass: Some(SecondPass::Off), ..Params::default() },
        Params { map_patch_radius_px: program.map_patch_radius_px, ..Params::default() },
        Params { gradient: noisefloor_rdfc::Gradient::Off, ..Params::default() },
        Params { gradient: noisefloor_rdfc::Gradient::Central, ..Params::default() },
        Params { prefilter: false, ..Params::default() },
        Params { feature_k: 1.0, ..Params::default() },
    ] {
        assert_ne!(image(&paper), image(&single), "{single:?}");
    }
}

#[test]
fn sample_variances_are_scaled_for_low_discrepancy_frames_only() {
    let mut noisy = frame(&step(30, 22), 0.1, 6);
    let first = Rdfc::candidate(Choice::First, Params::default()).unwrap();
    let independent = run(&first, &noisy).image;
    let scaling = |variance_scaling| {
        let params = Params { variance_scaling, ..Params::default() };
        run(&Rdfc::candidate(Choice::First, params).unwrap(), &noisy).image
    };
    assert_eq!(independent, scaling(noisefloor_rdfc::VarianceScaling::Never));
    let always = scaling(noisefloor_rdfc::VarianceScaling::Always);
    assert_ne!(independent, always);
    noisy.sampling = Sampling::LowDiscrepancy;
    assert_eq!(run(&first, &noisy).image, always);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let noisy = frame(&step(70, 40), 0.1, 7);
    for params in [Params::default(), authors()] {
        for method in methods(&params) {
            let on = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let output = pool.install(|| run(&method, &noisy));
                let density =
                    pool.install(|| method.adaptive().unwrap().density(&Input::new(&noisy)).unwrap());
                let all = [output.image, output.error_estimate.unwrap(), density];
                all.iter().flat_map(|image| image.data().iter().map(|v| v.to_bits())).collect::<Vec<_>>()
            };
            let one = on(1);
            assert!(one == on(2) && one == on(5));
        }
    }
}

#[test]
fn samples_are_wanted_where_the_noise_is() {
    let truth = ramp(48, 32);
    let mut noisy = frame(&truth, 0.1, 8);
    let clean = frame(&truth, 0.001, 8);
    // The right half has a hundredth of the noise.
    let merge = |a: &mut Image, b: &Image| {
        let (w, h, channels) = (a.width(), a.height(), a.channels());
        for (c, x, y) in
            (0..channels).flat_map(|c| (w / 2..w).flat_map(move |x| (0..h).map(move |y| (c, x, y))))
        {
            a.set(c, x, y, b.get(c, x, y));
        }
    };
    merge(&mut noisy.color.mean, &clean.color.mean);
    for (a, b) in noisy.color.halves.iter_mut().flatten().zip(clean.color.halves.iter().flatten()) {
        merge(a, b);
    }
    let mut variance = noisy.color.variance.take().unwrap().into_mean_variance();
    merge(&mut variance, clean.color.variance.as_ref().unwrap().mean_variance());
    noisy.color.variance = Some(noisefloor_frame::Variance::of_mean(variance));
    for params in [Params::default(), authors()] {
        for method in methods(&params) {
            let density = method.adaptive().unwrap().density(&Input::new(&noisy)).unwrap();
            assert_eq!((density.width(), density.height(), density.channels()), (48, 32, 1));
            assert!(density.data().iter().all(|v| v.is_finite() && *v >= 0.0));
            let side = |xs: std::ops::Range<usize>| -> f64 {
                xs.flat_map(|x| (0..32).map(move |y| (x, y)))
                    .map(|(x, y)| f64::from(density.get(0, x, y)))
                    .sum()
            };
            let (noisy, clean) = (side(0..24), side(24..48));
            assert!(noisy > 3.0 * clean, "{}: {noisy} and {clean}", method.card().id);
        }
    }
    // More samples in the noisy half leave less to gain there.
    let density = |frame: &Frame| Rdfc::default().adaptive().unwrap().density(&Input::new(frame)).unwrap();
    let few = density(&noisy);
    noisy.samples = Samples::uniform(64);
    let many = density(&noisy);
    assert!(few.data().iter().zip(many.data()).all(|(a, b)| b <= a));
}

#[test]
fn results_stay_those_that_a_second_implementation_agreed_with() {
    // A second implementation, written apart from this one, agreed with it to 2e-6 in every pixel on frames like this:
    // the whole method of profile `paper`, and the candidates of both profiles. These values, of this one, pin every
    // window, patch, k and τ since.
    let truth = step(40, 30);
    let mut noisy = frame(&truth, 0.1, 21);
    noisy.sampling = Sampling::LowDiscrepancy;
    let known = [
        (Params::default(), [1.294_015_6e-4, 4.087_263_9e-4, 4.738_020_7e-4, 2.213_273_1e-4]),
        (authors(), [2.824_080_0e-4, 4.840_393_8e-4, 5.070_769_6e-4, 3.515_709_7e-4]),
    ];
    for (params, known) in known {
        let error = |method| crate::common::squared_error(&run(method, &noisy).image, &truth);
        let errors: Vec<f64> = methods(&params).iter().map(error).collect();
        for (error, known) in errors.iter().zip(known) {
            assert!((error / known - 1.0).abs() < 1e-4, "{errors:?}");
        }
    }
}
