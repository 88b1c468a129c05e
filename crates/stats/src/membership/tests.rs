use super::*;
use crate::random::Normals;
use crate::{Groups, Level, Observed, SampleCounts};

const LEVELS: [Level; 3] = [Level::TWO_SIDED_95, Level::TWO_SIDED_99, Level::TWO_SIDED_998];

fn mean(mean: f64, variance: f64, n: u32) -> SampleMean {
    SampleMean { mean, variance, n }
}

/// Means and variances of normal samples with this standard deviation.
fn replicate(pixels: usize, n: u32, sd: f64, seed: u64) -> [Vec<f32>; 2] {
    let (mut normals, count) = (Normals::new(seed), f64::from(n));
    let mut planes = [Vec::new(), Vec::new()];
    for _ in 0..pixels {
        let samples: Vec<f64> = (0..n).map(|_| 3.0 + sd * normals.next()).collect();
        let mean = samples.iter().sum::<f64>() / count;
        let squares: f64 = samples.iter().map(|x| (x - mean).powi(2)).sum();
        planes[0].push(mean as f32);
        planes[1].push((squares / ((count - 1.0) * count)) as f32);
    }
    planes
}

fn observed(planes: &[Vec<f32>; 2], n: u32) -> Observed<'_> {
    let [mean, variance] = planes;
    Observed { mean, variance, counts: SampleCounts::Uniform(n), pixels: mean.len(), valid: None }
}

fn assert_rate(tally: &RejectionTally, expected: f64, what: &str) {
    let error = (expected * (1.0 - expected) / tally.total as f64).sqrt();
    let rate = tally.rate().unwrap();
    assert!((rate - expected).abs() < 4.0 * error, "{what}: {rate} instead of {expected} ± {error}");
}

#[test]
fn the_test_of_the_source_work_ends_at_its_critical_value_and_looks_at_one_side() {
    // t(99 %, 15) = 2.9467, standard error 0.5.
    let centre = mean(1.0, 0.25, 16);
    let rejects =
        |other: SampleMean| MembershipTest::InInterval.rejects(&centre, &other, Level::TWO_SIDED_99);
    for sign in [1.0, -1.0] {
        assert_eq!(rejects(mean(1.0 + sign * 1.4733, 9.0, 4)), Some(false));
        assert_eq!(rejects(mean(1.0 + sign * 1.4735, 9.0, 4)), Some(true));
    }
    assert_eq!(rejects(mean(1.2, 0.0, 1)), Some(false), "the other's spread is not looked at");
    // Seen from the other, which has no spread, the centre is something else.
    let other = mean(1.2, 0.0, 16);
    assert_eq!(MembershipTest::InInterval.rejects(&other, &centre, Level::TWO_SIDED_99), Some(true));
}

#[test]
fn intervals_overlap_until_both_reaches_are_used_up() {
    let (a, b) = (mean(0.0, 0.25, 16), mean(0.0, 0.04, 64));
    // 2.9467·0.5 + 2.6561·0.2 = 2.00457.
    let at = |distance| {
        let moved = SampleMean { mean: distance, ..b };
        MembershipTest::Overlap.rejects(&a, &moved, Level::TWO_SIDED_99)
    };
    assert_eq!((at(2.0044), at(2.0048)), (Some(false), Some(true)));
}

#[test]
fn welch_agrees_with_a_worked_example() {
    // Two means with s²/n of 0.05 of 10 samples and 0.2 of 20: t = d/0.5, degrees of freedom 0.0625/(0.0025/9 + 0.04/19)
    // = 26.226; t(99 %, 26) = 2.7787 and t(99 %, 27) = 2.7707.
    let (a, b) = (mean(5.0, 0.05, 10), mean(0.0, 0.2, 20));
    let at = |distance: f64| {
        MembershipTest::Welch.rejects(&a, &mean(5.0 + distance, b.variance, b.n), Level::TWO_SIDED_99)
    };
    assert_eq!((at(0.5 * 2.7705), at(0.5 * 2.7789)), (Some(false), Some(true)));
}

