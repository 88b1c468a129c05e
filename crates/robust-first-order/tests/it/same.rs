//! What must change nothing, or does what it says.

use noisefloor_conformance::change::{exposed, in_units};
use noisefloor_conformance::known::{exact, frame, ramp, step};
use noisefloor_conformance::outputs::{figure, largest_difference};
use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_frame::{Estimate, FeatureId, Image};
use noisefloor_robust_first_order::{
    Assembled, ColorPrefilter, ErrorKind, FeaturePrefilter, Fit, KSum, Params, RobustFirstOrder, Tiling,
    VarianceKind,
};

use crate::common::{diagnose, run};

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let noisy = frame(&step(100, 70), 0.1, 7);
    for params in
        [Params::default(), Params { iterations: 3, assembled: Assembled::One, ..Params::default() }]
    {
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let output = pool.install(|| run(&params, &noisy));
            let all = [output.image, output.error_estimate.unwrap(), output.estimate_of.unwrap().1];
            all.iter().flat_map(|image| image.data().iter().map(|v| v.to_bits())).collect::<Vec<_>>()
        };
        let one = on(1);
        assert!(one == on(2) && one == on(5));
    }
}

#[test]
fn no_result_depends_on_the_exposure() {
    let plain = frame(&step(50, 40), 0.1, 13);
    for params in [Params::default(), Params { error: ErrorKind::Absolute, ..Params::default() }] {
        let before = run(&params, &plain);
        for k in [-40, -10, 1, 10, 40] {
            let factor = f64::from(k).exp2();
            let after = run(&params, &exposed(&plain, factor as f32));
            let back = |image: &Image, by: f64| image.map(|v| (f64::from(v) / by) as f32);
            assert_eq!(back(&after.image, factor), before.image, "2^{k}: bit for bit");
            let estimate = back(&after.error_estimate.unwrap(), factor * factor);
            assert_eq!(&estimate, before.error_estimate.as_ref().unwrap(), "2^{k}");
        }
    }
}

#[test]
fn every_choice_has_a_say_of_its_own() {
    let noisy = frame(&step(62, 40), 0.1, 8);
    let default = Params::default;
    let before = run(&default(), &noisy).image;
    for other in [
        Params { coverage: 0.3, ..default() },
        Params { coverage: 0.0, ..default() },
        Params { variance: VarianceKind::Raw, ..default() },
        Params { residual_blur_px: 0.0, ..default() },
        Params { color_guided_radius_px: 1, ..default() },
        Params { feature_guided_radius_px: 3, ..default() },
        Params { guided_epsilon: 1e-2, ..default() },
        Params { k_sum: KSum::Divided, ..default() },
        Params { error: ErrorKind::Absolute, ..default() },
        Params { assembled: Assembled::One, ..default() },
        Params { assembled: Assembled::Local, ..default() },
        Params { iterations: 1, ..default() },
        Params { iterations: 3, ..default() },
        Params { ridge: 0.0, ..default() },
        Params { ridge: 0.1, ..default() },
        Params { fit: Fit::Prefiltered, ..default() },
        Params { color_prefilter: ColorPrefilter::Gaussian, ..default() },
        Params { color_prefilter: ColorPrefilter::None, ..default() },
        Params { feature_prefilter: FeaturePrefilter::Nlm, ..default() },
        Params { feature_prefilter: FeaturePrefilter::None, ..default() },
        Params { features_in_model: false, ..default() },
        Params { k_scale: 0.5, ..default() },
        Params { fixed_k: Some(2.0), ..default() },
        Params { tiling: Tiling::AllDetail, ..default() },
        Params { tiling: Tiling::Dense, ..default() },
        Params { large_radius_px: 12, ..default() },
        Params { growth_radius_px: 6, ..default() },
        Params { patch_radius_px: 1, ..default() },
        Params { prefilter_window_radius_px: 2, ..default() },
        Params { prefilter_k: 0.5, ..default() },
        Params { spatial_sigma_px: 1.0, ..default() },
        Params { range_sigma: 0.8, ..default() },
        Params { albedo_sigma: 0.1, ..default() },
    ] {
        assert_ne!(before, run(&other, &noisy).image, "{other:?}");
    }
    // These need detail to matter.
    let edged = Params { edge: 0.01, edge_share: 0.05, ..default() };
    let small = Params { small_radius_px: 7, ..edged.clone() };
    let literal = Params { tiling: Tiling::Literal, ..edged.clone() };
    let images = [default(), edged, small, literal].map(|params| run(&params, &noisy).image);
    assert!((0..4).all(|a| (0..a).all(|b| images[a] != images[b])));
    let gaussian = |gaussian_px| {
        run(&Params { color_prefilter: ColorPrefilter::Gaussian, gaussian_px, ..default() }, &noisy).image
    };
    assert_ne!(gaussian(0.8), gaussian(1.5));
}

