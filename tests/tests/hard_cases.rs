//! Hard cases: whatever the input, each method ends in a finite image or a typed error, and keeps what its card claims.

use noisefloor_denoiser::{DenoiseError, Registry};
use noisefloor_denoiser::{Denoiser, Diagnostics, Input, Need, half_widths};
use noisefloor_frame::{Estimate, FeatureId, Flash, Frame, FrameError, Image, Samples, Variance};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};
use serde_json::{Map, Value, json};

mod common;

use common::{scaled, set_variance};

/// A method under test with what makes it.
struct Subject {
    label: String,
    denoiser: Box<dyn Denoiser>,
}

fn overrides(value: &Value) -> Map<String, Value> {
    value.as_object().cloned().unwrap_or_default()
}

/// Settings beyond the defaults that change which code runs.
fn settings(id: &str) -> Vec<Value> {
    let mut all = vec![json!({})];
    match id {
        "virtual-flash" => {
            all.extend(["color", "none"].map(|guide| json!({ "guide": guide })));
            all.extend(["per-channel", "luminance"].map(|test| json!({ "test": test, "guide": "none" })));
            all.extend(["raw", "propagated", "halves"].map(|spread| json!({ "second_spread": spread })));
            all.extend([
                json!({ "steps": 1 }),
                json!({ "steps": 1, "guide": "color", "test": "luminance" }),
                json!({ "second_spread": "halves", "test": "per-channel", "guide": "color" }),
                json!({ "second_spread": "propagated", "test": "luminance", "guide": "none" }),
                json!({ "second_spread": "halves", "test": "luminance", "guide": "color" }),
                json!({ "homogeneous": false }),
                json!({ "homogeneous": false, "guide": "none", "patch_radius_px": 0 }),
                json!({ "patch_radius_px": 3, "second_window_radius_px": 32, "guide_floor": 0.0 }),
            ]);
        }
        "geometric-corrected" => {
            all.extend(["sample-variance", "std-of-mean"].map(|spread| json!({ "spread": spread })));
            all.push(json!({ "material": "ids" }));
            all.push(json!({ "material": "off", "depth_test": false, "normal_test": false }));
            all.push(json!({ "floor_unit": "radiance", "luminance_floor": 0.01 }));
            all.extend(
                ["updated-mean", "previous-mean", "population"].map(|form| json!({ "variance_form": form })),
            );
        }
        // A guest like any other: the copy of its input. Nothing without a command.
        "command" if cfg!(unix) => all = vec![json!({ "run": "cp {color.pfm} {output.pfm}" })],
        "command" => all.clear(),
        "geometric-as-written" => all.push(json!({ "visits_center": false, "normal_threshold": 1.0 })),
        _ => {}
    }
    all
}

fn build(registry: &Registry, id: &str, settings: &Value) -> Subject {
    let method = registry.build(id, &overrides(settings)).unwrap();
    Subject { label: format!("{id} {settings}"), denoiser: method.denoiser }
}

/// Every built-in method, plain and guarded, with its settings.
fn subjects() -> Vec<Subject> {
    let registry = noisefloor_registry::registry([]);
    let mut all = Vec::new();
    for factory in registry.factories() {
        for settings in settings(factory.id()) {
            all.push(build(&registry, factory.id(), &settings));
            all.push(build(&registry, &format!("guarded({})", factory.id()), &settings));
        }
    }
    all
}

/// A frame with every buffer that a method of this workspace can ask for.
fn frame(width: usize, height: usize, spp: u32) -> Frame {
    let law = SampleLaw::LogNormal { sigma: 0.7 };
    SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, width, height).unwrap().render(spp, 11)
}