#[test]
fn equal_values_are_never_told_apart_and_points_always() {
    for test in MembershipTest::ALL {
        for level in LEVELS {
            let at = |value: f64| test.rejects(&mean(1.0, 0.0, 4), &mean(value, 0.0, 4), level);
            assert_eq!(at(1.0), Some(false), "{test:?}");
            assert_eq!(at(1.0 + 4e-7), Some(false), "rounding");
            assert_eq!(at(1.0 + 6e-7), Some(true), "{test:?}");
        }
    }
}

#[test]
fn there_is_no_test_without_a_spread_or_a_number() {
    let good = mean(1.0, 0.1, 4);
    for test in MembershipTest::ALL {
        let rejects = |a: &SampleMean, b: &SampleMean| test.rejects(a, b, Level::TWO_SIDED_99);
        assert_eq!(rejects(&mean(1.0, 0.1, 1), &good), None);
        assert_eq!(rejects(&good, &mean(f64::NAN, 0.1, 4)), None);
        assert_eq!(rejects(&mean(1.0, f64::INFINITY, 4), &good), None);
        assert_eq!(rejects(&good, &mean(1.0, 0.1, 1)).is_none(), test != MembershipTest::InInterval);
    }
}

#[test]
fn false_alarms_of_normal_samples_are_as_often_as_computed() {
    let pixels = 10_000;
    for (n, seed) in [(2, 1), (4, 2), (16, 3)] {
        let (a, b) = (replicate(pixels, n, 0.7, seed), replicate(pixels, n, 0.7, 100 + seed));
        for level in LEVELS {
            let tally =
                |test| rejections(&observed(&a, n), &observed(&b, n), test, 0.0, level, None).unwrap()[0];
            let exact = interval_rejection(n, 0.0, 1.0, level);
            assert_rate(&tally(MembershipTest::InInterval), exact, &format!("n = {n}"));
            // Equal variances: Student's two-sample test keeps its level, Welch's is on the safe side of it.
            let welch = tally(MembershipTest::Welch);
            let error = (level.alpha() / pixels as f64).sqrt();
            assert!(welch.rate().unwrap() < level.alpha() + 4.0 * error, "n = {n}: {welch:?}");
        }
    }
}

#[test]
fn power_and_unequal_errors_are_as_computed() {
    let (pixels, n) = (10_000, 8);
    for ratio in [0.5, 2.0] {
        let (a, b) = (replicate(pixels, n, 1.0, 5), replicate(pixels, n, ratio, 6));
        for shift in [0.0, 1.0, -3.0, 6.0] {
            let level = Level::TWO_SIDED_99;
            let test = MembershipTest::InInterval;
            let tally = rejections(&observed(&a, n), &observed(&b, n), test, shift, level, None).unwrap()[0];
            let exact = interval_rejection(n, shift, ratio, level);
            assert_rate(&tally, exact, &format!("ratio {ratio}, shift {shift}"));
        }
    }
}

#[test]
fn many_samples_reach_the_closed_forms() {
    let (pixels, n) = (5_000, 256);
    let (a, b) = (replicate(pixels, n, 1.0, 7), replicate(pixels, n, 1.0, 8));
    for test in MembershipTest::ALL {
        for shift in [0.0, 2.0, 4.0] {
            let level = Level::TWO_SIDED_95;
            let tally = rejections(&observed(&a, n), &observed(&b, n), test, shift, level, None).unwrap()[0];
            let expected = test.asymptotic_rejection(shift, 1.0, level);
            // What 255 degrees of freedom make of the normal distribution is below 3/n of a probability.
            let error = (expected * (1.0 - expected) / pixels as f64).sqrt();
            let (rate, allowed) = (tally.rate().unwrap(), 4.0 * error + 3.0 / f64::from(n) * expected);
            assert!((rate - expected).abs() < allowed, "{test:?}, {shift}: {rate} instead of {expected}");
        }
    }
}

