//! Each metric against numbers worked out by hand.

use noisefloor_frame::{Estimate, Frame, Image, Reference, Samples, Sampling, SquaredError, Variance};
use noisefloor_metrics::{
    Better, Classes, EPSILON, ErrorKind, METRICS, Measured, Measurer, MetricError, block_bootstrap,
    error_map, metric, srgb_curve,
};

fn measure(test: &Image, truth: Image) -> Measured {
    Measurer::new(&Reference::exact(truth), None).unwrap().measure(test).unwrap()
}

/// A reference with halves and without parts.
fn with_halves(a: Image, b: Image) -> Reference {
    let mut reference = Reference::exact(a.zip_map(&b, |a, b| 0.5 * (a + b)));
    reference.frame.color.variance = None;
    reference.frame.color.halves = Some([a, b]);
    reference.frame.samples = Samples::uniform(1024);
    reference
}

fn with_variance(mean: Image, variance: Image) -> Reference {
    let color = Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: None };
    let frame = Frame::from_color(color, Samples::uniform(1024), Sampling::Independent);
    Reference { frame, parts: Vec::new() }
}

#[track_caller]
fn assert_value(measured: &Measured, id: &str, expected: f64) {
    let value = measured.values[id].unwrap();
    assert!(
        (value - expected).abs() <= 1e-9 * expected.abs().max(1.0),
        "{id} = {value}, expected {expected}"
    );
}

#[test]
fn squared_errors_are_means_over_pixels_and_channels() {
    let truth = Image::filled(2, 1, 3, 0.5);
    let mut test = truth.clone();
    test.set(0, 0, 0, 1.5);
    test.set(2, 1, 0, -1.5);
    let measured = measure(&test, truth);
    assert_value(&measured, "mse", (1.0 + 4.0) / 6.0);
    assert_value(&measured, "rmse", (5.0f64 / 6.0).sqrt());
    assert_value(&measured, "relmse", 5.0 / 6.0 / (0.25 + EPSILON));
    assert_eq!((measured.pixels, measured.non_finite_values), (2, 0));
    assert!(measured.reference_se.is_empty(), "an exact truth adds nothing");
}

#[test]
fn relative_error_floors_negative_references_at_zero() {
    let measured = measure(&Image::filled(3, 3, 3, 0.0), Image::filled(3, 3, 3, -0.5));
    assert_value(&measured, "relmse", 0.25 / EPSILON);
}

#[test]
fn trimming_drops_the_pixel_that_is_worst_over_its_channels() {
    let truth = Image::filled(20, 10, 3, 0.0);
    let mut test = Image::filled(20, 10, 3, 0.1);
    // One pixel bad in one channel, the other a little in all three: the mean over channels decides.
    test.set(0, 3, 4, 2.0);
    for c in 0..3 {
        test.set(c, 7, 7, 1.0);
    }
    let measured = measure(&test, truth);
    let plain = |sum: f64| sum / 3.0 / EPSILON;
    let (bad, mild, rest) = (plain(4.0 + 0.02), plain(3.0), plain(0.03));
    assert!((measured.values["relmse"].unwrap() - (bad + mild + 198.0 * rest) / 200.0).abs() < 1e-5);
    // ⌈0.001·200⌉ = 1 pixel is dropped.
    assert!((measured.values["relmse_trimmed"].unwrap() - (mild + 198.0 * rest) / 199.0).abs() < 1e-5);
}

#[test]
fn psnr_is_that_of_the_tone_mapped_image() {
    let measured = measure(&Image::filled(12, 12, 3, 0.25), Image::filled(12, 12, 3, 0.5));
    let d = srgb_curve(0.5) - srgb_curve(0.25);
    assert_value(&measured, "psnr", -10.0 * (d * d).log10());
    // Everything above 1 looks alike.
    let clipped = measure(&Image::filled(12, 12, 3, 7.0), Image::filled(12, 12, 3, 3.0));
    assert_eq!(clipped.values["psnr"], None, "equal after tone mapping");
    assert_value(&clipped, "ssim", 1.0);
}

#[test]
fn ssim_of_two_constants_is_the_luminance_term() {
    let measured = measure(&Image::filled(16, 16, 3, 0.25), Image::filled(16, 16, 3, 0.5));
    let (x, y) = (srgb_curve(0.25), srgb_curve(0.5));
    assert_value(&measured, "ssim", (2.0 * x * y + 1e-4) / (x * x + y * y + 1e-4));
}

