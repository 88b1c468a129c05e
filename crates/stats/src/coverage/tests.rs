use super::*;
use crate::SampleCounts;

fn count(mean: &[f32], variance: &[f32], truth: &[f32], noise: Option<&[f32]>) -> CoverageTally {
    let observed =
        Observed { mean, variance, counts: SampleCounts::Uniform(16), pixels: mean.len(), valid: None };
    let truth = Truth { mean: truth, variance: noise };
    coverage(&observed, &truth, Level::TWO_SIDED_99, None).unwrap()[0]
}

#[test]
fn an_interval_ends_at_its_critical_value() {
    // t(99 %, 15) = 2.9467, standard error 0.5.
    let inside = count(&[1.0], &[0.25], &[1.0 + 1.4733], None);
    assert_eq!(inside, CoverageTally { total: 1, covered: 1, covered_uncorrected: 1, ..Default::default() });
    let outside = count(&[1.0], &[0.25], &[1.0 + 1.4735], None);
    assert_eq!(
        outside,
        CoverageTally { total: 1, truth_above: 1, truth_above_uncorrected: 1, ..Default::default() }
    );
}

#[test]
fn noise_of_the_truth_widens_in_quadrature() {
    // √((2.9467·0.5)² + (2.5758·0.5)²) = 1.95690.
    let inside = count(&[0.0], &[0.25], &[1.9568], Some(&[0.25]));
    assert_eq!((inside.covered, inside.covered_uncorrected), (1, 0));
    assert_eq!(count(&[0.0], &[0.25], &[1.9570], Some(&[0.25])).covered, 0);
}

#[test]
fn zero_variance_splits_into_constant_and_missed() {
    let tally = count(&[1.0, 0.0, 0.0], &[0.0; 3], &[1.0 + 4e-7, 1.0, 1.0], Some(&[0.0, 0.01, 1.0]));
    assert_eq!(tally, CoverageTally { constant: 2, missed: 1, ..Default::default() });
    assert_eq!(tally.rate(), Some(2.0 / 3.0));
}

#[test]
fn channels_share_their_pixels_group_and_count() {
    let observed = Observed {
        mean: &[0.0; 6],
        variance: &[1.0; 6],
        counts: SampleCounts::PerPixel(&[1, 16]),
        pixels: 2,
        valid: None,
    };
    let truth = Truth { mean: &[2.0, 2.0, 9.0, 9.0, 2.0, 2.0], variance: None };
    let groups = Some(Groups { of_pixel: &[0, 1], count: 2 });
    let tallies = coverage(&observed, &truth, Level::TWO_SIDED_99, groups).unwrap();
    assert_eq!(tallies[1], CoverageTally::default(), "one sample has no interval");
    assert_eq!(tallies[0], tallies[2]);
    assert_eq!((tallies[2].total, tallies[2].covered), (3, 2));
    let short = Truth { mean: &[0.0; 5], variance: None };
    let error = coverage(&observed, &short, Level::TWO_SIDED_99, None).unwrap_err();
    assert_eq!(error.to_string(), "truth has 5 entries, expected 6");
}

fn random_planes(count: usize, seed: u64) -> [Vec<f32>; 4] {
    let mut normals = crate::random::Normals::new(seed);
    let mut plane = |scale: f64, squared: bool| -> Vec<f32> {
        let one = |z: f64| if squared { scale * z * z } else { 1.0 + scale * z };
        (0..count).map(|i| if squared && i % 11 == 0 { 0.0 } else { one(normals.next()) as f32 }).collect()
    };
    [plane(1.0, false), plane(0.3, true), plane(0.5, false), plane(0.1, true)]
}

#[test]
fn t_intervals_are_counted_alike_with_and_without_their_planes() {
    let pixels = 400;
    let [mean, variance, truth, noise] = random_planes(3 * pixels, 7);
    let counts: Vec<u32> = (0..pixels as u32).map(|i| [1, 2, 4, 64, 9000][i as usize % 5]).collect();
    let valid: Vec<bool> = (0..pixels).map(|i| i % 13 != 0).collect();
    let of_pixel: Vec<u8> = (0..pixels).map(|i| (i % 4) as u8).collect();
    let observed = Observed {
        mean: &mean,
        variance: &variance,
        counts: SampleCounts::PerPixel(&counts),
        pixels,
        valid: Some(&valid),
    };
    let truth = Truth { mean: &truth, variance: Some(&noise) };
    let planes = crate::SamplePlanes { observed, width: 20, third_moment: None, least: None, greatest: None };
    for level in [Level::TWO_SIDED_95, Level::TWO_SIDED_998, Level::two_sided(0.3).unwrap()] {
        let groups = || Some(Groups { of_pixel: &of_pixel, count: 3 });
        let intervals = crate::family("t").unwrap().intervals(&planes, level).unwrap().unwrap();
        let of = coverage_of(&intervals, &observed, &truth, level, groups()).unwrap();
        let direct = coverage(&observed, &truth, level, groups()).unwrap();
        assert_eq!(of, direct);
        for tally in direct {
            let CoverageTally { total, covered, truth_above, truth_below, .. } = tally;
            assert!(total > 20 && truth_above > 0 && truth_below > 0, "{tally:?}");
            assert_eq!(covered + truth_above + truth_below, total);
            assert_eq!(
                tally.covered_uncorrected + tally.truth_above_uncorrected + tally.truth_below_uncorrected,
                total
            );
        }
    }
}

