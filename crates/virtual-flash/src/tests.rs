use noisefloor_denoiser::{DenoiseError, Denoiser, Diagnostics, Guarded, Input, Need, Output, half_widths};
use noisefloor_frame::{Estimate, Flash, Frame, Image, Samples, Sampling, Variance};
use noisefloor_stats::{Level, t_quantile};
use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene};

use crate::*;

/// Uniforms in [0, 1) by SplitMix64.
fn uniforms(seed: u64) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }
}

fn image(width: usize, height: usize, mut value: impl FnMut() -> f32) -> Image {
    Image::from_fn(width, height, 3, |_, _, _| value())
}

fn estimate(mean: Image, variance: Image) -> Estimate {
    Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: None }
}

fn frame(mean: Image, variance: Image, n: u32) -> Frame {
    Frame::from_color(estimate(mean, variance), Samples::uniform(n), Sampling::Independent)
}

fn run(params: Params, frame: &Frame) -> Output {
    VirtualFlash::new(params).unwrap().denoise(&Input::new(frame)).unwrap()
}

/// Random data of every scale with fireflies, zero variances and a flash image unrelated to it.
fn wild_frame(seed: u64) -> Frame {
    let (w, h) = (37, 29);
    let mut u = uniforms(seed);
    let mean = image(w, h, || match u() {
        r if r < 0.02 => 1e6 * u(),
        r if r < 0.04 => 0.0,
        _ => 1.0 + u(),
    });
    let variance = image(w, h, || match u() {
        r if r < 0.02 => 1e10 * u(),
        r if r < 0.2 => 0.0,
        _ => 0.05 * u() * u(),
    });
    let mut f = frame(mean, variance, 16);
    let noisy = |u: &mut dyn FnMut() -> f32| {
        let mean = image(w, h, &mut *u);
        estimate(mean, image(w, h, || 0.01 * u()))
    };
    let (base, light) = (noisy(&mut u), noisy(&mut u));
    let covariance = Some(image(w, h, || 0.01 * (u() - 0.5)));
    f.flash = Some(Flash::Parts { base, light, covariance });
    f
}

fn steps() -> [Params; 2] {
    [Params::default(), Params { steps: 1, ..Params::default() }]
}

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

/// Asserts |D−x̄| ≤ Σ factor·t·s/√n, rounding allowed.
fn assert_enclosed(f: &Frame, d: &Image, terms: &[(f64, Level)], what: &str) {
    let variance = f.color.variance.as_ref().unwrap().mean_variance();
    let widths: Vec<Image> =
        terms.iter().map(|&(_, level)| half_widths(variance, &f.samples, level)).collect();
    for (i, (&d, &x)) in d.data().iter().zip(f.color.mean.data()).enumerate() {
        let sum: f64 = terms.iter().zip(&widths).map(|((k, _), w)| k * f64::from(w.data()[i])).sum();
        let (d, x) = (f64::from(d), f64::from(x));
        let allowed = sum * (1.0 + 1e-6) + 8.0 * f64::from(f32::EPSILON) * x.abs().max(d.abs());
        assert!((d - x).abs() <= allowed, "{what}: value {i}: |{d} − {x}| > {allowed}");
    }
}

#[test]
fn output_lies_in_the_claimed_interval_on_any_data_whatever() {
    for seed in 0..4 {
        let mut f = wild_frame(seed);
        if seed == 3 {
            f.samples = Samples::per_pixel((0..f.pixels() as u32).map(|p| 2 + p % 97).collect());
        }
        for guide in [GuideKind::Flash, GuideKind::Color, GuideKind::None] {
            for test in [TestKind::Joint, TestKind::PerChannel] {
                for steps in [1, 2] {
                    let params = Params { steps, guide, test, ..Params::default() };
                    let method = VirtualFlash::new(params).unwrap();
                    let claim = method.card().claims.enclosure.remove(0);
                    let out = method.denoise(&Input::new(&f)).unwrap();
                    assert_ne!(out.image, f.color.mean);
                    assert_enclosed(&f, &out.image, &claim.terms, &format!("{guide:?} {test:?} {steps}"));
                }
            }
        }
    }
}

