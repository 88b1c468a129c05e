use super::*;
use crate::{Level, Observed, SampleCounts};

const LEVELS: [Level; 3] = [Level::TWO_SIDED_95, Level::TWO_SIDED_99, Level::TWO_SIDED_998];

fn planes<'a>(
    mean: &'a [f32],
    variance: &'a [f32],
    counts: SampleCounts<'a>,
    width: usize,
) -> SamplePlanes<'a> {
    let observed = Observed { mean, variance, counts, pixels: mean.len(), valid: None };
    SamplePlanes { observed, width, third_moment: None, least: None, greatest: None }
}

fn of(id: &str, planes: &SamplePlanes<'_>, level: Level) -> IntervalPlanes {
    family(id).unwrap().intervals(planes, level).unwrap().unwrap()
}

/// Everything that a frame can have, of samples spread around 1.
struct Everything([Vec<f32>; 5]);

impl Everything {
    fn scaled(power: i32) -> Self {
        let mut normals = crate::random::Normals::new(3);
        let mut plane = |of: fn(f64) -> f64, dimension: i32| -> Vec<f32> {
            (0..96).map(|_| (of(normals.next()) * 2f64.powi(power * dimension)) as f32).collect()
        };
        Self([
            plane(|z| 1.0 + 0.2 * z, 1),
            plane(|z| 0.01 * z * z, 2),
            plane(|z| 2e-4 * z, 3),
            plane(|z| 0.5 - 0.1 * z.abs(), 1),
            plane(|z| 2.0 + z.abs(), 1),
        ])
    }

    fn planes(&self, n: u32) -> SamplePlanes<'_> {
        let [mean, variance, third, least, greatest] = &self.0;
        SamplePlanes {
            third_moment: Some(third),
            least: Some(least),
            greatest: Some(greatest),
            ..planes(mean, variance, SampleCounts::Uniform(n), 12)
        }
    }
}

#[test]
fn ids_are_unique_and_found_and_t_comes_first() {
    let mut ids: Vec<&str> = FAMILIES.iter().map(|family| family.id()).collect();
    assert_eq!(ids[0], "t");
    for id in &ids {
        assert_eq!(family(id).unwrap().id(), *id);
    }
    assert!(family("T").is_none());
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), FAMILIES.len());
}

#[test]
fn no_family_answers_without_what_it_needs_and_all_do_with_it() {
    let everything = Everything::scaled(0);
    let full = everything.planes(8);
    for family in FAMILIES {
        let needs = |need| family.needs().contains(&need);
        for (need, without) in [
            (IntervalNeed::ThirdMoment, SamplePlanes { third_moment: None, ..full }),
            (IntervalNeed::Extremes, SamplePlanes { least: None, ..full }),
            (IntervalNeed::Extremes, SamplePlanes { greatest: None, ..full }),
        ] {
            let got = family.intervals(&without, Level::TWO_SIDED_95).unwrap();
            assert_eq!(got.is_none(), needs(need), "{}", family.id());
        }
        assert!(family.intervals(&full, Level::TWO_SIDED_95).unwrap().is_some());
    }
}

#[test]
fn a_family_looks_at_other_pixels_only_if_it_says_so() {
    let mut everything = Everything::scaled(0);
    let before = everything.planes(8);
    let ends = |planes: &SamplePlanes<'_>| -> Vec<[f64; 2]> {
        FAMILIES
            .iter()
            .map(|family| {
                let all = family.intervals(planes, Level::TWO_SIDED_99).unwrap().unwrap();
                [all.low[50], all.high[50]]
            })
            .collect()
    };
    let old = ends(&before);
    // Pixel 49 is the left neighbour of pixel 50.
    everything.0.iter_mut().for_each(|plane| plane[49] = 9.0);
    let new = ends(&everything.planes(8));
    for ((family, old), new) in FAMILIES.iter().zip(old).zip(new) {
        assert_eq!(old != new, family.needs().contains(&IntervalNeed::Neighbours), "{}", family.id());
    }
}

#[test]
fn wider_levels_hold_narrower_ones_and_the_mean() {
    let everything = Everything::scaled(0);
    for n in [3, 8, 500] {
        let planes = everything.planes(n);
        for family in FAMILIES {
            let all = LEVELS.map(|level| of(family.id(), &planes, level));
            for i in 0..planes.observed.mean.len() {
                let mean = f64::from(planes.observed.mean[i]);
                assert!(all[0].low[i] <= mean && mean <= all[0].high[i], "{}", family.id());
                for pair in all.windows(2) {
                    assert!(pair[1].low[i] <= pair[0].low[i] && pair[0].high[i] <= pair[1].high[i]);
                }
            }
        }
    }
}