/// The claimed enclosures hold: |D−x̄| ≤ Σ factor·t·s/√n, rounding allowed.
fn assert_enclosed(subject: &Subject, f: &Frame, image: &Image, case: &str) {
    let Some(variance) = f.color.variance.as_ref().map(Variance::mean_variance) else { return };
    for claim in subject.denoiser.card().claims.enclosure {
        let widths: Vec<(f64, Image)> =
            claim.terms.iter().map(|&(k, level)| (k, half_widths(variance, &f.samples, level))).collect();
        for (i, (&d, &x)) in image.data().iter().zip(f.color.mean.data()).enumerate() {
            let width: f64 = widths.iter().map(|(k, w)| k * f64::from(w.data()[i])).sum();
            let (d, x) = (f64::from(d), f64::from(x));
            let rounding = 1e-6 * width + 12.0 * f64::from(f32::EPSILON) * x.abs().max(d.abs());
            let distance = (d - x).abs();
            assert!(distance <= width + rounding, "{}, {case}: {d} left {x} ± {width}", subject.label);
        }
    }
}

/// Runs everything on a sanitised frame. Allowed errors: missing inputs, and undefined pixels of `as-written`.
fn survive(case: &str, mut f: Frame) {
    let pixels = f.pixels();
    match f.sanitize() {
        Ok(_) => {}
        Err(error) => {
            // Nobody hands such a frame to a method.
            assert_eq!(error, FrameError::NoValidPixel { pixels }, "{case}");
            assert!(case.ends_with("everywhere"), "{case}");
            return;
        }
    }
    for subject in subjects() {
        let card = subject.denoiser.card();
        match subject.denoiser.denoise(&Input::new(&f)) {
            Ok(output) => {
                assert!(card.missing(&f).is_empty(), "{}, {case}: ran without its needs", subject.label);
                assert!(output.image.same_shape(&f.color.mean), "{}, {case}", subject.label);
                assert_eq!(output.image.count_non_finite(), 0, "{}, {case}", subject.label);
                assert!(output.figures.iter().all(|f| f.value.is_finite()), "{}, {case}", subject.label);
                assert_enclosed(&subject, &f, &output.image, case);
            }
            Err(DenoiseError::MissingInputs { missing, .. }) => {
                assert_eq!(missing, card.missing(&f), "{}, {case}", subject.label);
                assert!(!missing.is_empty(), "{}, {case}", subject.label);
            }
            Err(DenoiseError::Undefined { pixels, .. }) => {
                assert!(card.id.contains("as-written"), "{}, {case}: undefined", subject.label);
                assert!((1..=f.pixels()).contains(&pixels));
            }
            Err(other) => panic!("{}, {case}: {other}", subject.label),
        }
    }
}

const SIZE: (usize, usize) = (23, 17);

fn hard(case: &str, change: impl FnOnce(&mut Frame)) {
    let mut f = frame(SIZE.0, SIZE.1, 16);
    change(&mut f);
    survive(case, f);
}

#[test]
fn a_complete_frame_misses_nothing() {
    let f = frame(SIZE.0, SIZE.1, 16);
    for subject in subjects() {
        assert!(subject.denoiser.card().missing(&f).is_empty(), "{}", subject.label);
    }
    survive("complete frame", f);
}

#[test]
fn numbers_that_are_none_and_negative_ones() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -3.0] {
        hard(&format!("{bad} in the mean"), |f| {
            (0..3).for_each(|c| f.color.mean.set(c, 4 + c, 5, bad));
            f.color.mean.set(0, 0, 0, bad);
        });
        hard(&format!("{bad} in the variance"), |f| {
            let mut k = 0;
            set_variance(&mut f.color, |v| {
                k += 1;
                if k % 17 == 0 { bad } else { v }
            });
        });
        hard(&format!("{bad} in halves, features and flash"), |f| {
            f.color.halves.iter_mut().flatten().for_each(|half| half.set(1, 3, 3, bad));
            for feature in f.features.values_mut() {
                feature.mean.data_mut().iter_mut().step_by(13).for_each(|v| *v = bad);
                set_variance(feature, |_| bad);
            }
            if let Some(Flash::Parts { base, light, covariance }) = &mut f.flash {
                base.mean.data_mut().iter_mut().step_by(11).for_each(|v| *v = bad);
                set_variance(light, |_| bad);
                covariance.iter_mut().for_each(|c| c.set(0, 1, 1, bad));
            }
        });
        hard(&format!("{bad} everywhere"), |f| f.color.mean.data_mut().fill(bad));
    }
}

