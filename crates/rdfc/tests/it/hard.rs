//! Hard cases and wrong parameters.

use noisefloor_conformance::assert_conforms;
use noisefloor_conformance::change::{exposed, set_variance};
use noisefloor_conformance::known::{frame, ramp};
use noisefloor_conformance::outputs::run;
use noisefloor_denoiser::{DenoiseError, Denoiser, Input};
use noisefloor_frame::{Image, Samples};
use noisefloor_rdfc::{Params, Rdfc};

use crate::common::{methods, profiles};

#[test]
fn every_profile_and_candidate_conforms() {
    profiles().iter().flat_map(methods).for_each(|method| assert_conforms(&method));
}

#[test]
fn every_size_and_any_number_of_samples_from_two_works() {
    for (w, h) in [(1, 1), (1, 7), (7, 1), (3, 3), (67, 5)] {
        for samples in [2, 3, 17] {
            let mut noisy = frame(&ramp(w, h), 0.1, 11);
            noisy.samples = Samples::uniform(samples);
            for params in profiles() {
                for method in methods(&params) {
                    let output = run(&method, &noisy);
                    assert!(output.image.same_shape(&noisy.color.mean));
                    assert!(output.image.data().iter().all(|v| v.is_finite()));
                }
            }
        }
    }
}

#[test]
fn what_is_missing_or_not_finite_is_told() {
    let mut noisy = frame(&ramp(6, 5), 0.1, 12);
    let halves = noisy.color.halves.take();
    let error = Rdfc::default().denoise(&Input::new(&noisy)).unwrap_err();
    assert!(matches!(error, DenoiseError::MissingInputs { .. }), "{error}");
    assert!(error.to_string().contains("half buffers of the colour"), "{error}");
    noisy.color.halves = halves;
    noisy.color.mean.set(1, 4, 2, f32::NAN);
    let error = Rdfc::default().denoise(&Input::new(&noisy)).unwrap_err().to_string();
    assert!(error.contains("not finite") && error.contains("(4, 2)"), "{error}");
    noisy.color.mean = Image::filled(6, 5, 3, 0.5);
    noisy.features.values_mut().next().unwrap().mean.set(0, 3, 1, f32::INFINITY);
    let error = Rdfc::default().denoise(&Input::new(&noisy)).unwrap_err().to_string();
    assert!(error.contains("not finite") && error.contains("(3, 1)"), "{error}");
}

#[test]
fn parameters_out_of_range_are_named() {
    let good = Params::default();
    let eleven = (0..11).map(|k| k.to_string()).collect();
    for (name, params) in [
        ("window_radius_px", Params { window_radius_px: 33, ..good.clone() }),
        ("color_k", Params { color_k: 0.0, ..good.clone() }),
        ("feature_k", Params { feature_k: f64::NAN, ..good.clone() }),
        ("features", Params { features: eleven, ..good.clone() }),
        ("prefilter_k", Params { prefilter_k: 1e4, ..good.clone() }),
        ("prefilter_window_radius_px", Params { prefilter_window_radius_px: 33, ..good.clone() }),
        ("prefilter_patch_radius_px", Params { prefilter_patch_radius_px: 4, ..good.clone() }),
        ("neighbors", Params { neighbors: 9, ..good.clone() }),
        ("map_patch_radius_px", Params { map_patch_radius_px: Some(4), ..good.clone() }),
    ] {
        assert_eq!(Rdfc::new(params).unwrap_err().parameter, name);
    }
}

#[test]
fn no_result_depends_on_the_exposure() {
    let plain = frame(&ramp(20, 12), 0.1, 13);
    for params in profiles() {
        for method in methods(&params) {
            let before = run(&method, &plain);
            let wanted = method.adaptive().unwrap().density(&Input::new(&plain)).unwrap();
            for k in [-40, -3, 1, 20, 50] {
                let factor = f64::from(k).exp2();
                let other = exposed(&plain, factor as f32);
                let after = run(&method, &other);
                let back = |image: &Image, by: f64| image.map(|v| (f64::from(v) / by) as f32);
                assert_eq!(back(&after.image, factor), before.image, "2^{k}: bit for bit");
                let estimate = back(&after.error_estimate.unwrap(), factor * factor);
                assert_eq!(&estimate, before.error_estimate.as_ref().unwrap(), "2^{k}");
                assert_eq!(after.estimate_of.is_some(), before.estimate_of.is_some());
                if let (Some((_, a)), Some((_, b))) = (after.estimate_of, &before.estimate_of) {
                    assert_eq!(&back(&a, factor), b);
                }
                assert_eq!(method.adaptive().unwrap().density(&Input::new(&other)).unwrap(), wanted, "2^{k}");
            }
            let mut extreme = exposed(&plain, 1e38);
            // Beyond the type's range, as a renderer would write it.
            set_variance(&mut extreme.color, |v| v.min(f32::MAX));
            let extreme = run(&method, &extreme);
            assert!(extreme.image.data().iter().all(|v| v.is_finite()));
            assert!(extreme.error_estimate.unwrap().data().iter().all(|v| v.is_finite()));
        }
    }
}

#[test]
fn one_firefly_of_any_size_leaves_far_pixels_what_they_were() {
    // Beyond all windows of it: derivatives, estimates, maps and passes reach 10 + 5 + 10 pixels and patches.
    let plain = frame(&ramp(90, 12), 0.1, 14);
    for params in profiles() {
        let method = Rdfc::new(params).unwrap();
        let before = run(&method, &plain).image;
        for size in [1e3f32, 1e9, 1e13] {
            let mut spoilt = plain.clone();
            let put = |image: &mut Image, value: f32| (0..3).for_each(|c| image.set(c, 4, 5, value));
            put(&mut spoilt.color.mean, size);
            let [a, b] = spoilt.color.halves.as_mut().unwrap();
            put(a, 2.0 * size);
            put(b, 0.0);
            let mut variance = spoilt.color.variance.take().unwrap().into_mean_variance();
            put(&mut variance, size * size);
            spoilt.color.variance = Some(noisefloor_frame::Variance::of_mean(variance));
            let after = run(&method, &spoilt).image;
            let far = (60..90).flat_map(|x| (0..12).map(move |y| (x, y)));
            for (x, y) in far {
                for c in 0..3 {
                    let (a, b) = (before.get(c, x, y), after.get(c, x, y));
                    // A frame that is dimmed for its brightest value is the same frame to rounding.
                    assert!((a - b).abs() < 1e-4 * a.abs(), "{size:e} at ({x}, {y}): {a} and {b}");
                }
            }
        }
    }
}