#[test]
fn ssim_of_an_inverted_pattern_is_negative() {
    let sign = |x: usize, y: usize| if (x + y).is_multiple_of(2) { 1.0 } else { 0.0 };
    let test = Image::from_fn(32, 32, 3, |_, x, y| sign(x, y));
    let measured = measure(&test, test.map(|v| 1.0 - v));
    assert!(measured.values["ssim"].unwrap() < -0.9);
}

/// v·(½f″(r)·N − 2f′(r)·y) for f = 1/(r²+ε).
fn second_order(r: f64, v: f64, y: f64, numerator: f64) -> f64 {
    let f = 1.0 / (r * r + EPSILON);
    let (slope, curvature) = (-2.0 * r * f * f, (6.0 * r * r - 2.0 * EPSILON) * f.powi(3));
    v * (0.5 * curvature * numerator - 2.0 * slope * y)
}

#[test]
fn energy_is_the_ratio_of_means_over_pixels_that_are_whole_in_both_images() {
    // Over all channels together: of the mean of the channels' own ratios it would be 1.
    let truth = Image::from_fn(4, 3, 3, |c, _, _| [1.0, 2.0, 3.0][c]);
    let mut test = Image::from_fn(4, 3, 3, |c, _, _| [1.5, 2.0, 1.5][c]);
    let measured = measure(&test, truth.clone());
    assert_value(&measured, "energy", 5.0 / 6.0);
    assert!(!measured.reference_se.contains_key("energy"), "an exact truth adds nothing");
    // A pixel with one channel that is no number is left out whole.
    test.set(0, 1, 1, f32::NAN);
    test.set(1, 1, 1, 1e6);
    assert_value(&measure(&test, truth.clone()), "energy", 5.0 / 6.0);
    assert_eq!(measure(&truth, truth.map(|_| 0.0)).values["energy"], None, "nothing to compare with");
    assert_eq!(metric("energy").unwrap().better, Better::CloserTo(1.0));
    assert_eq!(Better::CloserTo(1.0).to_string(), "closer to 1");
}

#[test]
fn the_reference_moves_the_energy_by_the_relative_error_of_its_mean() {
    // Means 0.5 off to either side of 1.5 in every pixel of one block; twice the light.
    let halves = with_halves(Image::filled(4, 4, 3, 1.0), Image::filled(4, 4, 3, 2.0));
    let measured = Measurer::new(&halves, None).unwrap().measure(&Image::filled(4, 4, 3, 3.0)).unwrap();
    assert_value(&measured, "energy", 2.0);
    assert!((measured.reference_se["energy"] - 2.0 * 0.5 / 1.5).abs() < 1e-9);
    // Standard deviation 0.5 per value over 16 pixels whose channels may err alike.
    let varied = with_variance(Image::filled(4, 4, 3, 1.0), Image::filled(4, 4, 3, 0.25));
    let measured = Measurer::new(&varied, None).unwrap().measure(&Image::filled(4, 4, 3, 3.0)).unwrap();
    assert!((measured.reference_se["energy"] - 3.0 * 0.5 / 4.0).abs() < 1e-9);
}

#[test]
fn halves_take_the_product_of_residuals() {
    let reference = with_halves(Image::filled(4, 4, 3, 1.0), Image::filled(4, 4, 3, 2.0));
    let measurer = Measurer::new(&reference, None).unwrap();
    assert_eq!(measurer.squared_error(), SquaredError::Halves);
    let measured = measurer.measure(&Image::filled(4, 4, 3, 3.0)).unwrap();
    assert_value(&measured, "mse", 2.0);
    // v = 0.25, y = x − r = 1.5, N = 2: less v·(½f″N − 2f′y).
    let bias = second_order(1.5, 0.25, 1.5, 2.0);
    assert_value(&measured, "relmse", 2.0 / (2.25 + EPSILON) - bias);
    assert!((measured.reference["relmse"].bias - bias).abs() < 1e-6, "{bias}");
    assert_eq!(measurer.bias_correction(), "second-order expansion in the reference's variance");
    let between = measurer.measure(&Image::filled(4, 4, 3, 1.5)).unwrap();
    assert_value(&between, "mse", -0.25);
    assert_value(&between, "rmse", 0.0);
    // The reference is 0.5 ± 0.5 off in every pixel; (x−r)(A−B) = −1.5 for x = 3, all in one block.
    assert!((measured.reference_se["mse"] - 1.5).abs() < 1e-9);
    let moved = (2.0f64 + 1.5).sqrt() - 2f64.sqrt();
    assert!((measured.reference_se["rmse"] - moved).abs() < 1e-9);
}