#[test]
fn input_that_nobody_sanitised_gives_an_image_or_a_typed_error_and_no_panic() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, f32::MAX, f32::MIN_POSITIVE] {
        let mut f = frame(SIZE.0, SIZE.1, 4);
        let spoil = |image: &mut Image, first: usize| {
            image.data_mut().iter_mut().skip(first).step_by(19).for_each(|v| *v = bad);
        };
        spoil(&mut f.color.mean, 1);
        let mut k = 0;
        set_variance(&mut f.color, |v| {
            k += 1;
            if k % 23 == 0 { bad } else { v }
        });
        f.features.values_mut().for_each(|feature| spoil(&mut feature.mean, 2));
        if let Some(Flash::Parts { base, light, .. }) = &mut f.flash {
            spoil(&mut base.mean, 3);
            set_variance(light, |_| bad);
        }
        for subject in subjects() {
            if let Ok(output) = subject.denoiser.denoise(&Input::new(&f)) {
                assert!(output.image.same_shape(&f.color.mean), "{}, {bad}", subject.label);
            }
        }
    }
}

#[test]
fn one_sample_is_refused_by_all_that_need_a_variance() {
    let honest = frame(SIZE.0, SIZE.1, 1);
    assert!(honest.color.variance.is_none());
    // A file may carry a variance and still say that one sample was taken.
    let mut odd = frame(SIZE.0, SIZE.1, 2);
    odd.samples = Samples::uniform(1);
    let mut mixed = frame(SIZE.0, SIZE.1, 4);
    mixed.samples = Samples::per_pixel((0..mixed.pixels()).map(|p| if p == 40 { 1 } else { 4 }).collect());
    for f in [honest, odd, mixed] {
        for subject in subjects() {
            let needs = subject.denoiser.card().needs;
            let result = subject.denoiser.denoise(&Input::new(&f));
            if needs.contains(&Need::Samples(2)) {
                assert!(
                    matches!(result, Err(DenoiseError::MissingInputs { ref missing, .. })
                        if missing.contains(&Need::Samples(2))),
                    "{}",
                    subject.label
                );
            } else if subject.denoiser.card().missing(&f).is_empty() {
                assert_eq!(result.unwrap().image.count_non_finite(), 0, "{}", subject.label);
            }
        }
    }
}

#[test]
fn two_samples_and_counts_that_differ_from_pixel_to_pixel() {
    survive("two samples", frame(SIZE.0, SIZE.1, 2));
    hard("uneven counts", |f| {
        f.samples = Samples::per_pixel((0..f.pixels() as u32).map(|p| 2 + (p * p) % 20_000).collect());
    });
    hard("as many samples as can be counted", |f| f.samples = Samples::uniform(u32::MAX));
}

#[test]
fn zero_variance_everywhere_and_in_one_channel() {
    hard("no variance", |f| set_variance(&mut f.color, |_| 0.0));
    hard("no variance in green", |f| {
        let mut variance = f.color.variance.take().unwrap().into_mean_variance();
        variance.plane_mut(1).fill(0.0);
        f.color.variance = Some(Variance::of_mean(variance));
    });
    hard("no variance in the flash", |f| {
        if let Some(Flash::Parts { base, light, covariance }) = &mut f.flash {
            set_variance(base, |_| 0.0);
            set_variance(light, |_| 0.0);
            *covariance = None;
        }
    });
    hard("all black", |f| *f = scaled(f, 0.0));
    hard("smallest variances", |f| set_variance(&mut f.color, |_| f32::from_bits(1)));
}

