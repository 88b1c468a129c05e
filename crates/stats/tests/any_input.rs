//! No input of a public function panics, hangs, or turns a missing number into a finding.

use noisefloor_stats::*;

/// Numbers that are easily forgotten.
const ODD: [f64; 13] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    f64::MIN_POSITIVE,
    5e-324,
    f64::MAX,
    f64::MIN,
    1e-300,
    0.5,
    3.0,
];

/// Picks from the odd numbers and from plain ones, by a counter that visits many combinations.
struct Picks(u64);

impl Picks {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn number(&mut self) -> f64 {
        match self.next() % 3 {
            0 => ODD[(self.next() % ODD.len() as u64) as usize],
            _ => (self.next() % 1000) as f64 / 100.0 + 0.01,
        }
    }

    fn values(&mut self) -> Vec<Option<f64>> {
        let n = self.next() % 6;
        (0..n).map(|_| if self.next().is_multiple_of(5) { None } else { Some(self.number()) }).collect()
    }

    fn share(&mut self) -> ReferenceShare {
        let parts = (0..self.next() % 3 * 2).map(|_| self.number()).collect();
        ReferenceShare { standard_error: self.number(), parts, product: self.number() }
    }

    fn level(&mut self) -> Level {
        let confidence = [1e-300, 1e-17, 0.5, 0.95, 0.999_999, 1.0 - f64::EPSILON / 2.0];
        let confidence = confidence[(self.next() % 6) as usize];
        let level = if self.next().is_multiple_of(2) {
            Level::two_sided(confidence)
        } else {
            Level::upper(confidence)
        };
        level.unwrap()
    }
}

