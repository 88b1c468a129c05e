//! What the filter does with constants, edges, exposures, guides and bad input.

use super::*;

#[test]
fn constant_color_is_unchanged_under_any_flash_and_any_variance() {
    for seed in 0..3 {
        let mut f = wild_frame(seed);
        f.color.mean = Image::filled(37, 29, 3, 0.3);
        for params in steps() {
            assert_eq!(run(params, &f).image, f.color.mean);
        }
    }
}

#[test]
fn distinct_means_without_variance_are_unchanged() {
    let mut f = wild_frame(4);
    let mut k = 0.0;
    f.color.mean = image(37, 29, || {
        k += 1.0;
        k
    });
    f.color.variance = Some(Variance::of_mean(Image::new(37, 29, 3)));
    for params in steps() {
        assert_eq!(run(params, &f).image, f.color.mean);
    }
}

#[test]
fn without_test_and_edges_it_is_a_clipped_gaussian_blur() {
    let mut u = uniforms(5);
    let (w, h) = (40, 21);
    let mut f = frame(image(w, h, &mut u), image(w, h, || 0.1), 4);
    f.flash = Some(Flash::Ready(estimate(Image::filled(w, h, 3, 0.7), Image::new(w, h, 3))));
    let out = run(Params { steps: 1, homogeneous: false, ..Params::default() }, &f).image;
    let sigma = 31.0 / 3.0;
    for (c, x, y) in [(0, 0, 0), (1, 20, 10), (2, 39, 20), (0, 3, 18)] {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (qx, qy) in (0..h).flat_map(|qy| (0..w).map(move |qx| (qx, qy))) {
            let (dx, dy) = (qx.abs_diff(x), qy.abs_diff(y));
            if dx.max(dy) <= 15 {
                let weight = (-((dx * dx + dy * dy) as f64) / (2.0 * sigma * sigma)).exp();
                sum += weight * f64::from(f.color.mean.get(c, qx, qy));
                weights += weight;
            }
        }
        let (got, expected) = (f64::from(out.get(c, x, y)), sum / weights);
        assert!((got - expected).abs() < 2e-6, "channel {c} at ({x}, {y}): {got} instead of {expected}");
    }
}

#[test]
fn no_pixel_crosses_an_edge_of_twenty_standard_errors() {
    let step = |x: usize| if x < 20 { 1.0 } else { 2.0 };
    let mut u = uniforms(6);
    // Standard error 0.05; the noise is within ±1 of it, so that the step stays 18 to 22 standard errors high.
    let mean = Image::from_fn(40, 24, 3, |_, x, _| step(x) + 0.05 * (2.0 * u() - 1.0));
    let f = frame(mean, Image::filled(40, 24, 3, 0.0025), 16);
    for params in steps() {
        let out = run(Params { guide: GuideKind::None, ..params }, &f).image;
        for (y, x) in (0..24).flat_map(|y| (0..40).map(move |x| (y, x))) {
            for c in 0..3 {
                let value = out.get(c, x, y);
                assert!((value - step(x)).abs() <= 0.05, "({x}, {y}): {value}");
            }
        }
    }
}

#[test]
fn flash_edges_stop_what_the_test_lets_through() {
    // Two sides that differ by one standard error: homogeneous, but not in the flash image.
    let side = |x: usize, low: f32, high: f32| if x < 20 { low } else { high };
    let mean = Image::from_fn(40, 24, 3, |_, x, _| side(x, 1.0, 1.1));
    let mut f = frame(mean.clone(), Image::filled(40, 24, 3, 0.01), 16);
    let flash = Image::from_fn(40, 24, 3, |_, x, _| side(x, 0.2, 0.9));
    f.flash = Some(Flash::Ready(estimate(flash, Image::filled(40, 24, 3, 1e-5))));
    let with = run(Params::default(), &f).image;
    // With the input's spread in both steps; a narrower one in step 2 already keeps the sides apart.
    let without = Params { guide: GuideKind::None, second_spread: SpreadKind::Raw, ..Params::default() };
    let without = run(without, &f).image;
    // Patches that straddle the edge are unlike all others, so a pixel next to it keeps its value as well.
    for x in 0..40 {
        assert!((with.get(0, x, 12) - mean.get(0, x, 12)).abs() < 1e-3, "column {x}");
    }
    assert!((without.get(0, 19, 12) - 1.0).abs() > 0.02, "without the flash the edge is blurred");
}