#[test]
fn closed_forms_have_their_limits() {
    let normal = statrs_free_normal_tail;
    for level in LEVELS {
        let z = crate::normal_quantile(level);
        let at = |test: MembershipTest| test.asymptotic_rejection(0.0, 1.0, level);
        let root = std::f64::consts::SQRT_2;
        assert!((at(MembershipTest::InInterval) - 2.0 * normal(z / root)).abs() < 1e-6);
        assert!((at(MembershipTest::Overlap) - 2.0 * normal(z * root)).abs() < 1e-6);
        assert!((at(MembershipTest::Welch) - level.alpha()).abs() < 1e-9);
        // Beside a mean without error the interval keeps its level, at any number of samples.
        assert!(
            (MembershipTest::InInterval.asymptotic_rejection(0.0, 0.0, level) - level.alpha()).abs() < 1e-9
        );
        for n in [2, 5, 100] {
            assert!((interval_rejection(n, 0.0, 0.0, level) - level.alpha()).abs() < 1e-9);
        }
        let (many, limit) = (
            interval_rejection(1_000_000, 1.5, 0.7, level),
            MembershipTest::InInterval.asymptotic_rejection(1.5, 0.7, level),
        );
        assert!((many / limit - 1.0).abs() < 1e-4, "{many} {limit}");
        for test in MembershipTest::ALL {
            assert!(test.asymptotic_rejection(60.0, 1.0, level) > 1.0 - 1e-12);
            let both = [2.0, -2.0].map(|shift| test.asymptotic_rejection(shift, 0.4, level));
            assert!((both[0] - both[1]).abs() < 1e-15);
        }
    }
    // The numbers of the documentation, and two more.
    let false_alarms =
        MembershipTest::ALL.map(|test| test.asymptotic_rejection(0.0, 1.0, Level::TWO_SIDED_99));
    for (got, known) in false_alarms.into_iter().zip([0.068_548, 0.000_270, 0.01]) {
        assert!((got - known).abs() < 6e-6, "{got} {known}");
    }
    assert!(
        (MembershipTest::InInterval.asymptotic_rejection(0.0, 1.0, Level::TWO_SIDED_998) - 0.028_88).abs()
            < 6e-6
    );
}

/// Upper tail of the standard normal distribution by the midpoint rule, to 1e-7.
fn statrs_free_normal_tail(z: f64) -> f64 {
    let (step, density) = (1e-4, |x: f64| (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt());
    (0..100_000).map(|k| density(z + (f64::from(k) + 0.5) * step)).sum::<f64>() * step
}

#[test]
fn counts_go_by_class_channel_and_pixel() {
    // Two pixels, three channels: the first differs in the last channel alone, the second is constant and equal.
    let centre = Observed {
        mean: &[0.0, 1.0, 0.0, 1.0, 0.0, 1.0],
        variance: &[1.0, 0.0, 1.0, 0.0, 1.0, 0.0],
        counts: SampleCounts::PerPixel(&[16, 4]),
        pixels: 2,
        valid: None,
    };
    let other = Observed { mean: &[0.1, 1.0, 0.1, 1.0, 9.0, 1.0], ..centre };
    let groups = Some(Groups { of_pixel: &[1, 0], count: 2 });
    let all =
        rejections(&centre, &other, MembershipTest::InInterval, 0.0, Level::TWO_SIDED_99, groups).unwrap();
    let first = RejectionTally { total: 3, rejected: 1, pixels: 1, pixels_rejected: 1, ..Default::default() };
    let second = RejectionTally { constant: 3, pixels: 1, ..Default::default() };
    assert_eq!(all[1..], [second, first]);
    assert_eq!((all[0].rate(), all[0].joint_rate()), (Some(1.0 / 3.0), Some(0.5)));
    let short = Observed { mean: &[0.0; 4], variance: &[1.0; 4], ..centre };
    let error =
        rejections(&centre, &short, MembershipTest::Welch, 0.0, Level::TWO_SIDED_99, None).unwrap_err();
    assert_eq!(error.to_string(), "means of the other replicate has 4 entries, expected 6");
    let absent = Observed { valid: Some(&[false, true]), ..other };
    let all = rejections(&centre, &absent, MembershipTest::Overlap, 0.0, Level::TWO_SIDED_99, None).unwrap();
    assert_eq!(all[0], second);
}
