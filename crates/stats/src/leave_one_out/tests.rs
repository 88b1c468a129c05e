use super::*;
use crate::random::Normals;
use crate::{SampleCounts, Truth, coverage, rate_standard_error, t_quantile, t_two_sided_p};

/// Means and variances of the mean of `n` normal samples about 1, in `pixels` pixels.
fn frame(normals: &mut Normals, n: u32, pixels: usize) -> (Vec<f32>, Vec<f32>) {
    let pixel = |_| {
        let samples: Vec<f64> = (0..n).map(|_| 1.0 + 0.3 * normals.next()).collect();
        let (mean, variance) = crate::interval::mean_and_variance(&samples).unwrap();
        (mean as f32, (variance / f64::from(n)) as f32)
    };
    (0..pixels).map(pixel).unzip()
}

fn observed<'a>(frame: &'a (Vec<f32>, Vec<f32>), n: u32) -> Observed<'a> {
    Observed {
        mean: &frame.0,
        variance: &frame.1,
        counts: SampleCounts::Uniform(n),
        pixels: frame.0.len(),
        valid: None,
    }
}

#[test]
fn intervals_of_normal_samples_cover_as_often_as_stated() {
    let pixels = 20_000;
    let level = Level::TWO_SIDED_95;
    for (replicates, n) in [(2, 2u32), (2, 16), (4, 4), (8, 3)] {
        let mut normals = Normals::new(u64::from(100 * replicates + n));
        let frames: Vec<_> = (0..replicates).map(|_| frame(&mut normals, n, pixels)).collect();
        let all: Vec<_> = frames.iter().map(|f| observed(f, n)).collect();
        let tallies = leave_one_out(&all, level, None).unwrap().replicates;
        // One replicate alone: its pixels are independent.
        let mcse = rate_standard_error(0.95, pixels as u64);
        for own in [&tallies[0][0], &tallies[replicates as usize - 1][0]] {
            let rate = own.rate().unwrap();
            assert!((rate - 0.95).abs() < 4.0 * mcse, "R = {replicates}, n = {n}: {rate}");
            assert_eq!(own.total, own.covered + own.truth_above + own.truth_below);
            let balance = own.truth_above.abs_diff(own.truth_below) as f64;
            assert!(balance < 4.0 * (0.05 * pixels as f64).sqrt(), "{own:?}");
        }
    }
}

#[test]
fn a_wrong_reference_changes_nothing_and_the_mean_of_all_covers_too_often() {
    let (pixels, n, level) = (20_000usize, 16u32, Level::TWO_SIDED_95);
    let mut normals = Normals::new(5);
    let frames: Vec<_> = (0..4).map(|_| frame(&mut normals, n, pixels)).collect();
    let all: Vec<_> = frames.iter().map(|f| observed(f, n)).collect();
    let mcse = rate_standard_error(0.95, pixels as u64);
    // The truth is 1; this reference is one standard error of a mean beside it.
    let wrong = vec![1.0 + 0.3 / 4.0; pixels];
    let against = |mean: &[f32]| {
        let tallies = coverage(&all[0], &Truth { mean, variance: None }, level, None).unwrap();
        tallies[0].rate().unwrap()
    };
    assert!(against(&wrong) < 0.95 - 40.0 * mcse);
    let own = leave_one_out(&all, level, None).unwrap().replicates[0][0].rate().unwrap();
    assert!((own - 0.95).abs() < 4.0 * mcse, "{own}");
    // x̄_r minus the mean of all four has the variance σ²/n·(1 − 1/4), independent of s.
    let centre: Vec<f32> = (0..pixels).map(|p| frames.iter().map(|f| f.0[p]).sum::<f32>() / 4.0).collect();
    let expected = 1.0 - t_two_sided_p(t_quantile(level, 15) / 0.75f64.sqrt(), 15);
    assert!(expected > 0.97);
    assert!((against(&centre) - expected).abs() < 4.0 * mcse, "{} {expected}", against(&centre));
}

#[test]
fn an_interval_is_widened_by_the_noise_of_the_others() {
    // t(95 %, 15) = 2.131450; √(3/2)·0.5·t = 1.305241.
    let count = |others: f32| {
        let frames = [(vec![0.0], vec![0.25]), (vec![others], vec![0.25]), (vec![others], vec![0.0])];
        let all: Vec<_> = frames.iter().map(|f| observed(f, 16)).collect();
        leave_one_out(&all, Level::TWO_SIDED_95, None).unwrap().replicates[0][0]
    };
    assert_eq!(count(1.3052), LeaveOneOutTally { total: 1, covered: 1, ..Default::default() });
    assert_eq!(count(1.3053), LeaveOneOutTally { total: 1, truth_above: 1, ..Default::default() });
    assert_eq!(count(-1.3053), LeaveOneOutTally { total: 1, truth_below: 1, ..Default::default() });
}

