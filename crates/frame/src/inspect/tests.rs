use crate::*;

/// A generator of uniform numbers in (0, 1).
fn uniform(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as f64 + 0.5) / (1u64 << 31) as f64
    }
}

const SIZE: (usize, usize) = (40, 30);

/// Independent samples of a law per pixel and channel, with the weights of a film per pixel and sample.
fn drawn(n: u32, seed: u64, law: fn(&mut dyn FnMut() -> f64) -> f64, weighted: bool) -> Frame {
    let mut random = uniform(seed);
    let blank = Image::new(SIZE.0, SIZE.1, 3);
    let mut planes = [blank.clone(), blank.clone(), blank.clone(), blank];
    for pixel in 0..SIZE.0 * SIZE.1 {
        let mut sums = [[0.0; 4]; 2]; // weight and weighted channels of both halves
        let mut all = Moments::<3>::default();
        for k in 0..n {
            let weight = if weighted { 0.2 + random() } else { 1.0 };
            let sample: [f64; 3] = std::array::from_fn(|_| law(&mut random) * (1.0 + (pixel % 7) as f64));
            all.push(sample);
            let half = &mut sums[(k % 2) as usize];
            half[0] += weight;
            (0..3).for_each(|c| half[c + 1] += weight * sample[c]);
        }
        for c in 0..3 {
            let [a, b] = sums.map(|half| (half[c + 1], half[0]));
            planes[0].plane_mut(c)[pixel] = ((a.0 + b.0) / (a.1 + b.1)) as f32;
            planes[1].plane_mut(c)[pixel] = all.mean_variance().map_or(0.0, |v| v[c]) as f32;
            planes[2].plane_mut(c)[pixel] = (a.0 / a.1) as f32;
            planes[3].plane_mut(c)[pixel] = if b.1 > 0.0 { (b.0 / b.1) as f32 } else { 0.0 };
        }
    }
    let [mean, variance, a, b] = planes;
    let color = Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: Some([a, b]) };
    Frame::from_color(color, Samples::uniform(n), Sampling::Independent)
}

fn skewed(random: &mut dyn FnMut() -> f64) -> f64 {
    -random().ln()
}

/// Now and then a thousand times as bright.
fn fireflies(random: &mut dyn FnMut() -> f64) -> f64 {
    random().powi(4) * if random() < 1e-3 { 1000.0 } else { 1.0 }
}

fn sound(n: u32) -> Frame {
    drawn(n, u64::from(n), skewed, false)
}

fn scale_variance(frame: &mut Frame, factor: f32) {
    let variance = frame.color.variance.take().unwrap().into_mean_variance();
    frame.color.variance = Some(Variance::of_mean(variance.map(|v| v * factor)));
}

fn halves(frame: &mut Frame) -> &mut [Image; 2] {
    frame.color.halves.as_mut().unwrap()
}

fn inspect(mut frame: Frame) -> Result<Vec<Finding>, FrameError> {
    frame.inspect(Fidelity::Rounded).map(|hygiene| hygiene.findings)
}