#[test]
fn an_upper_level_leaves_all_of_alpha_above_and_no_lower_end() {
    let (everything, level) = (Everything::scaled(0), Level::upper(0.95).unwrap());
    let planes = everything.planes(8);
    let limit = of("upper-t", &planes, Level::TWO_SIDED_95);
    for id in ["t", "asymmetric-t", "upper-t"] {
        assert_eq!(of(id, &planes, level), limit, "{id}");
    }
    for family in FAMILIES.iter().filter(|family| family.id() != "lower-t") {
        assert!(of(family.id(), &planes, level).low.iter().all(|low| *low == f64::NEG_INFINITY));
    }
    let lower = of("lower-t", &planes, level);
    assert!(lower.high.iter().all(|high| *high == f64::INFINITY));
    // A limit at 95 % is the end of the two-sided interval at 90 %.
    let both = of("t", &planes, Level::two_sided(0.9).unwrap());
    for (a, b) in lower.low.iter().zip(&both.low).chain(limit.high.iter().zip(&both.high)) {
        assert!((a - b).abs() < 1e-9 * b.abs().max(1.0), "{a} {b}");
    }
}

#[test]
fn a_family_has_the_ends_that_it_says() {
    let everything = Everything::scaled(0);
    for family in FAMILIES {
        let all = of(family.id(), &everything.planes(8), Level::TWO_SIDED_95);
        let both = all.low.iter().chain(&all.high).all(|end| end.is_finite());
        assert_eq!(both, family.has_both_ends(), "{}", family.id());
    }
}

#[test]
fn samples_that_are_not_skewed_have_the_t_interval() {
    let mut everything = Everything::scaled(0);
    everything.0[2].fill(0.0);
    let planes = everything.planes(5);
    let t = of("t", &planes, Level::TWO_SIDED_99);
    for id in ["hall", "johnson"] {
        let all = of(id, &planes, Level::TWO_SIDED_99);
        for (a, b) in all.low.iter().zip(&t.low).chain(all.high.iter().zip(&t.high)) {
            assert!((a - b).abs() < 1e-14 * (1.0 + b.abs()), "{id}: {a} {b}");
        }
    }
}

#[test]
fn hall_ends_where_the_transformed_statistic_is_the_critical_value() {
    let everything = Everything::scaled(0);
    let (n, planes) = (6u32, everything.planes(6));
    let ends = of("hall", &planes, Level::TWO_SIDED_95);
    let t = crate::t_quantile(Level::TWO_SIDED_95, 5);
    let count = f64::from(n);
    let mut skewed = 0;
    for i in 0..96 {
        let [mean, variance, third] = [0, 1, 2].map(|plane| f64::from(everything.0[plane][i]));
        let s = (variance * count).sqrt();
        let skewness = third / s.powi(3);
        if skewness.abs() > count.sqrt() {
            continue; // No 6 samples are as skewed.
        }
        skewed += 1;
        for (end, critical) in [(ends.low[i], t), (ends.high[i], -t)] {
            let statistic = (mean - end) * count.sqrt() / s;
            let transformed = statistic
                + skewness / count.sqrt() * (2.0 * statistic * statistic + 1.0) / 6.0
                + skewness * skewness * statistic.powi(3) / (27.0 * count);
            assert!((transformed - critical).abs() < 1e-9 * (1.0 + statistic.abs().powi(3)), "{i}");
        }
    }
    assert!(skewed > 40, "{skewed}");
}

#[test]
fn intervals_follow_exposure_bit_for_bit() {
    let (plain, bright) = (Everything::scaled(0), Everything::scaled(9));
    for family in FAMILIES {
        let [a, b] = [&plain, &bright].map(|frame| of(family.id(), &frame.planes(8), Level::TWO_SIDED_95));
        let scaled = |ends: &[f64]| ends.iter().map(|end| end * 512.0).collect::<Vec<f64>>();
        assert_eq!((scaled(&a.low), scaled(&a.high)), (b.low, b.high), "{}", family.id());
    }
}

#[test]
fn where_nothing_is_known_there_is_no_interval() {
    let mean = [1.0, f32::NAN, 1.0, 1.0, 1.0];
    let variance = [0.1, 0.1, f32::INFINITY, 0.1, -1.0];
    let (third, least, greatest) = ([0.0; 5], [0.5; 5], [2.0; 5]);
    let counts = [1, 4, 4, 4, 4];
    let planes = SamplePlanes {
        third_moment: Some(&third),
        least: Some(&least),
        greatest: Some(&greatest),
        ..planes(&mean, &variance, SampleCounts::PerPixel(&counts), 5)
    };
    for family in FAMILIES {
        let all = of(family.id(), &planes, Level::TWO_SIDED_95);
        for i in 0..3 {
            assert_eq!((all.low[i], all.high[i]), (f64::NEG_INFINITY, f64::INFINITY), "{}", family.id());
        }
        assert!(all.low[3].is_finite() || all.high[3].is_finite(), "{}", family.id());
        assert!(all.low.iter().chain(&all.high).all(|end| !end.is_nan()));
        assert!(all.low[4] <= 1.0 && all.high[4] >= 1.0, "a negative variance counts as 0");
    }
}