#[test]
fn two_steps_leave_less_noise_than_either_alone() {
    let scene = gaussian_edge(0.8);
    let truth = scene.truth();
    let f = scene.render(16, 3);
    let error = |params| -> f64 {
        let out = run(params, &f).image;
        out.data().iter().zip(truth.mean().data()).map(|(d, m)| f64::from(d - m).powi(2)).sum()
    };
    let both = error(Params::default());
    assert!(both < error(Params { steps: 1, ..Params::default() }));
    assert!(both < error(Params::first_step_only()));
}

#[test]
fn every_spread_of_step_two_denoises_and_those_within_the_raw_one_claim_a_proven_bound() {
    let scene = gaussian_edge(0.8);
    let truth = scene.truth();
    let f = scene.render(16, 3);
    let error = |image: &Image| -> f64 {
        image.data().iter().zip(truth.mean().data()).map(|(d, m)| f64::from(d - m).powi(2)).sum()
    };
    let mut images: Vec<Image> = Vec::new();
    for second_spread in SPREADS {
        let params = Params { second_spread, ..Params::default() };
        let card = VirtualFlash::new(params.clone()).unwrap().card();
        assert_eq!(card.needs.contains(&Need::ColorHalves), second_spread == SpreadKind::Halves);
        let proven = card.claims.error_bound.iter().filter(|c| c.proven).count();
        let bounded = matches!(second_spread, SpreadKind::Least | SpreadKind::Raw);
        assert_eq!((proven, card.claims.enclosure.len()), if bounded { (1, 1) } else { (0, 0) });
        let image = run(params, &f).image;
        assert!(error(&image) < 0.5 * error(&f.color.mean), "{second_spread:?}");
        // Here, with alike noise everywhere, the propagated spread is the least.
        let others = images.iter().skip(usize::from(second_spread == SpreadKind::Propagated));
        assert!(others.into_iter().all(|other| *other != image), "{second_spread:?}");
        images.push(image);
    }
}

/// Variance of the first step's output as the second tests it.
fn second_variance(f: &Frame, params: &Params) -> Image {
    let tested = spread::tested_variance(f, params).unwrap();
    let along = spread::Along::new(f, params, Some(&tested)).unwrap();
    let step = &params.steps().unwrap()[0];
    let tolerance =
        tolerance::Tolerance::new(params, Some(tested.clone().into_owned()), &f.samples, step.level);
    let patch = noisefloor_kernels::flash_filter::PatchWeights::gaussian(2, 1.25).unwrap();
    let guides = guide::Guide::of_frames(&[f], params, &patch);
    let planes = crate::filter::planes([&f.color.mean], &guides, &[]);
    let inputs = crate::filter::inputs(&planes, 0, 0, &tolerance);
    let (_, sums) = crate::filter::step(f, step, &patch, &inputs, Some(&along)).unwrap();
    along.variance(sums.unwrap(), params.second_spread, &f.samples)
}

#[test]
fn propagated_variance_is_that_of_a_plain_mean_where_all_weights_are_one() {
    // Constant colour, no guide, a flat spatial Gaussian: the first step is the mean of 49 pixels, so its variance is v/49
    // and its half buffers' difference is that of their means.
    let (w, h) = (15, 15);
    let mut f = frame(Image::filled(w, h, 3, 1.0), Image::filled(w, h, 3, 0.49), 16);
    let mut u = uniforms(9);
    let halves = [image(w, h, &mut u), image(w, h, &mut u)];
    f.color.halves = Some(halves.clone());
    let of = |second_spread, test| {
        let flat = Params { first_sigma_ratio: 1e3, guide: GuideKind::None, ..Params::default() };
        second_variance(&f, &Params { second_spread, test, ..flat })
    };
    for test in [TestKind::Joint, TestKind::PerChannel] {
        for second_spread in [SpreadKind::Propagated, SpreadKind::Least] {
            let variance = of(second_spread, test);
            assert!((variance.get(1, 7, 7) - 0.01).abs() < 1e-6, "{}", variance.get(1, 7, 7));
            // Near the corner the window is clipped to 4×4.
            assert!((variance.get(0, 0, 0) - 0.49 / 16.0).abs() < 1e-6);
        }
        let mean = |half: &Image, c| {
            half.crop(4, 4, 7, 7).plane(c).iter().map(|&v| f64::from(v)).sum::<f64>() / 49.0
        };
        let expected = (mean(&halves[0], 2) - mean(&halves[1], 2)).powi(2) / 4.0;
        let got = f64::from(of(SpreadKind::Halves, test).get(2, 7, 7));
        assert!((got - expected).abs() < 1e-3 * expected + 1e-9, "{got} instead of {expected}");
    }
    // Luminance has one plane; with equal deviations in all channels it has the same one.
    let luminance = of(SpreadKind::Propagated, TestKind::Luminance);
    assert_eq!(luminance.channels(), 1);
    assert!((luminance.get(0, 7, 7) - 0.01).abs() < 1e-6);
}

