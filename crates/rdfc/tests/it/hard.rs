//! Hard cases and wrong parameters.

use noisefloor_denoiser::{DenoiseError, Denoiser, Input};
use noisefloor_frame::{Image, Samples};
use noisefloor_rdfc::{Params, Rdfc};

use crate::common::{authors, frame, methods, ramp, run};

#[test]
fn every_hard_case_ends_in_finite_values_or_a_typed_error() {
    for case in noisefloor_testkit::hard_cases() {
        for params in [Params::default(), authors()] {
            for method in methods(&params) {
                noisefloor_testkit::check_method(&method, &case).unwrap_or_else(|e| panic!("{e}"));
            }
        }
    }
}

#[test]
fn every_size_and_any_number_of_samples_from_two_works() {
    for (w, h) in [(1, 1), (1, 7), (7, 1), (3, 3), (67, 5)] {
        for samples in [2, 3, 17] {
            let mut noisy = frame(&ramp(w, h), 0.1, 11);
            noisy.samples = Samples::uniform(samples);
            for params in [Params::default(), authors()] {
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
        assert_eq!(Rdfc::new(params), Err(name));
    }
}

#[test]
fn frames_brighter_than_the_engine_takes_come_out_as_bright() {
    let plain = frame(&ramp(20, 12), 0.1, 13);
    let bright = |factor: f32| {
        let mut bright = plain.clone();
        bright.color.mean = plain.color.mean.map(|v| v * factor);
        bright.color.halves = plain.color.halves.clone().map(|h| h.map(|half| half.map(|v| v * factor)));
        let variance = plain.color.variance.clone().unwrap().into_mean_variance();
        // Beyond the type's range, as a renderer would write it.
        let variance =
            variance.map(|v| (f64::from(v) * f64::from(factor).powi(2)).min(f32::MAX.into()) as f32);
        bright.color.variance = Some(noisefloor_frame::Variance::of_mean(variance));
        bright
    };
    for method in methods(&Params::default()) {
        // Both take the derivative for fixed weights, as all is brighter than 1, and no constant matters beside such
        // values.
        let (a, b) = (run(&method, &bright(2.0f32.powi(20))), run(&method, &bright(2.0f32.powi(60))));
        for (a, b) in a.image.data().iter().zip(b.image.data()) {
            assert!((a * 2.0f32.powi(40) / b - 1.0).abs() < 1e-5);
        }
        let estimates = [a.error_estimate.unwrap(), b.error_estimate.unwrap()];
        let mean = |image: &Image| image.data().iter().copied().map(f64::from).sum::<f64>();
        assert!((mean(&estimates[0]) * 2.0f64.powi(80) / mean(&estimates[1]) - 1.0).abs() < 1e-3);
        let extreme = run(&method, &bright(1e38));
        assert!(extreme.image.data().iter().all(|v| v.is_finite()));
        assert!(extreme.error_estimate.unwrap().data().iter().all(|v| v.is_finite()));
    }
}