#[test]
fn quantiles_and_probabilities_exist_for_every_level_and_any_number_of_samples() {
    let mut picks = Picks(1);
    for degrees in [0, 1, 2, 3, 30, 1_000_000, 1_000_001, u64::MAX] {
        for _ in 0..24 {
            let level = picks.level();
            assert!(!t_quantile(level, degrees).is_nan(), "{level:?} {degrees}");
            assert!(!normal_quantile(level).is_nan(), "{level:?}");
        }
        for statistic in ODD {
            let p = t_two_sided_p(statistic, degrees);
            assert!((0.0..=1.0).contains(&p), "{statistic} {degrees}: {p}");
        }
    }
    for largest in [0, 1, 2, 3, u32::MAX] {
        let table = TTable::new(picks.level(), largest.min(64));
        for n in [0, 1, 2, 3, largest, u32::MAX] {
            assert!(!table.at(n).is_nan());
        }
    }
    assert!(serde_level(r#"{"confidence": 2.0, "sides": "two"}"#).is_err());
    assert_eq!(serde_level(r#"{"confidence": 0.95, "sides": "two"}"#).unwrap(), Level::TWO_SIDED_95);
}

/// A plane that is there in most cases.
fn picked(plane: &[f32], picks: &mut Picks) -> Option<Vec<f32>> {
    (!picks.next().is_multiple_of(4)).then(|| plane.to_vec())
}

fn serde_level(text: &str) -> Result<Level, serde_json::Error> {
    serde_json::from_str(text)
}

#[test]
fn comparisons_and_fits_take_anything_and_missing_numbers_show_nothing() {
    let mut picks = Picks(2);
    for _ in 0..4000 {
        let level = picks.level();
        let (a, b) = (picks.values(), picks.values());
        let (share_a, share_b) = (picks.share(), picks.share());
        let shares = [&share_a, &share_b];
        let both = a.iter().zip(&b).filter(|(a, b)| {
            let finite = |v: &Option<f64>| v.is_some_and(f64::is_finite);
            finite(a) && finite(b)
        });
        let usable = both.count();
        for effect in [
            paired_effect(&a, &b, shares, true, level),
            paired_ratio(&a, &b, shares, level),
            paired_difference(&a, &b, shares, level),
        ]
        .into_iter()
        .flatten()
        {
            assert!((0.0..=1.0).contains(&effect.p), "{effect:?}");
            assert!(effect.interval.n as usize <= usable && (usable > 1 || effect.p == 1.0), "{effect:?}");
        }
        let rows = [Row { values: &a, reference: &share_a }, Row { values: &b, reference: &share_b }];
        for (direction, family) in
            [(Direction::LowerIsBetter, Family::AllPairs), (Direction::HigherIsBetter, Family::WithBest)]
        {
            let found = compare(&rows, direction, family, level);
            assert!(usable > 1 || found.pairs.iter().all(|pair| !pair.distinguishable), "{found:?}");
        }
        let plain: Vec<f64> = a.iter().copied().flatten().collect();
        let mut levels = Levels::new();
        for _ in 0..picks.next() % 5 {
            levels.push(picks.number(), &picks.values(), picks.share());
        }
        let _ = (slope(&levels, level), plateau(&levels, level));
        let _ = (convergence(&levels, 1, level), convergence(&levels, 2, level));
        if let Some(fit) = monte_carlo_constant(&levels, level) {
            let (spp, top) = (picks.number(), picks.number());
            let _ = equal_error_multiplier(&fit, spp, &plain, &share_a, top, level);
        }
        if let Some(interval) = replicate_interval(&plain, picks.number(), level) {
            let _ = (interval.below(picks.number()), interval.excludes(picks.number()), interval.exp());
        }
        let _ = (proportion_interval(&plain, picks.next(), level), holm_adjusted(&plain));
        let points: Vec<(f64, f64)> = plain.iter().map(|&v| (v, picks.number())).collect();
        let _ = (pareto_front(&points), rate_standard_error(picks.number(), picks.next()));
        let hits: Vec<bool> = plain.iter().map(|v| *v > 0.5).collect();
        let _ = clustered_rate(&hits, (picks.next() % 4) as usize);
        let evidence = Evidence::of(&Interval::point(picks.number(), level), picks.number());
        let _ = judge(&evidence, Region { low: picks.number(), high: picks.number() });
    }
}

#[test]
fn counts_over_pixels_take_anything() {
    let mut picks = Picks(3);
    for _ in 0..2000 {
        let pixels = (picks.next() % 4) as usize;
        let channels = (picks.next() % 4) as usize;
        let count =
            if picks.next().is_multiple_of(8) { picks.next() as usize % 7 } else { pixels * channels };
        let mut plane = || (0..count).map(|_| picks.number() as f32).collect::<Vec<f32>>();
        let (mean, variance, truth, noise, denoised) = (plane(), plane(), plane(), plane(), plane());
        let counts: Vec<u32> = (0..pixels).map(|_| (picks.next() % 3) as u32).collect();
        let level = picks.level();
        let observed = Observed {
            mean: &mean,
            variance: &variance,
            counts: if picks.next().is_multiple_of(2) {
                SampleCounts::Uniform(4)
            } else {
                SampleCounts::PerPixel(&counts)
            },
            pixels,
            valid: None,
        };
        let truth = Truth { mean: &truth, variance: Some(&noise) };
        let of_pixel: Vec<u8> = (0..pixels).map(|_| picks.next() as u8).collect();
        let groups = Groups {
            of_pixel: &of_pixel,
            count: if picks.next().is_multiple_of(2) { 3 } else { usize::MAX },
        };
        let _ = coverage(&observed, &truth, level, Some(groups));
        let width = [pixels, 1, 2, 0][(picks.next() % 4) as usize];
        let plane = |plane: &'_ Vec<f32>| picked(plane, &mut picks);
        let [third_moment, least, greatest] = [&denoised, &noise, &variance].map(plane);
        let planes = SamplePlanes {
            observed,
            width,
            third_moment: third_moment.as_deref(),
            least: least.as_deref(),
            greatest: greatest.as_deref(),
        };
        for family in FAMILIES {
            let Ok(Some(intervals)) = family.intervals(&planes, level) else { continue };
            let ends = intervals.low.iter().zip(&intervals.high);
            assert!(ends.clone().all(|(low, high)| low <= high), "{} {level:?}", family.id());
            let tallies = coverage_of(&intervals, &observed, &truth, level, Some(groups)).unwrap();
            let CoverageTally { total, covered, truth_above, truth_below, .. } = tallies[0];
            assert_eq!(covered + truth_above + truth_below, total);
        }
        let other = Observed { mean: &denoised, variance: &noise, ..observed };
        for test in MembershipTest::ALL {
            let shift = if picks.next().is_multiple_of(2) { 0.0 } else { picks.number() };
            if let Ok(tallies) = rejections(&observed, &other, test, shift, level, Some(groups)) {
                let RejectionTally { total, rejected, pixels, pixels_rejected, .. } = tallies[0];
                assert!(rejected <= total && pixels_rejected <= pixels, "{tallies:?}");
            }
            let expected = test.asymptotic_rejection(picks.number(), picks.number().abs(), level);
            assert!(expected.is_nan() || (0.0..=1.0).contains(&expected), "{expected}");
        }
        if let Ok(widths) = half_widths(&observed, &[(picks.number(), level)]) {
            let _ = enclosure(&denoised, &widths, &observed);
            let tallies = bound_violations(&denoised, &widths, &observed, &truth, level, Some(groups));
            let _ = tallies.map(|all| (all[0].rate(), all[0].mean_ratio()));
        }
    }
}

#[test]
fn rates_bands_and_events_take_anything() {
    let mut picks = Picks(4);
    for _ in 0..3000 {
        let level = picks.level();
        let (hits, trials) =
            (picks.next() % 40, [0, 1, 7, 39, 100_000_001, u64::MAX][(picks.next() % 6) as usize]);
        if let Ok(interval) = clopper_pearson(hits, trials, level) {
            let (low, high) = (interval.low.unwrap(), interval.high.unwrap());
            assert!(
                low <= interval.value && interval.value <= high && low >= 0.0 && high <= 1.0,
                "{interval:?}"
            );
        }
        for p in [
            binomial_two_sided_p(hits, trials, picks.number()),
            binomial_p_against(hits, trials, picks.number(), picks.number()),
        ]
        .into_iter()
        .flatten()
        {
            assert!((0.0..=1.0).contains(&p), "{p}");
        }
        let (values, points) = ((picks.next() % 9) as usize, (picks.next() % 5) as usize);
        if let Ok(band) = EcdfBand::new(values, points, picks.number()) {
            assert!(band.gamma > 0.0 && band.probability <= 1.0 + 1e-12, "{band:?}");
            let numbers: Vec<f64> = (0..values).map(|_| picks.number()).collect();
            let _ = band.contains(&ecdf(&numbers, points));
        }
        let _ = instrument::bernoulli_coverage(picks.number(), (picks.next() % 9) as u32, level);
        let missed = instrument::missed_by_all(picks.number(), picks.next() as u32);
        assert!(missed.is_nan() || (0.0..=1.0).contains(&missed));
        let _ = instrument::shrunk(picks.number(), picks.number(), picks.number());
    }
}

#[test]
fn replicates_and_checks_of_the_instrument_take_anything() {
    let mut picks = Picks(5);
    for _ in 0..2000 {
        let (width, height) = ((picks.next() % 4) as usize, (picks.next() % 3) as usize);
        let pixels = width * height;
        let count = if picks.next().is_multiple_of(8) { picks.next() as usize % 7 } else { 3 * pixels };
        let mut plane = || (0..count).map(|_| picks.number() as f32).collect::<Vec<f32>>();
        let planes: Vec<_> = (0..6).map(|_| plane()).collect();
        let counts: Vec<u32> = (0..pixels).map(|_| (picks.next() % 5) as u32).collect();
        let weight: Vec<f64> = (0..count).map(|_| picks.number()).collect();
        let level = picks.level();
        let of_pixel: Vec<u8> = (0..pixels).map(|_| (picks.next() % 4) as u8).collect();
        let groups = Some(Groups { of_pixel: &of_pixel, count: 3 });
        let frame = |k: usize| Observed {
            mean: &planes[k],
            variance: &planes[k + 1],
            counts: SampleCounts::PerPixel(&counts),
            pixels,
            valid: None,
        };
        let frames = [frame(0), frame(1)];
        let _ = leave_one_out(&frames, level, groups);
        let truth = Truth { mean: &planes[3], variance: Some(&planes[4]) };
        let chosen: Vec<usize> = (0..count).collect();
        if let Ok(found) = pit(&frames[0], &truth, &chosen, picks.next()) {
            assert!(found.values.iter().all(|u| (0.0..=1.0).contains(u)), "{found:?}");
        }
        let slices: Vec<&[f32]> = planes.iter().map(Vec::as_slice).collect();
        for noise in [
            ReferenceNoise::Exact,
            ReferenceNoise::Unknown,
            ReferenceNoise::Variance(slices[4]),
            ReferenceNoise::Halves {
                halves: [slices[4], slices[5]],
                parts: [&slices[..2], &slices[2..(2 + picks.next() as usize % 3)]],
            },
        ] {
            let replicates = Replicates { images: &slices[..3], pixels, valid: None, weight: Some(&weight) };
            if let Ok(found) = bias_variance(&replicates, &BiasReference { mean: slices[3], noise }, groups) {
                for total in found.totals.iter().flatten() {
                    assert!(total.variance.value >= 0.0, "{total:?}");
                    let _ = (total.bias.interval(level), total.variance.interval(level));
                }
            }
        }
        let halved = instrument::HalvedFrame {
            observed: frames[0],
            halves: [slices[2], slices[3]],
            in_a: SampleCounts::Uniform(2),
        };
        let ratio = instrument::half_variance_ratio(&[halved, halved], width, None);
        let samples = Some(picks.number());
        let reference = instrument::SampledTruth { truth, samples };
        let bright = instrument::brightness(&frames, &reference, true, width, groups);
        let means = instrument::FrameMeans { mean: slices[0], halves: Some([slices[1], slices[2]]) };
        let blocks = instrument::Blocks::new(width, height);
        let shared = instrument::dependence(&[means], slices[3], [slices[4], slices[5]], &blocks, None);
        let shared = shared.iter().flat_map(|found| &found.centres);
        for outcome in ratio.iter().chain(bright.iter().flat_map(|found| found.all())).chain(shared) {
            if let Some(tested) = outcome.tested() {
                assert!((0.0..=1.0).contains(&tested.adjusted) && tested.p <= tested.adjusted, "{tested:?}");
            }
        }
    }
}