#[test]
fn the_least_spread_is_nowhere_above_the_raw_or_the_propagated_one() {
    for seed in 0..3 {
        let f = wild_frame(seed);
        for test in [TestKind::Joint, TestKind::PerChannel, TestKind::Luminance] {
            let of =
                |second_spread| second_variance(&f, &Params { second_spread, test, ..Params::default() });
            let (least, propagated) = (of(SpreadKind::Least), of(SpreadKind::Propagated));
            let raw = spread::tested_variance(&f, &Params { test, ..Params::default() }).unwrap();
            let mut taken = [0, 0];
            for ((&least, &raw), &propagated) in least.data().iter().zip(raw.data()).zip(propagated.data()) {
                assert_eq!(least, raw.min(propagated));
                taken[usize::from(propagated < raw)] += 1;
            }
            assert!(taken.iter().all(|&n| n > 0), "both occur: {taken:?}");
        }
    }
}

#[test]
fn a_power_of_two_of_exposure_scales_the_output_exactly() {
    let f = gaussian_edge(0.8).render(16, 5);
    let k = 4096.0;
    let scaled = |e: &Estimate| Estimate {
        mean: e.mean.map(|v| v * k),
        variance: e.variance.clone().map(|v| Variance::of_mean(v.into_mean_variance().map(|v| v * k * k))),
        halves: e.halves.clone().map(|h| h.map(|h| h.map(|v| v * k))),
    };
    let mut brighter = f.clone();
    brighter.color = scaled(&f.color);
    let Some(Flash::Parts { base, light, covariance }) = &f.flash else { panic!("the scene has a flash") };
    brighter.flash = Some(Flash::Parts {
        base: scaled(base),
        light: scaled(light),
        covariance: covariance.as_ref().map(|c| c.map(|v| v * k * k)),
    });
    for second_spread in SPREADS {
        for test in [TestKind::Joint, TestKind::PerChannel, TestKind::Luminance] {
            let params = Params { second_spread, test, ..Params::default() };
            assert_eq!(run(params.clone(), &brighter).image, run(params, &f).image.map(|v| v * k));
        }
    }
}

#[test]
fn missing_inputs_follow_the_parameters() {
    let bare = Frame::from_color(
        Estimate::from_mean(Image::filled(4, 4, 3, 1.0)),
        Samples::uniform(1),
        Sampling::Independent,
    );
    let missing = |params: Params| match VirtualFlash::new(params).unwrap().denoise(&Input::new(&bare)) {
        Err(DenoiseError::MissingInputs { missing, .. }) => missing,
        other => panic!("{other:?}"),
    };
    let color = [Need::ColorVariance, Need::Samples(2)];
    let flash = [Need::Flash, Need::FlashVariance, Need::ColorVariance, Need::Samples(2)];
    assert_eq!(missing(Params::default()), flash);
    assert_eq!(missing(Params::color_guided()), color);
    assert_eq!(missing(Params { guide: GuideKind::None, ..Params::default() }), color);
    assert_eq!(missing(Params { homogeneous: false, ..Params::default() }), flash[..2]);
    // A blur needs nothing.
    let blur = Params { guide: GuideKind::None, homogeneous: false, ..Params::default() };
    assert_eq!(run(blur, &bare).image, bare.color.mean);
}

#[test]
fn parts_and_a_ready_made_flash_of_equal_content_agree() {
    let law = SampleLaw::Exponential;
    let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 40, 30).unwrap();
    let parts = scene.clone().with_guides(Guides::FlashParts).render(16, 7);
    let out = run(Params::default(), &parts);
    let told = |output: &Output| output.figures.iter().find(|f| f.name == "flash intensity").unwrap().value;
    let intensity = told(&out);
    let Some(Flash::Parts { base, light, covariance }) = &parts.flash else { panic!("parts were asked for") };
    let mut ready = parts.clone();
    let image = flash::sum(&base.mean, &light.mean, intensity);
    let [b, s] = [base, light].map(|e| e.variance.as_ref().unwrap().mean_variance());
    let variance = flash::variance(b, s, covariance.as_ref(), intensity);
    ready.flash = Some(Flash::Ready(estimate(image, variance)));
    assert_eq!(run(Params::default(), &ready).image, out.image);
    let doubled = run(Params { intensity_scale: 2.0, ..Params::default() }, &parts);
    assert_eq!(told(&doubled), 2.0 * intensity);
}

