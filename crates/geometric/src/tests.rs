mod citations;

use noisefloor_conformance::assert_conforms;
use noisefloor_denoiser::{DenoiseError, Denoiser, Diagnostic, Diagnostics, Input, Need};
use noisefloor_frame::{Estimate, FeatureId, Frame, Image, Moments, Samples, Sampling, Variance};

use crate::*;

fn off() -> CorrectedParams {
    CorrectedParams {
        material: Material::Off,
        depth_test: false,
        normal_test: false,
        ..CorrectedParams::default()
    }
}

/// Radius is `radius` everywhere, whatever the frame: the trace of its variance is 1.
fn fixed_radius(radius: f64) -> CorrectedParams {
    CorrectedParams { spread: Spread::StdOfMean, multiplier: 1.0, pixels_per_error: radius, ..off() }
}

fn frame(mean: Image, variance_per_channel: f32) -> Frame {
    let variance = Image::filled(mean.width(), mean.height(), 3, variance_per_channel);
    let color = Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: None };
    Frame::from_color(color, Samples::uniform(4), Sampling::Independent)
}

fn with(mut frame: Frame, id: FeatureId, channels: usize, value: impl Fn(usize, usize) -> f32) -> Frame {
    let image = Image::from_fn(frame.width(), frame.height(), channels, |c, x, _| value(c, x));
    frame.features.insert(id, Estimate::from_mean(image));
    frame
}

/// Uniforms in [0, 1) by SplitMix64.
fn uniforms(seed: u64) -> impl Iterator<Item = f64> {
    (1u64..).map(move |k| {
        let mut z = seed.wrapping_mul(0x2545_F491_4F6C_DD1D) ^ k.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    })
}