#[test]
fn a_variance_is_subtracted() {
    let reference = with_variance(Image::filled(4, 4, 3, 1.0), Image::filled(4, 4, 3, 0.25));
    let measurer = Measurer::new(&reference, None).unwrap();
    assert_eq!(measurer.squared_error(), SquaredError::SubtractVariance);
    let measured = measurer.measure(&Image::filled(4, 4, 3, 2.0)).unwrap();
    assert_value(&measured, "mse", 0.75);
    // 4·1·0.25 − 2·0.25² = 0.875 per value; 16 pixels, their channels counted as one.
    assert!((measured.reference_se["mse"] - (0.875f64 / 16.0).sqrt()).abs() < 1e-9);
    let bias = second_order(1.0, 0.25, 1.0, 0.75);
    assert!((measured.reference["relmse"].bias - bias).abs() < 1e-6, "{bias}");
    assert_value(&measured, "relmse", 0.75 / 1.01 - bias);
    assert!((measurer.floor()["mse"] - (2.0 * 0.0625f64 / 16.0).sqrt()).abs() < 1e-9);
}

#[test]
fn non_finite_pixels_are_counted_and_left_out() {
    let truth = Image::filled(30, 20, 3, 0.5);
    let mut test = Image::filled(30, 20, 3, 0.75);
    test.set(1, 4, 4, f32::NAN);
    test.set(2, 4, 4, f32::INFINITY);
    test.set(0, 9, 9, f32::NEG_INFINITY);
    let measured = measure(&test, truth.clone());
    assert_eq!((measured.non_finite_values, measured.pixels, measured.pixels_of), (3, 598, 600));
    let clean = measure(&Image::filled(30, 20, 3, 0.75), truth.clone());
    for m in METRICS {
        assert!((measured.values[m.id].unwrap() - clean.values[m.id].unwrap()).abs() < 1e-9, "{}", m.id);
    }
}

#[test]
fn without_a_common_pixel_there_is_no_measure() {
    let (truth, nan) = (Image::filled(30, 20, 3, 0.5), Image::filled(30, 20, 3, f32::NAN));
    let exact = Reference::exact(truth.clone());
    let measurer = Measurer::new(&exact, None).unwrap();
    assert_eq!(measurer.measure(&nan).unwrap_err(), MetricError::NoCommonPixel { pixels: 600 });
    let error = Measurer::new(&Reference::exact(nan.clone()), None).unwrap_err();
    assert_eq!(error, MetricError::NoReferencePixel { pixels: 600 });
    assert!(error.to_string().contains("no common pixel"), "{error}");
    // Each has a finite half, and not the same one.
    let half =
        |left: bool| Image::from_fn(30, 20, 3, |_, x, _| if (x < 15) == left { 0.5 } else { f32::NAN });
    let reference = Reference::exact(half(true));
    let measurer = Measurer::new(&reference, None).unwrap();
    assert!(matches!(measurer.measure(&half(false)), Err(MetricError::NoCommonPixel { .. })));
    assert_eq!(measurer.measure(&half(true)).unwrap().pixels, 300);
}

#[test]
fn classes_are_measured_apart() {
    let truth = Image::filled(8, 8, 3, 0.5);
    let test = Image::from_fn(8, 8, 3, |_, x, _| if x < 4 { 0.75 } else { 1.0 });
    let names = ["left".to_owned(), "right".to_owned(), "nowhere".to_owned()];
    let of_pixel: Vec<u8> = (0..64).map(|p| u8::from(p % 8 >= 4)).collect();
    let reference = Reference::exact(truth);
    let classes = Classes { names: &names, of_pixel: &of_pixel };
    let measured = Measurer::new(&reference, Some(classes)).unwrap().measure(&test).unwrap();
    assert_eq!(measured.classes["left"]["mse"], Some(0.0625));
    assert_eq!(measured.classes["right"]["mse"], Some(0.25));
    assert!(!measured.classes.contains_key("nowhere"));
    let short = Classes { names: &names, of_pixel: &of_pixel[1..] };
    assert!(matches!(Measurer::new(&reference, Some(short)), Err(MetricError::ClassMap { got: 63, .. })));
    let unnamed = Classes { names: &names[..1], of_pixel: &of_pixel };
    assert!(matches!(
        Measurer::new(&reference, Some(unnamed)),
        Err(MetricError::ClassIndex { pixel: 4, .. })
    ));
}

