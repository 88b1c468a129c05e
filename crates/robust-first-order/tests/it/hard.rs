//! Hard cases and wrong parameters.

use noisefloor_conformance::assert_conforms;
use noisefloor_conformance::known::{frame, ramp};
use noisefloor_denoiser::{DenoiseError, Denoiser, Input};
use noisefloor_frame::{Image, Samples};
use noisefloor_robust_first_order::{Assembled, Params, RobustFirstOrder, VarianceKind};

use crate::common::run;

#[test]
fn it_conforms() {
    for params in [
        Params::default(),
        Params { variance: VarianceKind::Raw, ..Params::default() },
        Params { coverage: 0.0, ..Params::default() },
        Params { ridge: 0.0, assembled: Assembled::Local, ..Params::default() },
    ] {
        assert_conforms(&RobustFirstOrder::new(params).unwrap());
    }
}

#[test]
fn every_size_and_any_number_of_samples_from_two_works() {
    for (w, h) in [(1, 1), (1, 7), (7, 1), (3, 3), (67, 5)] {
        for samples in [2, 3, 17] {
            let mut noisy = frame(&ramp(w, h), 0.1, 41);
            noisy.samples = Samples::uniform(samples);
            let output = run(&Params::default(), &noisy);
            assert!(output.image.same_shape(&noisy.color.mean));
            assert_eq!(output.image.count_non_finite(), 0);
        }
    }
}

#[test]
fn what_is_missing_or_not_finite_is_told() {
    let mut noisy = frame(&ramp(6, 5), 0.1, 42);
    let halves = noisy.color.halves.take();
    let error = RobustFirstOrder::default().denoise(&Input::new(&noisy)).unwrap_err();
    assert!(matches!(error, DenoiseError::MissingInputs { .. }), "{error}");
    assert!(error.to_string().contains("half buffers of the colour"), "{error}");
    assert!(error.to_string().contains("variance=raw"), "{error}");
    let raw = RobustFirstOrder::new(Params { variance: VarianceKind::Raw, ..Params::default() }).unwrap();
    assert!(raw.denoise(&Input::new(&noisy)).is_ok());
    noisy.color.halves = halves;
    noisy.color.mean.set(1, 4, 2, f32::NAN);
    let error = RobustFirstOrder::default().denoise(&Input::new(&noisy)).unwrap_err().to_string();
    assert!(error.contains("not finite") && error.contains("(4, 2)"), "{error}");
    noisy.color.mean = Image::filled(6, 5, 3, 0.5);
    noisy.features.values_mut().next().unwrap().mean.set(0, 3, 1, f32::INFINITY);
    let error = RobustFirstOrder::default().denoise(&Input::new(&noisy)).unwrap_err().to_string();
    assert!(error.contains("not finite") && error.contains("(3, 1)"), "{error}");
}

#[test]
fn parameters_out_of_range_are_named() {
    let good = Params::default;
    for (name, params) in [
        ("coverage", Params { coverage: 1.5, ..good() }),
        ("residual_blur_px", Params { residual_blur_px: -1.0, ..good() }),
        ("color_guided_radius_px", Params { color_guided_radius_px: 65, ..good() }),
        ("guided_epsilon", Params { guided_epsilon: f64::NAN, ..good() }),
        ("iterations", Params { iterations: 4, ..good() }),
        ("ridge", Params { ridge: -1.0, ..good() }),
        ("k_scale", Params { k_scale: 0.0, ..good() }),
        ("fixed_k", Params { fixed_k: Some(0.0), ..good() }),
        ("edge_share", Params { edge_share: 2.0, ..good() }),
        ("small_radius_px", Params { small_radius_px: 0, ..good() }),
        ("large_radius_px", Params { large_radius_px: 33, ..good() }),
        ("patch_radius_px", Params { patch_radius_px: 4, ..good() }),
        ("prefilter_window_radius_px", Params { prefilter_window_radius_px: 17, ..good() }),
        ("range_sigma", Params { range_sigma: 0.0, ..good() }),
    ] {
        assert_eq!(RobustFirstOrder::new(params).unwrap_err().parameter, name);
    }
}