/// Standard normals by Box and Muller.
fn normals(seed: u64) -> impl Iterator<Item = f64> {
    let mut u = uniforms(seed);
    std::iter::from_fn(move || {
        let (a, b) = (u.next()?, u.next()?);
        Some((-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos())
    })
}

fn random_image(width: usize, height: usize, seed: u64) -> Image {
    let mut u = uniforms(seed);
    Image::from_fn(width, height, 3, |_, _, _| u.next().unwrap_or(0.5) as f32)
}

fn run(params: CorrectedParams, frame: &Frame) -> Image {
    GeometricCorrected::new(params).unwrap().denoise(&Input::new(frame)).unwrap().image
}

/// Equal up to the rounding of a weighted mean of equal values.
#[track_caller]
fn assert_unmixed(out: &Image, expected: &Image) {
    for (i, (&value, &expected)) in out.data().iter().zip(expected.data()).enumerate() {
        assert!(
            (value - expected).abs() <= 4.0 * f32::EPSILON * expected.abs(),
            "{i}: {value}, not {expected}"
        );
    }
}

#[test]
fn both_conform() {
    assert_conforms(&GeometricCorrected::default());
    // By its letter hardly any frame has an answer; without this test most have.
    let params = AsWrittenParams { normal_test: false, ..AsWrittenParams::default() };
    assert_conforms(&GeometricAsWritten::new(params).unwrap());
}

#[test]
fn constant_image_is_unchanged() {
    let constant = Image::filled(21, 17, 3, 0.7);
    let f = frame(constant.clone(), 0.3);
    assert_unmixed(&run(fixed_radius(7.3), &f), &constant);
}

#[test]
fn zero_variance_gives_the_same_bits() {
    let f = frame(random_image(19, 13, 1), 0.0);
    assert_eq!(run(off(), &f), f.color.mean);
}

#[test]
fn output_lies_between_the_least_and_largest_value_of_the_window() {
    let f = frame(random_image(23, 18, 2), 1.0 / 3.0);
    let radius = 3.5;
    let out = run(fixed_radius(radius), &f);
    assert_ne!(out, f.color.mean);
    for c in 0..3 {
        for (y, x) in (0..18usize).flat_map(|y| (0..23usize).map(move |x| (y, x))) {
            let window = (y.saturating_sub(3)..(y + 4).min(18))
                .flat_map(|qy| (x.saturating_sub(3)..(x + 4).min(23)).map(move |qx| (qx, qy)))
                .map(|(qx, qy)| f.color.mean.get(c, qx, qy));
            let (low, high) = window.fold((f32::MAX, f32::MIN), |(l, h), v| (l.min(v), h.max(v)));
            let value = out.get(c, x, y);
            assert!(low <= value && value <= high, "{value} at ({x}, {y}) outside [{low}, {high}]");
        }
    }
}

#[test]
fn radius_one_and_a_half_weighs_centre_sides_and_diagonals_as_a_cone() {
    // The response to a single bright pixel shows the weight with which each pixel takes it in.
    let f = frame(Image::from_fn(5, 5, 3, |_, x, y| f32::from(x == 2 && y == 2)), 1.0 / 3.0);
    let out = run(fixed_radius(1.5), &f);
    let diagonal = 1.0 - 2f64.sqrt() / 1.5;
    let sum = 1.0 + 4.0 / 3.0 + 4.0 * diagonal;
    for (x, y, weight) in [(2, 2, 1.0), (1, 2, 1.0 / 3.0), (2, 3, 1.0 / 3.0), (1, 1, diagonal), (4, 2, 0.0)] {
        let got = f64::from(out.get(0, x, y));
        assert!((got - weight / sum).abs() < 1e-6, "({x}, {y}): {got} instead of {}", weight / sum);
    }
}

#[test]
fn an_id_change_a_depth_step_or_a_turned_normal_stops_all_exchange() {
    let left = |x: usize| x < 10;
    let halves = Image::from_fn(20, 9, 3, |_, x, _| if left(x) { 0.2 } else { 5.0 });
    let base = frame(halves.clone(), 1.0 / 3.0);
    assert_ne!(run(fixed_radius(6.0), &base), halves, "without features the step is blurred");

    let ids = with(base.clone(), FeatureId::Material, 1, |_, x| if left(x) { 3.0 } else { 4.0 });
    assert_unmixed(&run(CorrectedParams { material: Material::Ids, ..fixed_radius(6.0) }, &ids), &halves);

    let step = with(base.clone(), FeatureId::Depth, 1, |_, x| if left(x) { 1.0 } else { 1.03 });
    assert_unmixed(&run(CorrectedParams { depth_test: true, ..fixed_radius(6.0) }, &step), &halves);

    // Left normal (1,0,0)·0.3, right (0,1,1)·0.3: perpendicular. Lengths other than 1 must not matter.
    let turned = with(base, FeatureId::Normal, 3, |c, x| if left(x) == (c == 0) { 0.3 } else { 0.0 });
    assert_unmixed(&run(CorrectedParams { normal_test: true, ..fixed_radius(6.0) }, &turned), &halves);
}

#[test]
fn background_exchanges_with_background_whatever_its_depth_and_never_with_a_surface() {
    let mean = Image::from_fn(12, 1, 3, |_, x, _| [1.0, 3.0, 9.0, 9.5][x / 3]);
    let base = frame(mean.clone(), 1.0 / 3.0);
    let params = CorrectedParams { depth_test: true, ..fixed_radius(3.0) };

    // Without ids: depth 0 is background; depths of 1.00 and 1.01 are alike.
    let depth = |_, x: usize| [0.0, 0.0, 1.0, 1.01][x / 3];
    let out = run(params.clone(), &with(base.clone(), FeatureId::Depth, 1, depth));
    assert!(out.get(0, 2, 0) > 1.0 && out.get(0, 3, 0) < 3.0, "sky exchanges with sky");
    assert!(out.get(0, 8, 0) > 9.0, "like depths exchange");
    assert!(out.get(0, 5, 0) <= 3.0 && out.get(0, 6, 0) >= 9.0, "no exchange between sky and surface");

    // With ids: the sky's depths are never read, not even infinite ones.
    let ids = CorrectedParams { material: Material::Ids, ..params };
    let sky = with(base, FeatureId::Material, 1, |_, x| if x < 6 { -1.0 } else { 7.0 });
    let wild = with(sky, FeatureId::Depth, 1, |_, x| [f32::INFINITY, 55.0, 1.0, 1.01][x / 3]);
    assert_eq!(run(ids, &wild), out);
}

#[test]
fn the_radius_has_its_three_meanings() {
    let n = 16.0;
    let mean = Image::filled(1, 1, 3, 0.49); // luminance 0.49
    let f = Frame {
        samples: Samples::uniform(16),
        ..frame(mean, 0.0004) // trace 0.0012
    };
    let radius = |spread| {
        let params = CorrectedParams {
            spread,
            radius_max_px: 64.0,
            luminance_floor: 0.01,
            floor_unit: FloorUnit::Radiance,
            ..off()
        };
        f64::from(radius::corrected(&f, &params).unwrap()[0])
    };
    let root = 0.0012f64.sqrt();
    for (spread, expected) in [
        (Spread::SampleVariance, 2.0 * n * 0.0012),
        (Spread::StdOfMean, 2.0 * 5.0 * root),
        (Spread::Relative, 2.0 * 5.0 * root / 0.5),
    ] {
        let got = radius(spread);
        assert!((got / expected - 1.0).abs() < 1e-5, "{spread:?}: {got} instead of {expected}");
    }
    let capped = radius::corrected(&f, &CorrectedParams { radius_max_px: 0.5, ..off() }).unwrap();
    assert_eq!(capped, [0.5]);
}

#[test]
fn relative_radius_ignores_the_exposure() {
    let f = frame(random_image(16, 11, 5), 0.002);
    let factor = 1024.0;
    let mut brighter = f.clone();
    brighter.color.mean = f.color.mean.map(|v| v * factor);
    brighter.color.variance = f
        .color
        .variance
        .clone()
        .map(|v| Variance::of_mean(v.into_mean_variance().map(|v| v * factor * factor)));
    let expected = run(off(), &f).map(|v| v * factor);
    assert_ne!(run(CorrectedParams { pixels_per_error: 20.0, ..off() }, &f), f.color.mean);
    assert_eq!(run(off(), &brighter), expected);
    // A floor in radiance is an absolute number: the result is the same only if it is scaled along.
    let floor =
        |floor: f64| CorrectedParams { luminance_floor: floor, floor_unit: FloorUnit::Radiance, ..off() };
    let expected = run(floor(0.01), &f).map(|v| v * factor);
    assert_eq!(run(floor(0.01 * f64::from(factor)), &brighter), expected);
    assert_ne!(run(floor(0.01), &brighter), expected);
}

#[test]
fn the_floor_is_a_share_of_the_median_of_what_is_lit() {
    // Luminances 0, 0, 1, 2, 3, 400: the lower middle of the lit ones is 2.
    let mean = Image::from_fn(6, 1, 3, |_, x, _| [0.0, 0.0, 1.0, 2.0, 3.0, 400.0][x]);
    let params = CorrectedParams { radius_max_px: 64.0, luminance_floor: 0.5, ..off() };
    let radii = radius::corrected(&frame(mean, 0.0012), &params).unwrap();
    for (pixel, level) in [(0, 1.0), (2, 2.0), (5, 401.0)] {
        let expected = 2.0 * 5.0 * (3.0f64 * 0.0012).sqrt() / level;
        assert!((f64::from(radii[pixel]) / expected - 1.0).abs() < 1e-5, "{pixel}: {}", radii[pixel]);
    }
    let black = radius::corrected(&frame(Image::new(2, 1, 3), 0.0), &off()).unwrap();
    assert_eq!(black, [0.0, 0.0], "nothing is lit and nothing is noisy");
}

#[test]
fn albedo_stands_in_for_ids_and_bounds_a_lamp() {
    // A lamp in a ceiling: same plane, same normal, another albedo.
    let lamp = |x: usize| x >= 10;
    let mean = Image::from_fn(20, 9, 3, |_, x, _| if lamp(x) { 17.0 } else { 0.2 });
    let tinted = |lamp_albedo: f32| {
        with(frame(mean.clone(), 1.0 / 3.0), FeatureId::Albedo, 3, move |c, x| match lamp(x) {
            true => lamp_albedo,
            false => [0.7, 0.71, 0.72][c],
        })
    };
    let params = CorrectedParams { material: Material::Albedo, ..fixed_radius(6.0) };
    for albedo in [0.0, 0.6, 1.0, 17.0] {
        assert_unmixed(&run(params.clone(), &tinted(albedo)), &mean);
    }
    // Below a tenth: 0.65 beside 0.72 at most.
    assert!(run(params, &tinted(0.655)).get(0, 9, 4) > 0.3);
}

#[test]
fn ids_and_albedo_are_each_others_way_out_and_without_both_there_is_none() {
    let bare = frame(random_image(4, 4, 1), 0.1);
    let bare = with(with(bare, FeatureId::Depth, 1, |_, _| 1.0), FeatureId::Normal, 3, |_, _| 1.0);
    for (material, own, other, way) in [
        (Material::Albedo, FeatureId::Albedo, FeatureId::Material, "material=ids"),
        (Material::Ids, FeatureId::Material, FeatureId::Albedo, "material=albedo"),
    ] {
        let refusal = |f: &Frame| {
            let params = CorrectedParams { material, ..CorrectedParams::default() };
            let method = GeometricCorrected::new(params).unwrap();
            method.denoise(&Input::new(f)).unwrap_err().to_string()
        };
        let needs = format!("geometric-corrected needs feature `{own}`");
        assert_eq!(refusal(&bare), needs);
        let channels = if other == FeatureId::Albedo { 3 } else { 1 };
        let one = with(bare.clone(), other, channels, |_, _| 0.5);
        assert_eq!(refusal(&one), format!("{needs}; it does without with {way}"));
    }
}

#[test]
fn literal_pseudo_code_turns_a_constant_image_negative() {
    let color = 0.5f32;
    let mut f = frame(Image::filled(3, 3, 3, color), 0.0);
    for (id, channels, value) in
        [(FeatureId::Material, 1, 1.0), (FeatureId::Depth, 1, 2.0), (FeatureId::Normal, 3, 0.0)]
    {
        f = with(f, id, channels, |c, _| if channels == 3 && c == 2 { 1.0 } else { value });
    }
    // R = 2·variance of one sample = 2: variance of the mean 1/12 per channel, 4 samples, unbiased.
    f.color.variance = Some(Variance::of_mean(Image::filled(3, 3, 3, 1.0 / 12.0)));
    let params = AsWrittenParams {
        variance_form: Recurrence::Unbiased,
        normal_threshold: 1.0,
        ..AsWrittenParams::default()
    };
    let out = GeometricAsWritten::new(params).unwrap().denoise(&Input::new(&f)).unwrap().image;
    let sum = 0.5 + 4.0 * (1.0 - 2f64.sqrt()) / 2.0;
    let expected = (1.0 + sum) / sum;
    assert!((expected + 2.045).abs() < 1e-3);
    let got = f64::from(out.get(1, 1, 1) / color);
    assert!((got - expected).abs() < 1e-5, "{got} instead of {expected}");
}

#[test]
fn literal_pseudo_code_counts_the_pixels_where_it_is_undefined() {
    let plain = AsWrittenParams {
        material_ids: false,
        depth_test: false,
        normal_test: false,
        variance_form: Recurrence::Unbiased,
        ..AsWrittenParams::default()
    };
    // One pixel of zero variance: R = 0, weight 1/0.
    let mut f = frame(Image::filled(4, 3, 3, 1.0), 0.05);
    let mut variance = Image::filled(4, 3, 3, 0.05);
    (0..3).for_each(|c| variance.set(c, 2, 1, 0.0));
    f.color.variance = Some(Variance::of_mean(variance));
    let error = GeometricAsWritten::new(plain.clone()).unwrap().denoise(&Input::new(&f)).unwrap_err();
    assert!(matches!(error, DenoiseError::Undefined { pixels: 1, x: 2, y: 1, .. }), "{error}");

    // R = 1.2 reaches the 4-neighbours, whose weight is zero; without the centre the sum is zero everywhere.
    let f = frame(Image::filled(4, 3, 3, 1.0), 0.05);
    let skips = AsWrittenParams { visits_center: false, ..plain };
    let error = GeometricAsWritten::new(skips).unwrap().denoise(&Input::new(&f)).unwrap_err();
    assert!(matches!(error, DenoiseError::Undefined { pixels: 12, x: 0, y: 0, .. }), "{error}");
}

#[test]
fn literal_pseudo_code_skips_the_similar_normals() {
    let mean = Image::from_fn(3, 3, 3, |_, x, y| 1.0 + (x + 3 * y) as f32);
    let f = with(frame(mean.clone(), 1.0 / 12.0), FeatureId::Normal, 3, |c, _| f32::from(c == 2));
    let params = AsWrittenParams {
        material_ids: false,
        depth_test: false,
        variance_form: Recurrence::Unbiased,
        ..AsWrittenParams::default()
    };
    // All normals are equal, so all neighbours and the centre itself are skipped and the sum stays zero.
    let error = GeometricAsWritten::new(params).unwrap().denoise(&Input::new(&f)).unwrap_err();
    assert!(matches!(error, DenoiseError::Undefined { pixels: 9, .. }), "{error}");
}

/// Runs 10⁴ streams of 64 standard normals (one component) and returns what each recurrence gives on average after
/// `n` samples, with its standard error.
fn mean_over_streams(n: usize, of: impl Fn(&recurrence::Incremental) -> f64) -> (f64, f64) {
    let mut source = normals(77);
    let mut moments = Moments::<1>::default();
    for _ in 0..10_000 {
        let mut incremental = recurrence::Incremental::default();
        for _ in 0..n {
            incremental.push([source.next().unwrap_or(0.0), 0.0, 0.0]);
        }
        moments.push([of(&incremental)]);
    }
    (moments.mean()[0], moments.mean_variance().map_or(0.0, |v| v[0].sqrt()))
}

#[test]
fn recurrences_have_the_derived_expectations() {
    let forms =
        [Recurrence::Unbiased, Recurrence::Population, Recurrence::UpdatedMean, Recurrence::PreviousMean];
    for form in forms {
        let (mean, error) = mean_over_streams(64, |i| i.corrected(form).unwrap_or(0.0));
        let expected = form.expected_factor(64);
        assert!((mean - expected).abs() < 4.0 * error, "{form:?}: {mean} ± {error}, expected {expected}");
        assert!((mean / expected - 1.0).abs() < 0.01);
    }
    let close = |form: Recurrence, deviation: f64| (form.expected_factor(64) - 1.0 - deviation).abs() < 5e-4;
    assert!(close(Recurrence::UpdatedMean, -0.074) && close(Recurrence::PreviousMean, 0.058));
}

#[test]
fn printed_parentheses_grow_like_a_factorial() {
    for (n, low, high) in [(4, 1.5, 2.5), (8, 1.0e3, 4.0e3), (16, 1.0e11, 1.0e12)] {
        let (mean, _) = mean_over_streams(n, recurrence::Incremental::as_written);
        assert!((low..high).contains(&mean), "n = {n}: {mean}");
    }
}

#[test]
fn product_recurrence_is_the_two_pass_definition() {
    let mut source = normals(3);
    let samples: Vec<[f64; 3]> =
        (0..50).map(|_| [0, 1, 2].map(|_| 3.0 + source.next().unwrap_or(0.0))).collect();
    let mut incremental = recurrence::Incremental::default();
    samples.iter().for_each(|&s| incremental.push(s));
    let expected = recurrence::two_pass(&samples);
    let got = incremental.corrected(Recurrence::Population).unwrap();
    assert!((got / expected - 1.0).abs() < 1e-12);
    assert_eq!(incremental.count(), 50);
    assert!((incremental.mean()[2] - samples.iter().map(|s| s[2]).sum::<f64>() / 50.0).abs() < 1e-12);
}

#[test]
fn harmonic_series_joins_its_asymptote_without_a_step() {
    // N·(1 − factor) = H_N for the updated mean.
    let h = |n: u32| f64::from(n) * (1.0 - Recurrence::UpdatedMean.expected_factor(n));
    assert!((h(513) - h(512) - 1.0 / 513.0).abs() < 1e-10);
}

#[test]
fn denoising_twice_during_accumulation_leaves_the_accumulators_alone() {
    let samples: Vec<[f64; 3]> = uniforms(8).take(64).map(|u| [u, u * u, 1.0 - u]).collect();
    let accumulate = |look: bool| {
        let mut moments: Vec<Moments<3>> = vec![Moments::default(); 16];
        for (k, sample) in samples.iter().enumerate() {
            for (p, m) in moments.iter_mut().enumerate() {
                m.push(sample.map(|v| v + p as f64));
            }
            if look && (k == 20 || k == 40) {
                let mean = Image::from_fn(4, 4, 3, |c, x, y| moments[4 * y + x].mean()[c] as f32);
                let spread = |c: usize, x: usize, y: usize| {
                    moments[4 * y + x].mean_variance().map_or(0.0, |v| v[c] as f32)
                };
                let variance = Some(Variance::of_mean(Image::from_fn(4, 4, 3, spread)));
                let color = Estimate { mean, variance, halves: None };
                let f = Frame::from_color(color, Samples::uniform(k as u32 + 1), Sampling::Independent);
                let before = f.clone();
                assert_ne!(run(CorrectedParams { pixels_per_error: 20.0, ..off() }, &f), f.color.mean);
                assert_eq!(f, before, "the input is not written to");
            }
        }
        moments
    };
    assert_eq!(accumulate(true), accumulate(false));
}

#[test]
fn missing_inputs_are_named_before_any_work() {
    let f = Frame::from_color(
        Estimate::from_mean(Image::new(4, 4, 3)),
        Samples::uniform(1),
        Sampling::Independent,
    );
    for (method, material) in [
        (&GeometricCorrected::default() as &dyn Denoiser, FeatureId::Albedo),
        (&GeometricAsWritten::default(), FeatureId::Material),
    ] {
        let all = [
            Need::ColorVariance,
            Need::Samples(2),
            Need::Feature(material),
            Need::Feature(FeatureId::Depth),
            Need::Feature(FeatureId::Normal),
        ];
        match method.denoise(&Input::new(&f)) {
            Err(DenoiseError::MissingInputs { missing, .. }) => assert_eq!(missing, all),
            other => panic!("{other:?}"),
        }
    }
    let relaxed = GeometricCorrected::new(off()).unwrap().card();
    assert_eq!(relaxed.needs, [Need::ColorVariance, Need::Samples(2)]);
}

#[test]
fn parameters_out_of_range_are_named() {
    let bad = |change: fn(&mut CorrectedParams)| {
        let mut params = CorrectedParams::default();
        change(&mut params);
        GeometricCorrected::new(params).unwrap_err()
    };
    assert_eq!(bad(|p| p.multiplier = -1.0).parameter, "multiplier");
    assert_eq!(bad(|p| p.pixels_per_error = f64::NAN).parameter, "pixels_per_error");
    assert_eq!(bad(|p| p.luminance_floor = 0.0).parameter, "luminance_floor");
    assert_eq!(bad(|p| p.albedo_threshold = 1.5).parameter, "albedo_threshold");
    assert_eq!(bad(|p| p.radius_max_px = 65.0).parameter, "radius_max_px");
    assert_eq!(bad(|p| p.normal_threshold = 1.1).parameter, "normal_threshold");
    let literal = AsWrittenParams { depth_threshold: -0.1, ..AsWrittenParams::default() };
    assert_eq!(GeometricAsWritten::new(literal).unwrap_err().parameter, "depth_threshold");
}

#[test]
fn diagnostics_show_the_kernel_radius() {
    let f = frame(random_image(9, 7, 4), 0.01);
    let method = GeometricCorrected::new(off()).unwrap();
    let plain = method.denoise(&Input::new(&f)).unwrap();
    assert!(plain.diagnostics.is_empty());
    let input = Input::new(&f).with_diagnostics(Diagnostics::On { probe: None });
    let full = method.denoise(&input).unwrap();
    assert_eq!(full.image, plain.image);
    let Diagnostic { name, image: radius, .. } = &full.diagnostics[0];
    assert_eq!(name, "kernel radius");
    let largest = radius.data().iter().copied().fold(0.0, f32::max);
    let told = plain.figures.iter().find(|f| f.name == "largest kernel radius, px").unwrap();
    assert_eq!(told.value, f64::from(largest));
}