#[test]
fn sums_as_written_and_divided_differ_on_a_noisy_ramp() {
    let noisy = frame(&ramp(62, 40), 0.1, 9);
    let with = |k_sum| run(&Params { k_sum, ..Params::default() }, &noisy);
    let (written, divided) = (with(KSum::AsWritten), with(KSum::Divided));
    assert_ne!(written.image, divided.image);
    // Divided sums favour larger bandwidths.
    let share = |output: &noisefloor_denoiser::Output| {
        let of = |k: &str| figure(output, &format!("share of models with k = {k}"));
        of("3.5") + of("4")
    };
    assert!(share(&divided) > share(&written), "{} and {}", share(&divided), share(&written));
}

#[test]
fn diagnostics_change_nothing_and_are_there() {
    let noisy = frame(&step(40, 33), 0.1, 10);
    let (plain, told) = (run(&Params::default(), &noisy), diagnose(&Params::default(), &noisy));
    assert_eq!(
        (plain.image, plain.error_estimate, plain.figures),
        (told.image, told.error_estimate, told.figures)
    );
    assert!(plain.diagnostics.is_empty());
    let names: Vec<&str> = told.diagnostics.iter().map(|d| d.name.as_str()).collect();
    for name in ["feature depth, prefiltered", "feature normal, prefiltered", "feature albedo, prefiltered"] {
        assert!(names.contains(&name), "{names:?}");
    }
    for diagnostic in &told.diagnostics {
        assert!(diagnostic.image.same_shape(&noisy.color.mean) && diagnostic.image.count_non_finite() == 0);
    }
    assert!(told.estimate_of.is_some());
}

#[test]
fn features_may_be_missing_constant_twice_the_same_or_in_other_units() {
    let noisy = frame(&step(62, 40), 0.1, 11);
    let before = run(&Params::default(), &noisy).image;
    // A feature that says nothing takes no part in models, but in the mean of guided filters.
    let prefilter = ColorPrefilter::Gaussian;
    let params = Params { color_prefilter: prefilter, ..Params::default() };
    let plain = run(&params, &noisy).image;
    let mut without = noisy.clone();
    without.features.remove(&FeatureId::Normal);
    // The normal is constant here.
    assert_eq!(run(&params, &without).image, plain);
    assert_ne!(run(&Params::default(), &without).image, before);
    // Depth in other units.
    let scaled = in_units(&noisy, 1024.0);
    assert!(largest_difference(&run(&Params::default(), &scaled).image, &before) < 1e-5);
    // None at all, and without variance or halves.
    for id in [FeatureId::Albedo, FeatureId::Depth] {
        without.features.remove(&id);
        assert_ne!(run(&Params::default(), &without).image, before);
    }
    let mut bare = noisy.clone();
    for feature in bare.features.values_mut() {
        *feature = Estimate::from_mean(feature.mean.clone());
    }
    assert!(run(&Params::default(), &bare).image.count_non_finite() == 0);
}

#[test]
fn background_is_one_depth_beyond_all_others() {
    // Sky above, a wall at depth 5 below. 0 and infinity tell the same.
    let truth = Image::from_fn(40, 40, 3, |_, _, y| if y < 15 { 0.8 } else { 0.3 });
    let with = |sky: f32| {
        let mut noisy = frame(&truth, 0.05, 12);
        let depth = Image::from_fn(40, 40, 1, |_, _, y| if y < 15 { sky } else { 5.0 });
        noisy.features.insert(FeatureId::Depth, exact(&depth).color);
        noisy
    };
    let zero = run(&Params::default(), &with(0.0)).image;
    assert_eq!(run(&Params::default(), &with(-1.0)).image, zero);
    assert_ne!(run(&Params::default(), &with(1.0)).image, zero);
    let mut infinite = with(f32::INFINITY);
    let error = RobustFirstOrder::default().denoise(&Input::new(&infinite)).unwrap_err();
    assert!(error.to_string().contains("not finite"), "{error}");
    infinite.sanitize().unwrap();
    // 5 over 5.5 for 1, and 1 for 1.1.
    assert!(largest_difference(&run(&Params::default(), &infinite).image, &zero) < 0.02);
}