#[test]
fn two_samples_have_no_skewness_and_no_interval_that_needs_it() {
    let third = [f32::NAN];
    let two =
        SamplePlanes { third_moment: Some(&third), ..planes(&[1.0], &[0.1], SampleCounts::Uniform(2), 1) };
    for id in ["hall", "johnson"] {
        assert_eq!(of(id, &two, Level::TWO_SIDED_95).high, [f64::INFINITY]);
    }
    assert!(of("t", &two, Level::TWO_SIDED_95).high[0].is_finite());
}

#[test]
fn pooling_takes_the_mean_of_what_is_around_and_never_narrows() {
    // One noisy pixel in the corner of 10×9: seen by pixels up to 3 away.
    let mut variance = vec![0.0; 90];
    variance[0] = 16.0;
    let mean = vec![1.0; 90];
    let all = of("pooled-t", &planes(&mean, &variance, SampleCounts::Uniform(4), 10), Level::TWO_SIDED_95);
    let t = crate::t_quantile(Level::TWO_SIDED_95, 3);
    let high = |x: usize, y: usize| all.high[10 * y + x] - 1.0;
    assert!((high(0, 0) - 4.0 * t).abs() < 1e-12, "its own variance is larger than the mean of 4×4");
    assert!((high(1, 0) - t * (16.0f64 / 20.0).sqrt()).abs() < 1e-12, "5×4 pixels");
    assert!((high(3, 3) - t * (16.0f64 / 49.0).sqrt()).abs() < 1e-12, "the whole window");
    assert_eq!((high(4, 0), high(0, 4)), (0.0, 0.0));
    // Pixels that take no part, or have no variance, are not averaged.
    let mut counts = [4; 90];
    counts[10] = 1;
    let mut valid = vec![true; 90];
    valid[11] = false;
    let mut odd = planes(&mean, &variance, SampleCounts::PerPixel(&counts), 10);
    odd.observed.valid = Some(&valid);
    let all = of("pooled-t", &odd, Level::TWO_SIDED_95);
    assert!((all.high[1] - 1.0 - t * (16.0f64 / 18.0).sqrt()).abs() < 1e-12);
    assert_eq!(all.high[10], f64::INFINITY);
}

#[test]
fn light_that_a_neighbour_met_is_allowed_for() {
    // Five dark pixels in a row, the last but one with a bright sample.
    let (mean, variance) = ([0.0, 0.0, 0.0, 2.0, 0.0], [0.0, 0.0, 0.0, 4.0, 0.0]);
    let (least, greatest) = ([0.0; 5], [0.0, 0.0, 0.0, 8.0, 0.0]);
    let planes = SamplePlanes {
        least: Some(&least),
        greatest: Some(&greatest),
        ..planes(&mean, &variance, SampleCounts::Uniform(4), 5)
    };
    let all = of("rare-event-t", &planes, Level::TWO_SIDED_95);
    // A quarter of 5 % for what may have been missed: 8·(1 − 0.0125^(1/4)).
    let allowance = 8.0 * (1.0 - 0.0125f64.powf(0.25));
    for (i, low, high) in [(0, 0.0, allowance), (4, 0.0, allowance)] {
        assert!((all.low[i] - low).abs() < 1e-12 && (all.high[i] - high).abs() < 1e-12, "{i}");
    }
    let t = crate::t_quantile(Level::two_sided(0.975).unwrap(), 3);
    assert!((all.high[3] - 2.0 - 2.0 * t).abs() < 1e-9, "its own greatest sample is the greatest");
}

#[test]
fn planes_that_do_not_belong_together_are_refused() {
    let good = planes(&[1.0; 6], &[0.1; 6], SampleCounts::Uniform(4), 3);
    for (what, wrong) in [
        ("rows of the image's width together", SamplePlanes { width: 4, ..good }),
        ("rows of the image's width together", SamplePlanes { width: 0, ..good }),
        ("third moment", SamplePlanes { third_moment: Some(&[0.0; 5]), ..good }),
        ("least samples", SamplePlanes { least: Some(&[0.0; 5]), ..good }),
        ("greatest samples", SamplePlanes { greatest: Some(&[0.0; 5]), ..good }),
    ] {
        for family in FAMILIES {
            let error = family.intervals(&wrong, Level::TWO_SIDED_95).unwrap_err();
            assert_eq!(error.what, what, "{}", family.id());
        }
    }
    let nothing = planes(&[], &[], SampleCounts::Uniform(4), 0);
    assert_eq!(of("t", &nothing, Level::TWO_SIDED_95).low, [0.0; 0]);
}

#[test]
fn only_limits_promise_to_cover_at_least_as_often_as_they_say() {
    let promising: Vec<&str> = FAMILIES.iter().filter(|f| f.at_least()).map(|f| f.id()).collect();
    assert_eq!(promising, ["lower-t", "upper-t"]);
}