#[test]
fn diagnostics_show_guide_sets_and_first_step_without_changing_the_image() {
    let f = gaussian_edge(0.8).render(16, 8);
    let plain = run(Params::default(), &f);
    assert!(plain.diagnostics.is_empty());
    assert_eq!(
        plain.stages.iter().map(|s| s.name.as_str()).collect::<Vec<_>>(),
        ["guide", "step 1", "step 2"]
    );
    let method = VirtualFlash::default();
    let input = Input::new(&f).with_diagnostics(Diagnostics::On { probe: Some((20, 11)) });
    let full = method.denoise(&input).unwrap();
    assert_eq!(full.image, plain.image);
    let find = |name: &str| &full.diagnostics.iter().find(|d| d.name == name).unwrap().image;
    assert!(find("guide image").same_shape(&f.color.mean));
    assert_ne!(find("after step 1"), &f.color.mean);
    for (step, side) in [("step 1", 7), ("step 2", 31)] {
        let set = find(&format!("homogeneous set of the probe, {step}"));
        let weights = find(&format!("weights of the probe, {step}"));
        let counts = find(&format!("homogeneous pixels, {step}"));
        assert_eq!((set.width(), set.height()), (side, side));
        assert_eq!(set.plane(0).iter().sum::<f32>(), counts.get(0, 20, 11));
        assert_eq!((set.get(0, side / 2, side / 2), weights.get(0, side / 2, side / 2)), (1.0, 1.0));
        assert!(weights.data().iter().zip(set.data()).all(|(w, m)| *w <= *m));
    }
    let outside = Input::new(&f).with_diagnostics(Diagnostics::On { probe: Some((48, 0)) });
    let error = method.denoise(&outside).unwrap_err().to_string();
    assert!(error.contains("probe is (48, 0)") && error.contains("columns 0 to 47"), "{error}");
}

#[test]
fn values_without_an_answer_are_counted() {
    let mut f = wild_frame(1);
    f.color.mean.set(1, 5, 3, f32::NAN);
    f.color.mean.set(2, 5, 3, f32::INFINITY);
    f.color.mean.set(0, 9, 9, 1e31);
    let error = VirtualFlash::default().denoise(&Input::new(&f)).unwrap_err();
    assert!(matches!(error, DenoiseError::Undefined { pixels: 2, x: 5, y: 3, .. }), "{error}");
    let mut f = wild_frame(1);
    if let Some(Flash::Parts { base, .. }) = &mut f.flash {
        base.mean.set(0, 1, 0, f32::NAN);
    }
    let error = VirtualFlash::default().denoise(&Input::new(&f)).unwrap_err();
    assert!(matches!(error, DenoiseError::Undefined { pixels: 1, x: 1, y: 0, .. }), "{error}");
}

#[test]
fn parameters_out_of_range_are_named() {
    let bad = |change: fn(&mut Params)| {
        let mut params = Params::default();
        change(&mut params);
        VirtualFlash::new(params).unwrap_err()
    };
    assert_eq!(bad(|p| p.steps = 3).parameter, "steps");
    assert_eq!(bad(|p| p.neighbors = 6).parameter, "neighbors");
    assert_eq!(bad(|p| p.first_window_radius_px = 33).parameter, "first_window_radius_px");
    assert_eq!(bad(|p| p.first_confidence = 1.0).parameter, "first_confidence");
    assert_eq!(bad(|p| p.second_confidence = 99.0).parameter, "second_confidence");
    assert_eq!(bad(|p| p.second_sigma_ratio = f64::NAN).parameter, "second_sigma_ratio");
    assert_eq!(bad(|p| p.patch_radius_px = 4).parameter, "patch_radius_px");
    assert_eq!(bad(|p| p.kappa = 0.0).parameter, "kappa");
    assert_eq!(bad(|p| p.color_kappa = f64::NAN).parameter, "color_kappa");
    assert_eq!(bad(|p| p.luminance_clip_percentile = 0.0).parameter, "luminance_clip_percentile");
}