#[test]
fn constant_missed_and_unknown_pixels_are_told_apart() {
    let frames = [
        (vec![1.0, 0.0, 2.0, f32::NAN], vec![0.0, 0.0, 0.1, 0.1]),
        (vec![1.0, 0.5, 2.0, 1.0], vec![0.0, 0.1, 0.1, 0.1]),
    ];
    let all: Vec<_> = frames.iter().map(|f| observed(f, 4)).collect();
    let groups = Groups { of_pixel: &[0, 1, 1, 1], count: 2 };
    let tallies = leave_one_out(&all, Level::TWO_SIDED_95, Some(groups)).unwrap().replicates;
    let first = LeaveOneOutTally { total: 1, covered: 1, constant: 1, missed: 1, ..Default::default() };
    assert_eq!(tallies[0][0], first);
    assert_eq!(tallies[0][1], LeaveOneOutTally { constant: 1, ..Default::default() });
    assert_eq!(first.rate(), Some(2.0 / 3.0));
    assert_eq!((tallies[1][0].total, tallies[1][0].missed), (2, 0));
}

#[test]
fn replicates_that_do_not_belong_together_are_refused() {
    let frame = (vec![1.0; 2], vec![0.1; 2]);
    let one = observed(&frame, 4);
    let refuse = |all: &[Observed<'_>]| leave_one_out(all, Level::TWO_SIDED_95, None).unwrap_err();
    assert_eq!(refuse(&[one]).to_string(), "1 replicates, at least 2 are needed");
    let other = Observed { counts: SampleCounts::PerPixel(&[4, 5]), ..one };
    let told = refuse(&[one, other]).to_string();
    assert_eq!(told, "replicate 1 has 5 samples in pixel 1, expected 4 as in the first");
    let short = (vec![1.0], vec![0.1]);
    let told = refuse(&[one, observed(&short, 4)]).to_string();
    assert_eq!(told, "replicate 1: pixels of a channel has 1 entries, expected 2");
}

/// How often the interval over replicates alone, and the one that looks at pixels as well, contain 0.95: `draws` levels of
/// `pixels` independent pixels of `n` normal samples.
fn coverage_of_intervals(replicates: usize, n: u32, pixels: usize, draws: u64) -> [f64; 2] {
    let mut normals = Normals::new(31 + replicates as u64);
    let mut inside = [0u32; 2];
    for _ in 0..draws {
        let frames: Vec<_> = (0..replicates).map(|_| frame(&mut normals, n, pixels)).collect();
        let all: Vec<_> = frames.iter().map(|f| observed(f, n)).collect();
        let found = leave_one_out(&all, Level::TWO_SIDED_95, None).unwrap();
        let rates: Vec<f64> = found.replicates.iter().map(|tallies| tallies[0].rate().unwrap()).collect();
        let level = Level::TWO_SIDED_95;
        let plain = crate::proportion_interval(&rates, 0, level).unwrap();
        let wider = leave_one_out_interval(&rates, &found.spreads[0], level).unwrap();
        for (count, interval) in inside.iter_mut().zip([plain, wider]) {
            *count += u32::from(!interval.excludes(0.95));
        }
    }
    inside.map(|count| f64::from(count) / draws as f64)
}

#[test]
fn the_spread_over_pixels_mends_what_the_dependence_of_replicates_spoils() {
    let draws = 250;
    let mcse = |rate: f64| rate_standard_error(rate, draws);
    for (replicates, n) in [(2, 64), (4, 16)] {
        let [plain, wider] = coverage_of_intervals(replicates, n, 200, draws);
        assert!(wider > 0.95 - 4.0 * mcse(0.95), "R = {replicates}, n = {n}: {wider}");
        assert!(plain <= wider);
        if replicates == 2 {
            assert!(plain < 0.95 - 4.0 * mcse(0.95), "two replicates spread too little: {plain}");
        }
    }
}

#[test]
fn pixels_are_the_clusters_of_the_spread() {
    let spread = |pixels: &[(u64, u64)]| {
        let mut out = PixelSpread::default();
        pixels.iter().for_each(|(misses, trials)| out.add(*misses, *trials));
        out
    };
    // 100 pixels, 10 of which miss in all of their 6 trials: √(0.1·0.9/99).
    let mut all = vec![(0, 6); 90];
    all.extend([(6, 6); 10]);
    all.push((0, 0));
    let found = spread(&all);
    assert_eq!(found.pixels(), 100);
    assert!((found.standard_error().unwrap() - (0.09f64 / 99.0).sqrt()).abs() < 1e-12);
    assert_eq!(spread(&[(1, 3)]).standard_error(), None);
    // All replicates cover everything: the rule of three over pixels, two-sided.
    let none = leave_one_out_interval(&[1.0; 4], &spread(&[(0, 12); 1000]), Level::TWO_SIDED_95).unwrap();
    assert!((1.0 - none.low.unwrap() - 3.68e-3).abs() < 1e-4, "{none:?}");
    assert_eq!(leave_one_out_interval(&[0.9], &found, Level::TWO_SIDED_95), None);
}