#[test]
fn every_metric_of_the_table_is_measured_at_any_size() {
    for (w, h) in [(1, 1), (1, 3), (7, 1), (33, 47)] {
        let test = Image::from_fn(w, h, 3, |c, x, y| (c + x + y) as f32 * 0.01);
        let measured = measure(&test, Image::filled(w, h, 3, 0.5));
        let ids: Vec<&str> = METRICS.iter().map(|m| m.id).collect();
        assert!(measured.values.len() == ids.len() && ids.iter().all(|id| measured.values.contains_key(*id)));
        let undefined = if w * h == 1 { 1 } else { 0 };
        assert_eq!(measured.values.values().filter(|v| v.is_none()).count(), undefined, "{w}×{h}");
    }
    assert_eq!(metric("relmse").unwrap().epsilon, Some(EPSILON));
    assert!(metric("relmse").unwrap().formula_text().contains("ε = 0.01"));
    assert!(metric("relmse_trimmed").unwrap().formula_text().contains("noise removed"));
    assert!(metric("rms").unwrap_err().to_string().contains("mse, rmse, relmse"));
}

#[test]
fn shapes_must_agree() {
    let reference = Reference::exact(Image::filled(4, 4, 3, 0.5));
    let measurer = Measurer::new(&reference, None).unwrap();
    let error = measurer.measure(&Image::filled(4, 5, 3, 0.5)).unwrap_err();
    assert_eq!(error.to_string(), "test image is 4×5×3, expected 4×4×3");
    assert!(Measurer::new(&Reference::exact(Image::filled(4, 4, 1, 0.5)), None).is_err());
}

#[test]
fn error_maps_average_to_their_metrics() {
    let reference =
        with_halves(Image::from_fn(9, 7, 3, |c, x, _| (c + x) as f32 * 0.1), Image::filled(9, 7, 3, 0.4));
    let test = Image::from_fn(9, 7, 3, |_, x, y| (x * y) as f32 * 0.02);
    let measured = Measurer::new(&reference, None).unwrap().measure(&test).unwrap();
    for (kind, id) in [(ErrorKind::Squared, "mse"), (ErrorKind::RelativeSquared, "relmse")] {
        let map = error_map(&test, &reference, kind).unwrap();
        let mean = map.data().iter().map(|&v| f64::from(v)).sum::<f64>() / 63.0;
        assert!((mean - measured.values[id].unwrap()).abs() < 1e-6, "{id}");
    }
    let one = Reference::exact(Image::filled(1, 1, 3, 1.0));
    let map = |kind| error_map(&Image::filled(1, 1, 3, 0.5), &one, kind).unwrap().data()[0];
    assert_eq!((map(ErrorKind::Signed), map(ErrorKind::Absolute)), (-0.5, 0.5));
    assert!((map(ErrorKind::Relative) - 0.5 / 1.01f32.sqrt()).abs() < 1e-6);
}

#[test]
fn bootstrap_of_a_uniform_error_has_no_spread_and_tiny_images_have_none() {
    let reference = Reference::exact(Image::filled(96, 64, 3, 0.5));
    let measurer = Measurer::new(&reference, None).unwrap();
    let se = block_bootstrap(&measurer, &Image::filled(96, 64, 3, 0.75), 50, 1).unwrap();
    assert!(se["mse"] < 1e-15 && se["psnr"] < 1e-9);
    let small = Reference::exact(Image::filled(20, 20, 3, 0.5));
    let measurer = Measurer::new(&small, None).unwrap();
    assert!(block_bootstrap(&measurer, &Image::filled(20, 20, 3, 0.75), 50, 1).unwrap().is_empty());
}

#[test]
fn bootstrap_error_is_that_of_a_mean_over_blocks() {
    // 6×4 blocks of 32×32 pixels whose squared error is 0 or 1: the standard error of a mean of 24 such
    // values with 12 ones.
    let reference = Reference::exact(Image::filled(192, 128, 3, 0.0));
    let test = Image::from_fn(192, 128, 3, |_, x, y| ((x / 32 + y / 32) % 2) as f32);
    let measurer = Measurer::new(&reference, None).unwrap();
    let replicates = 2000;
    let se = block_bootstrap(&measurer, &test, replicates, 7).unwrap()["mse"];
    let expected = (0.25f64 / 24.0).sqrt();
    // A standard deviation over m draws has a relative standard error of about 1/√(2m).
    assert!((se / expected - 1.0).abs() < 4.0 / (2.0 * replicates as f64).sqrt(), "{se} {expected}");
}