#[test]
fn guarding_one_step_at_its_own_level_changes_nothing_but_rounding() {
    for seed in 0..3 {
        let f = wild_frame(seed);
        let params = Params { steps: 1, ..Params::default() };
        let level = Level::two_sided(params.second_confidence).unwrap();
        let plain = run(params.clone(), &f).image;
        let inner = Box::new(VirtualFlash::new(params).unwrap());
        let guarded = Guarded::new(inner, level).denoise(&Input::new(&f)).unwrap().image;
        for (&a, &b) in plain.data().iter().zip(guarded.data()) {
            assert!((a - b).abs() <= 8.0 * f32::EPSILON * a.abs().max(b.abs()), "{a} became {b}");
        }
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

fn gaussian_edge(sd: f64) -> SyntheticScene {
    let law = SampleLaw::Gaussian { sd, relative: false };
    SyntheticScene::new(MeanImage::of(ImageKind::Edges), law, 48, 32).unwrap()
}

/// Share of values with |D−μ| ≤ Σ factor·t·s/√n per replicate: mean and standard error over replicates.
fn hit_rate(scene: &SyntheticScene, method: &VirtualFlash, terms: &[(f64, Level)], n: u32) -> (f64, f64) {
    let truth = scene.truth();
    let rates: Vec<f64> = (0..6)
        .map(|seed| {
            let f = scene.render(n, 100 + seed);
            let out = method.denoise(&Input::new(&f)).unwrap().image;
            let variance = f.color.variance.as_ref().unwrap().mean_variance();
            let widths: Vec<Image> =
                terms.iter().map(|&(_, level)| half_widths(variance, &f.samples, level)).collect();
            let hits = out.data().iter().zip(truth.mean().data()).enumerate().filter(|(i, (d, mu))| {
                let width: f64 =
                    terms.iter().zip(&widths).map(|((k, _), w)| k * f64::from(w.data()[*i])).sum();
                f64::from((*d - *mu).abs()) <= width
            });
            hits.count() as f64 / out.data().len() as f64
        })
        .collect();
    let mean = rates.iter().sum::<f64>() / rates.len() as f64;
    let m2: f64 = rates.iter().map(|r| (r - mean).powi(2)).sum();
    (mean, (m2 / (rates.len() * (rates.len() - 1)) as f64).sqrt())
}

#[test]
fn proven_bounds_hold_on_normal_samples() {
    let scene = gaussian_edge(1.0);
    for params in steps().into_iter().chain([Params { test: TestKind::PerChannel, ..Params::default() }]) {
        let method = VirtualFlash::new(params.clone()).unwrap();
        for claim in method.card().claims.error_bound.iter().filter(|claim| claim.proven) {
            let (rate, error) = hit_rate(&scene, &method, &claim.terms, 16);
            let least = claim.level.confidence() - 4.0 * error;
            assert!(rate >= least, "{} with {params:?}: {rate} ± {error}", claim.name);
        }
    }
}

#[test]
fn rare_bright_samples_break_the_bound_and_stay_the_counter_example() {
    // At 16 samples an event of probability 1 % is missed in 85 % of the pixels: s = 0, an interval of one point.
    let law = SampleLaw::Bernoulli { q: 0.01, bright: 1.0 };
    let scene = SyntheticScene::new(MeanImage::of(ImageKind::Edges), law, 48, 32).unwrap();
    let method = VirtualFlash::new(Params { steps: 1, ..Params::default() }).unwrap();
    let claim = method.card().claims.error_bound.remove(0);
    let (rate, error) = hit_rate(&scene, &method, &claim.terms, 16);
    assert!(rate + 10.0 * error < claim.level.confidence(), "{rate} ± {error}");
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
    let without = run(Params { guide: GuideKind::None, ..Params::default() }, &f).image;
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
fn every_spread_of_step_two_denoises_and_only_the_raw_one_claims_a_proven_bound() {
    let scene = gaussian_edge(0.8);
    let truth = scene.truth();
    let f = scene.render(16, 3);
    let error = |image: &Image| -> f64 {
        image.data().iter().zip(truth.mean().data()).map(|(d, m)| f64::from(d - m).powi(2)).sum()
    };
    let mut images = Vec::new();
    for second_spread in [SpreadKind::Raw, SpreadKind::Propagated, SpreadKind::Halves] {
        let params = Params { second_spread, ..Params::default() };
        let card = VirtualFlash::new(params.clone()).unwrap().card();
        assert_eq!(card.needs.contains(&Need::ColorHalves), second_spread == SpreadKind::Halves);
        let proven = card.claims.error_bound.iter().filter(|c| c.proven).count();
        assert_eq!(
            (proven, card.claims.enclosure.len()),
            if second_spread == SpreadKind::Raw { (1, 1) } else { (0, 0) }
        );
        images.push(run(params, &f).image);
        assert!(error(images.last().unwrap()) < 0.5 * error(&f.color.mean), "{second_spread:?}");
    }
    assert!(images[0] != images[1] && images[0] != images[2] && images[1] != images[2]);
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
    let params = Params { first_sigma_ratio: 1e3, guide: GuideKind::None, ..Params::default() };
    let method = VirtualFlash::new(params.clone()).unwrap();
    let step = params.steps().unwrap()[0];
    let patch = noisefloor_kernels::flash_filter::PatchWeights::gaussian(2, 1.25).unwrap();
    let variance = f.color.variance.as_ref().unwrap().mean_variance();
    let tolerance = tolerance::Tolerance::new(method.params(), Some(variance), &f.samples, step.level);
    let first =
        spread::FirstStep { frame: &f, guide: None, patch: &patch, step: &step, tolerance: &tolerance };
    let propagated = first.variance(SpreadKind::Propagated).unwrap();
    assert!((propagated.get(1, 7, 7) - 0.01).abs() < 1e-6, "{}", propagated.get(1, 7, 7));
    let mean =
        |half: &Image| half.crop(4, 4, 7, 7).plane(2).iter().map(|&v| f64::from(v)).sum::<f64>() / 49.0;
    let expected = (mean(&halves[0]) - mean(&halves[1])).powi(2) / 4.0;
    let got = f64::from(first.variance(SpreadKind::Halves).unwrap().get(2, 7, 7));
    assert!((got - expected).abs() < 1e-4 * expected, "{got} instead of {expected}");
    // Near the corner the window is clipped to 4×4.
    assert!((propagated.get(0, 0, 0) - 0.49 / 16.0).abs() < 1e-6);
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
    for second_spread in [SpreadKind::Raw, SpreadKind::Propagated, SpreadKind::Halves] {
        for test in [TestKind::Joint, TestKind::PerChannel] {
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
    let intensity = out.figures.iter().find(|(name, _)| name == "flash intensity").unwrap().1;
    let Some(Flash::Parts { base, light, covariance }) = &parts.flash else { panic!("parts were asked for") };
    let mut ready = parts.clone();
    let image = flash::sum(&base.mean, &light.mean, intensity);
    let [b, s] = [base, light].map(|e| e.variance.as_ref().unwrap().mean_variance());
    let variance = flash::variance(b, s, covariance.as_ref(), intensity);
    ready.flash = Some(Flash::Ready(estimate(image, variance)));
    assert_eq!(run(Params::default(), &ready).image, out.image);
    let doubled = run(Params { intensity_scale: 2.0, ..Params::default() }, &parts);
    assert!(doubled.figures.contains(&("flash intensity".into(), 2.0 * intensity)));
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
    let find = |name: &str| &full.diagnostics.iter().find(|(n, _)| n == name).unwrap().1;
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
    assert_eq!(bad(|p| p.steps = 3), "steps");
    assert_eq!(bad(|p| p.first_window_radius_px = 33), "first_window_radius_px");
    assert_eq!(bad(|p| p.first_confidence = 1.0), "first_confidence");
    assert_eq!(bad(|p| p.second_confidence = 99.0), "second_confidence");
    assert_eq!(bad(|p| p.second_sigma_ratio = f64::NAN), "second_sigma_ratio");
    assert_eq!(bad(|p| p.patch_radius_px = 4), "patch_radius_px");
    assert_eq!(bad(|p| p.kappa = 0.0), "kappa");
    assert_eq!(bad(|p| p.luminance_clip_percentile = 0.0), "luminance_clip_percentile");
}

#[test]
fn levels_of_the_steps_give_the_printed_critical_values() {
    let card = VirtualFlash::default().card();
    let terms = &card.claims.error_bound[0].terms;
    for (n, t998, t99) in
        [(4, 10.2145, 5.8409), (16, 3.7328, 2.9467), (64, 3.2247, 2.6561), (1 << 20, 3.0902, 2.5758)]
    {
        for ((_, level), expected) in terms.iter().zip([t998, t99]) {
            let got = t_quantile(*level, n - 1);
            assert!((got - expected).abs() < 6e-5, "n = {n}: {got} instead of {expected}");
        }
    }
    assert_eq!(terms.iter().map(|(k, _)| *k).collect::<Vec<_>>(), [2.0, 1.0]);
    assert_eq!(card.claims.error_bound[1].name, "paper, as printed");
    assert!(!card.claims.error_bound[1].proven);
}