#[test]
fn each_end_is_widened_in_quadrature_on_its_own_side() {
    // Ends 3 below and 1 above the mean 10; t_r = 2.5758 and v_r = 0.25 allow 1.2879: √(1 + 1.6587) = 1.6306 above,
    // √(9 + 1.6587) = 3.2648 below.
    let intervals = IntervalPlanes { low: vec![7.0; 6], high: vec![11.0; 6] };
    let observed = Observed {
        mean: &[10.0; 6],
        variance: &[1.0; 6],
        counts: SampleCounts::Uniform(4),
        pixels: 6,
        valid: None,
    };
    let truth = Truth { mean: &[11.5, 11.63, 11.64, 6.74, 6.73, 10.9], variance: Some(&[0.25; 6]) };
    let tally = coverage_of(&intervals, &observed, &truth, Level::TWO_SIDED_99, None).unwrap()[0];
    assert_eq!((tally.covered, tally.truth_above, tally.truth_below), (4, 1, 1));
    assert_eq!((tally.covered_uncorrected, tally.truth_above_uncorrected), (1, 3));
    assert_eq!(tally.truth_below_uncorrected, 2);
    let short = IntervalPlanes { low: vec![7.0; 5], high: vec![11.0; 6] };
    let error = coverage_of(&short, &observed, &truth, Level::TWO_SIDED_99, None).unwrap_err();
    assert_eq!(error.to_string(), "lower ends has 5 entries, expected 6");
}

#[test]
fn one_end_alone_misses_on_its_side_and_an_interval_beside_the_mean_on_both() {
    let observed = Observed {
        mean: &[0.0; 4],
        variance: &[1.0, 1.0, 1.0, 0.0],
        counts: SampleCounts::Uniform(4),
        pixels: 4,
        valid: None,
    };
    let truth = Truth { mean: &[-9.0, 9.0, 0.5, 2.0], variance: None };
    let count = |low: f64, high: f64| {
        let intervals = IntervalPlanes { low: vec![low; 4], high: vec![high; 4] };
        coverage_of(&intervals, &observed, &truth, Level::TWO_SIDED_95, None).unwrap()[0]
    };
    let lower = count(-1.0, f64::INFINITY);
    assert_eq!((lower.covered, lower.truth_below, lower.truth_above, lower.constant), (2, 1, 0, 1));
    let upper = count(f64::NEG_INFINITY, 1.0);
    assert_eq!((upper.covered, upper.truth_below, upper.truth_above, upper.missed), (2, 0, 1, 1));
    // Both ends above the mean: what lies between mean and interval is missed, too.
    let beside = count(1.0, 3.0);
    assert_eq!((beside.covered, beside.truth_below, beside.truth_above, beside.constant), (0, 2, 1, 1));
    assert_eq!(count(f64::NEG_INFINITY, f64::INFINITY).all(), 0, "no interval");
    let noisy = Truth { mean: &[0.4; 4], variance: Some(&[0.25; 4]) };
    let intervals = IntervalPlanes { low: vec![1.0; 4], high: vec![3.0; 4] };
    // The lower end moves from 1 to 1 − (√(1 + 0.9604) − 1) = 0.5999.
    let tally = coverage_of(&intervals, &observed, &noisy, Level::TWO_SIDED_95, None).unwrap()[0];
    assert_eq!((tally.truth_below, tally.missed), (3, 1));
}

#[test]
fn records_without_the_sides_of_misses_can_be_read() {
    let old = r#"{"total": 5, "covered": 4, "covered_uncorrected": 3, "constant": 2, "missed": 1}"#;
    let tally: CoverageTally = serde_json::from_str(old).unwrap();
    assert_eq!((tally.all(), tally.covered, tally.truth_above), (8, 4, 0));
}