#[test]
fn fireflies_a_million_above_the_mean() {
    hard("fireflies", |f| {
        let (mean, variance) = (1e6, 1e6 * 1e6);
        let mut spread = f.color.variance.take().unwrap().into_mean_variance();
        for (x, y) in [(5, 5), (6, 5), (22, 16), (0, 9)] {
            for c in 0..3 {
                f.color.mean.set(c, x, y, mean);
                spread.set(c, x, y, variance);
            }
        }
        f.color.variance = Some(Variance::of_mean(spread));
    });
    hard("fireflies without variance", |f| {
        (0..3).for_each(|c| f.color.mean.set(c, 7, 7, 1e6));
        set_variance(&mut f.color, |_| 0.0);
    });
    hard("fireflies in the flash", |f| {
        if let Some(Flash::Parts { base, light, .. }) = &mut f.flash {
            base.mean.set(0, 3, 3, 1e6);
            light.mean.set(1, 4, 4, 1e30);
        }
    });
}

#[test]
fn means_near_a_million_with_a_variance_near_a_thousandth() {
    let base = frame(SIZE.0, SIZE.1, 16);
    let offset = |e: &Estimate| Estimate {
        mean: e.mean.map(|v| 1e6 + 0.06 * (v - 0.5)),
        variance: Some(Variance::of_mean(e.mean.map(|_| 1e-3))),
        halves: e.halves.clone().map(|halves| halves.map(|half| half.map(|v| 1e6 + 0.06 * (v - 0.5)))),
    };
    let mut f = base.clone();
    f.color = offset(&base.color);
    for subject in subjects() {
        // Nothing is lost to cancellation.
        if let Ok(output) = subject.denoiser.denoise(&Input::new(&f))
            && !subject.denoiser.card().id.contains("as-written")
        {
            let worst = output.image.data().iter().map(|v| (v - 1e6).abs()).fold(0.0, f32::max);
            assert!(worst < 1.0, "{}: {worst} away from the level", subject.label);
        }
    }
    survive("large means, small variances", f);
}

#[test]
fn scales_from_1e_minus_8_to_1e8() {
    let f = frame(SIZE.0, SIZE.1, 16);
    for exponent in [-8, -4, 4, 8] {
        survive(&format!("scale 1e{exponent}"), scaled(&f, 10f32.powi(exponent)));
    }
}

#[test]
fn values_at_the_end_of_the_number_range_are_denoised_or_refused() {
    let cap = |estimate: &mut Estimate| set_variance(estimate, |v| v.min(f32::MAX));
    for k in [1e15, 1e25, 1e30, 1e37] {
        // Variances end where the type does, else the frame would have no variance.
        let mut f = scaled(&frame(SIZE.0, SIZE.1, 16), k);
        cap(&mut f.color);
        if let Some(Flash::Parts { base, light, covariance }) = &mut f.flash {
            cap(base);
            cap(light);
            *covariance = None;
        }
        assert_eq!(f.sanitize().unwrap().invalid_pixels, 0);
        for subject in subjects() {
            match subject.denoiser.denoise(&Input::new(&f)) {
                Ok(output) => assert_eq!(output.image.count_non_finite(), 0, "{}, {k}", subject.label),
                Err(error) => {
                    assert!(matches!(error, DenoiseError::Undefined { .. }), "{}: {error}", subject.label);
                    assert!(k >= 1e30 || subject.label.contains("as-written"), "{}: {error}", subject.label);
                }
            }
        }
    }
}