fn contradicts(frame: Frame) -> String {
    match inspect(frame) {
        Err(error @ FrameError::Contradiction { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn sound_frames_of_any_sample_count_and_law_give_no_finding() {
    for n in [1, 2, 3, 4, 16, 65] {
        for law in [skewed, fireflies] {
            for seed in 0..12 {
                let frame = drawn(n, 100 + seed, law, false);
                let before = frame.clone();
                let mut after = frame.clone();
                assert_eq!(after.inspect(Fidelity::Rounded).unwrap().findings, [], "{n} {seed}");
                assert_eq!(after, before, "and stay as they are");
            }
        }
    }
}

#[test]
fn rounding_to_half_floats_or_short_mantissas_is_no_contradiction() {
    for bits in [11, 15, 16] {
        let step = 1u32 << (24 - bits);
        let round = |image: &Image| image.map(|v| f32::from_bits((v.to_bits() + step / 2) & !(step - 1)));
        for n in [2, 16, 65] {
            let mut frame = sound(n);
            let color = &mut frame.color;
            color.halves = color.halves.as_ref().map(|halves| halves.each_ref().map(round));
            color.variance = color.variance.as_ref().map(|v| Variance::of_mean(round(v.mean_variance())));
            assert_eq!(inspect(frame.clone()).unwrap(), [], "{bits} bits, {n} samples");
            frame.color.mean = round(&frame.color.mean);
            assert_eq!(inspect(frame).unwrap(), []);
        }
    }
}

#[test]
fn halves_that_do_not_average_to_the_mean_are_an_error_without_a_guess() {
    let mut doubled = sound(16);
    halves(&mut doubled).iter_mut().for_each(|half| *half = half.map(|v| 2.0 * v));
    let mut black_half = sound(16);
    halves(&mut black_half)[1].data_mut().fill(0.0);
    let mut black_mean = sound(16);
    black_mean.color.mean.data_mut().fill(0.0);
    let mut brighter = sound(16);
    brighter.color.mean = brighter.color.mean.map(|v| 1.002 * v);
    let mut one = sound(16);
    one.color.mean.set(1, 7, 5, 1e4);
    for (frame, values) in
        [(doubled, 3600), (black_half, 3600), (black_mean, 3600), (brighter, 3600), (one, 1)]
    {
        let text = contradicts(frame);
        assert!(text.contains("halves do not average to the mean"), "{text}");
        assert!(text.contains(&format!("in {values} of 3600 values")), "{text}");
        assert!(!text.contains("divided"), "{text}");
    }
    let mut one = sound(16);
    one.color.mean.set(1, 7, 5, 1e4);
    assert!(contradicts(one).contains("pixel (7, 5), channel 1"), "the worst value is named");
}

#[test]
fn a_weighted_film_is_no_contradiction_where_the_filter_is_unknown() {
    for n in [4, 16] {
        let mut frame = drawn(n, 5, skewed, true);
        assert_eq!(inspect(frame.clone()).unwrap(), [], "{n}");
        frame.provenance.filter = Some(PixelFilter::Box);
        assert!(contradicts(frame).contains("average"), "a box filter weights nothing");
    }
}

#[test]
fn lossy_files_are_refused_for_gross_contradictions_only() {
    let mut frame = sound(16);
    let mut random = uniform(3);
    halves(&mut frame).iter_mut().for_each(|half| *half = half.map(|v| v * (1.0 + 0.1 * random() as f32)));
    assert!(
        frame.clone().inspect(Fidelity::Lossy).is_ok() && frame.clone().inspect(Fidelity::Rounded).is_err()
    );
    halves(&mut frame)[0].data_mut().fill(0.0);
    assert!(frame.inspect(Fidelity::Lossy).is_err());
}

#[test]
fn halves_of_features_are_checked_too_unless_they_are_no_averages() {
    let mut frame = sound(16);
    let mut albedo = frame.color.clone();
    frame.features.insert(FeatureId::Albedo, albedo.clone());
    frame.features.insert(FeatureId::Material, Estimate::from_mean(Image::new(SIZE.0, SIZE.1, 1)));
    let ids = Image::filled(SIZE.0, SIZE.1, 1, 3.0);
    frame.features.get_mut(&FeatureId::Material).unwrap().halves = Some([ids.clone(), ids]);
    assert!(inspect(frame.clone()).is_ok());
    albedo.halves.as_mut().unwrap()[0] = albedo.mean.map(|v| 3.0 * v);
    frame.features.insert(FeatureId::Albedo, albedo);
    assert!(contradicts(frame).contains("`albedo`"));
}

#[test]
fn a_variance_that_disagrees_with_the_halves_is_found_whatever_the_factor() {
    for (n, factor, guess) in [
        (16, 16.0, "variance of one sample"),
        (16, 1.0 / 16.0, "divided by the sample count twice"),
        (4, 4.0, "variance of one sample"),
        (16, 2.0, ""),
        (64, 0.5, ""),
        (4, 0.75, ""),
    ] {
        let mut frame = sound(n);
        scale_variance(&mut frame, factor);
        let found = inspect(frame).unwrap();
        assert_eq!(found.len(), 1, "{n} {factor}: {found:?}");
        assert_eq!(found[0].kind, FindingKind::VarianceAgainstHalves);
        let (value, errors) = (found[0].value.unwrap(), found[0].standard_errors.unwrap());
        // The mean of 1200 ratios of variance at most 2, within 5 standard errors.
        assert!((f64::from(factor) / value - 1.0).abs() < 5.0 * (2.0f64 / 1200.0).sqrt(), "{value}");
        assert!(errors.abs() > 5.0 && (errors > 0.0) == (factor > 1.0), "{errors}");
        assert!(found[0].text.contains(guess), "{}", found[0]);
        assert_eq!(found[0].text.contains("may"), !guess.is_empty(), "{}", found[0]);
    }
}

#[test]
fn with_two_samples_the_ratio_is_exact_and_any_factor_shows() {
    let mut frame = sound(2);
    scale_variance(&mut frame, 0.5);
    assert_eq!(inspect(frame).unwrap()[0].kind, FindingKind::VarianceAgainstHalves);
}

#[test]
fn noise_free_halves_beside_a_variance_are_found() {
    let mut frame = sound(16);
    frame.color.halves = Some([frame.color.mean.clone(), frame.color.mean.clone()]);
    let found = inspect(frame).unwrap();
    assert!(found[0].text.contains("no noise at all"), "{found:?}");
}

#[test]
fn nothing_is_said_where_nothing_can_be_compared() {
    let wrong = || {
        let mut frame = sound(16);
        scale_variance(&mut frame, 16.0);
        frame
    };
    let silent = |frame: Frame| assert_eq!(inspect(frame).unwrap(), []);
    silent(Frame { sampling: Sampling::LowDiscrepancy, ..wrong() });
    let mut frame = wrong();
    frame.color.halves = None;
    silent(frame);
    silent(wrong().crop(0, 0, 7, 9));
}

#[test]
fn noise_below_the_rounding_of_half_floats_is_not_compared() {
    // Values near 1 in steps of 2⁻¹¹, whose noise of 1e-6 the halves cannot show.
    let mut frame = sound(16);
    frame.color.mean = frame.color.mean.map(|v| 1.0 + (v * 3.0).round() / 2048.0);
    frame.color.halves =
        Some([frame.color.mean.map(|v| v + 2f32.powi(-10)), frame.color.mean.map(|v| v - 2f32.powi(-10))]);
    frame.color.variance = Some(Variance::of_mean(Image::filled(SIZE.0, SIZE.1, 3, 1e-10)));
    assert_eq!(inspect(frame).unwrap(), []);
}

#[test]
fn zero_variance_where_the_halves_differ_is_counted() {
    let mut frame = sound(16);
    let mut variance = frame.color.variance.take().unwrap().into_mean_variance();
    variance.plane_mut(2)[..50].fill(0.0);
    frame.color.variance = Some(Variance::of_mean(variance));
    let found = inspect(frame).unwrap();
    let zero: Vec<&Finding> = found.iter().filter(|f| f.kind == FindingKind::ZeroVariance).collect();
    assert_eq!((zero.len(), zero[0].value), (1, Some(50.0)), "{found:?}");
    // Nothing to find where nothing happens.
    let mut dark = sound(16);
    for half in halves(&mut dark) {
        half.data_mut().fill(1.0);
    }
    dark.color.mean.data_mut().fill(1.0);
    dark.color.variance = Some(Variance::of_mean(Image::new(SIZE.0, SIZE.1, 3)));
    assert_eq!(inspect(dark).unwrap(), []);
}

#[test]
fn a_reference_is_checked_like_a_frame_and_nothing_is_filled() {
    let reference = |frame: Frame| Reference { frame, parts: Vec::new() };
    assert_eq!(reference(sound(16)).inspect(Fidelity::Rounded), Ok(Vec::new()));
    let mut doubled = sound(16);
    halves(&mut doubled)[0] = doubled.color.mean.map(|v| 2.0 * v);
    assert!(matches!(
        reference(doubled).inspect(Fidelity::Rounded),
        Err(FrameError::Contradiction { made_of: "halves", .. })
    ));
    // Nobody knows how long it is: its halves pass for equal.
    let unknown = Frame { samples: Samples::uniform(1), ..sound(16) };
    assert_eq!(reference(unknown).inspect(Fidelity::Rounded), Ok(Vec::new()));
    let mut holes = sound(16);
    holes.color.mean.set(0, 1, 1, f32::NAN);
    let mut variance = holes.color.variance.take().unwrap().into_mean_variance();
    variance.set(0, 2, 2, -1.0);
    holes.color.variance = Some(Variance::of_mean(variance));
    let mut holes = reference(holes);
    let found = holes.inspect(Fidelity::Rounded).unwrap();
    let kinds: Vec<FindingKind> = found.iter().map(|f| f.kind).collect();
    assert_eq!(kinds, [FindingKind::InvalidPixels, FindingKind::UnknownVariance]);
    assert!(holes.mean().get(0, 1, 1).is_nan());
    assert!(holes.frame.color.variance.as_ref().unwrap().mean_variance().get(0, 2, 2).is_nan());
    let mut overflow = sound(16);
    overflow.color.variance = Some(Variance::of_mean(Image::filled(SIZE.0, SIZE.1, 3, f32::INFINITY)));
    let mut overflow = reference(overflow);
    let found = overflow.inspect(Fidelity::Rounded).unwrap();
    assert_eq!((found[0].kind, overflow.frame.color.variance), (FindingKind::VarianceDropped, None));
    let mut nothing = sound(16);
    nothing.color.mean.data_mut().fill(f32::NAN);
    assert_eq!(reference(nothing).inspect(Fidelity::Rounded), Ok(Vec::new()), "for metrics to refuse");
}

#[test]
fn parts_must_average_to_the_mean() {
    let parts: Vec<Image> = (0..8).map(|k| sound(2 + k).color.mean).collect();
    let mut reference = Reference::from_parts(parts, 16, Sampling::LowDiscrepancy).unwrap();
    assert_eq!(reference.inspect(Fidelity::Rounded), Ok(Vec::new()));
    reference.parts[3].data_mut().fill(0.0);
    assert!(matches!(
        reference.inspect(Fidelity::Rounded),
        Err(FrameError::Contradiction { made_of: "parts", .. })
    ));
}

/// Shadow rays that reached a light over rays traced: of `n(pixel)` samples the first ones, as `traced` says, hit something
/// and trace one.
fn visible(n: impl Fn(usize) -> u32, traced: &[u32], seed: u64) -> Frame {
    let mut random = uniform(seed);
    let pixels = SIZE.0 * SIZE.1;
    let mut planes =
        [Image::new(SIZE.0, SIZE.1, 1), Image::new(SIZE.0, SIZE.1, 1), Image::new(SIZE.0, SIZE.1, 1)];
    for pixel in 0..pixels {
        let mut rays = [[0.0f64; 2]; 2]; // reached and traced, of both halves
        for k in 0..n(pixel) {
            if traced.contains(&k) {
                let half = &mut rays[(k % 2) as usize];
                half[0] += f64::from(u8::from(random() < 0.5));
                half[1] += 1.0;
            }
        }
        let quotient =
            |[reached, traced]: [f64; 2]| if traced > 0.0 { (reached / traced) as f32 } else { 0.0 };
        let [a, b] = rays;
        for (plane, value) in planes.iter_mut().zip([[a[0] + b[0], a[1] + b[1]], a, b].map(quotient)) {
            plane.data_mut()[pixel] = value;
        }
    }
    let [mean, a, b] = planes;
    let counts: Vec<u32> = (0..pixels).map(&n).collect();
    let half_a = counts.iter().map(|n| n.div_ceil(2)).collect();
    let samples = Samples::per_pixel(counts).with_half_a(Counts::PerPixel(half_a));
    let color = Image::filled(SIZE.0, SIZE.1, 3, 0.5);
    let mut frame = Frame::from_color(Estimate::from_mean(color), samples, Sampling::LowDiscrepancy);
    let estimate = Estimate { mean, variance: None, halves: Some([a, b]) };
    frame.features.insert(FeatureId::Visibility, estimate);
    frame
}

#[test]
fn a_quotient_lies_between_its_halves_whatever_their_samples() {
    for seed in 0..4 {
        // One ray in half A, three in half B; and one in each, where half A has the odd sample.
        for frame in [visible(|_| 8, &[0, 1, 3, 5], seed), visible(|_| 9, &[0, 1], seed)] {
            assert_eq!(inspect(frame.clone()), Ok(Vec::new()));
            let mut off = frame;
            let visibility = off.features.get_mut(&FeatureId::Visibility).unwrap();
            visibility.mean = visibility.mean.map(|v| v + 1.5);
            assert!(contradicts(off).contains("visibility"));
        }
        // Of anything else the odd sample alone is no contradiction, halves that never weigh what they should are.
        let as_caustics = |mut frame: Frame| {
            let visibility = frame.features.remove(&FeatureId::Visibility).unwrap();
            frame.features.insert(FeatureId::Caustics, visibility);
            frame
        };
        assert_eq!(inspect(as_caustics(visible(|_| 9, &[0, 1], seed))), Ok(Vec::new()));
        assert!(contradicts(as_caustics(visible(|_| 8, &[0, 1, 3, 5], seed))).contains("caustics"));
    }
}