#[test]
fn constant_collinear_and_absent_features() {
    let fill = |f: &mut Frame, value: &dyn Fn(usize, usize, usize) -> f32| {
        for feature in f.features.values_mut() {
            let (w, h, channels) = (feature.mean.width(), feature.mean.height(), feature.mean.channels());
            feature.mean = Image::from_fn(w, h, channels, value);
            set_variance(feature, |_| 0.0);
        }
    };
    hard("constant features", |f| fill(f, &|_, _, _| 1.0));
    hard("zero features", |f| fill(f, &|_, _, _| 0.0));
    hard("collinear features", |f| fill(f, &|c, x, y| (c + 1) as f32 * (x + y) as f32));
    hard("depths beyond all measure", |f| {
        let depth = f.features.get_mut(&FeatureId::Depth).unwrap();
        depth.mean = Image::from_fn(23, 17, 1, |_, x, _| if x % 2 == 0 { f32::INFINITY } else { 3e38 });
    });
    hard("no features", |f| f.features.clear());
    hard("no flash", |f| f.flash = None);
    hard("no halves", |f| f.color.halves = None);
    hard("constant flash", |f| {
        let flat = |e: &Estimate, v| Estimate { mean: e.mean.map(|_| v), ..e.clone() };
        if let Some(Flash::Parts { base, light, covariance }) = f.flash.take() {
            let (base, light) = (flat(&base, 0.3), flat(&light, 0.0));
            f.flash = Some(Flash::Parts { base, light, covariance });
        }
    });
}

#[test]
fn images_smaller_than_any_window_and_of_odd_widths() {
    for (w, h) in [(1, 1), (1, 7), (7, 1), (2, 2), (3, 3), (5, 2), (33, 1), (17, 16), (65, 17)] {
        survive(&format!("{w}×{h}"), frame(w, h, 4));
    }
}

#[test]
fn diagnostics_survive_what_the_image_survives() {
    for (w, h) in [(1, 1), (4, 3)] {
        let f = frame(w, h, 4);
        for subject in subjects() {
            let plain = subject.denoiser.denoise(&Input::new(&f));
            let input = Input::new(&f).with_diagnostics(Diagnostics::On { probe: None });
            match (plain, subject.denoiser.denoise(&input)) {
                (Ok(plain), Ok(full)) => {
                    assert_eq!(plain.image, full.image, "{}", subject.label);
                    assert!(full.diagnostics.iter().all(|d| d.image.count_non_finite() == 0));
                }
                (plain, full) => assert_eq!(plain.err(), full.err(), "{}", subject.label),
            }
        }
    }
}

#[test]
fn one_and_four_threads_give_the_same_bits() {
    let f = frame(67, 35, 8);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let (one, four) = (pool(1), pool(4));
    for subject in subjects() {
        let run = |pool: &rayon::ThreadPool| {
            pool.install(|| subject.denoiser.denoise(&Input::new(&f)).map(|output| output.image))
        };
        assert_eq!(run(&one), run(&four), "{}", subject.label);
    }
}

#[test]
fn a_power_of_two_of_exposure_scales_the_output_exactly() {
    let registry = noisefloor_registry::registry([]);
    let f = frame(SIZE.0, SIZE.1, 16);
    for exponent in [-13, 13] {
        let k = 2f32.powi(exponent);
        let bright = scaled(&f, k);
        let k = f64::from(k);
        // Settings with a unit are scaled along, where they stay in range: (id, at this exposure, at the other).
        let mut pairs = vec![
            ("mc", json!({}), json!({})),
            ("geometric-corrected", json!({}), json!({})),
            (
                "geometric-corrected",
                json!({ "floor_unit": "radiance", "luminance_floor": 0.01 }),
                json!({ "floor_unit": "radiance", "luminance_floor": 0.01 * k }),
            ),
            (
                "geometric-corrected",
                json!({ "spread": "std-of-mean" }),
                json!({ "spread": "std-of-mean", "pixels_per_error": 5.0 / k }),
            ),
        ];
        pairs.retain(|(_, _, other)| other["pixels_per_error"].as_f64().is_none_or(|s0| s0 <= 1e4));
        pairs.extend(settings("virtual-flash").into_iter().map(|s| ("virtual-flash", s.clone(), s)));
        for (id, here, there) in pairs {
            for id in [id.to_owned(), format!("guarded({id})")] {
                let run = |settings, f| {
                    build(&registry, &id, settings).denoiser.denoise(&Input::new(f)).unwrap().image
                };
                let expected = run(&here, &f).map(|v| v * k as f32);
                assert_eq!(run(&there, &bright), expected, "{id} {here}, factor {k}");
            }
        }
    }
}
