//! Coverage without a reference: each replicate against the mean of the others.
//!
//! x̄_r − x̄_(−r) has the variance σ²/n·(1 + 1/(R−1)) = σ²/n·R/(R−1), and for normal samples it is independent of s_r: the
//! intervals x̄_r ± t·(s_r/√n)·√(R/(R−1)) cover the mean of the others exactly as often as stated, with no reference, no
//! variance of one and no allowance. This is the bias-eliminated coverage of Morris, White, Crowther 2019 (Table 6)
//! for few replicates. Their centre, the mean of all R, is for many: it contains x̄_r, so that four intervals of 95 % cover
//! as often as ones that are wider by 1/√(1−1/R) would.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::observed::{Tally, rounding, tally};
use crate::{Groups, Level, Observed, ShapeError};

/// Counts over pixel-channels of one replicate.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeaveOneOutTally {
    /// With s > 0.
    pub total: u64,
    /// Of those: covered.
    pub covered: u64,
    /// Of those: with the mean of the others above the interval.
    pub truth_above: u64,
    /// Of those: with the mean of the others below the interval.
    pub truth_below: u64,
    /// With s = 0 and the mean of the others, up to rounding. Light that every replicate missed is among them: only a
    /// reference can tell it from none.
    pub constant: u64,
    /// With s = 0 and another mean than the others: all samples missed the event.
    pub missed: u64,
}

impl LeaveOneOutTally {
    /// All pixel-channels.
    #[must_use]
    pub fn all(&self) -> u64 {
        self.total + self.constant + self.missed
    }

    /// Covered or constant over all; `None` if there is none at all.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        (self.all() > 0).then(|| (self.covered + self.constant) as f64 / self.all() as f64)
    }
}

impl Tally for LeaveOneOutTally {
    fn add(&mut self, other: &Self) {
        self.total += other.total;
        self.covered += other.covered;
        self.truth_above += other.truth_above;
        self.truth_below += other.truth_below;
        self.constant += other.constant;
        self.missed += other.missed;
    }
}

/// Replicates that cannot be held against each other.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum LeaveOneOutError {
    /// Fewer than two.
    #[error("{got} replicates, at least 2 are needed")]
    TooFewReplicates {
        /// Replicates given.
        got: usize,
    },
    /// Another number of samples than the first replicate has: the variance of the difference is then another.
    #[error("replicate {replicate} has {got} samples in pixel {pixel}, expected {expected} as in the first")]
    Counts {
        /// The replicate, from 0.
        replicate: usize,
        /// Its pixel.
        pixel: usize,
        /// Samples there.
        got: u32,
        /// Samples of the first replicate.
        expected: u32,
    },
    /// Slices that do not belong together.
    #[error("replicate {replicate}: {source}")]
    Shape {
        /// The replicate, from 0.
        replicate: usize,
        /// What is wrong with it.
        source: ShapeError,
    },
}

fn check(replicates: &[Observed<'_>]) -> Result<(), LeaveOneOutError> {
    let [first, others @ ..] = replicates else {
        return Err(LeaveOneOutError::TooFewReplicates { got: 0 });
    };
    if others.is_empty() {
        return Err(LeaveOneOutError::TooFewReplicates { got: 1 });
    }
    for (replicate, own) in replicates.iter().enumerate() {
        let shape = |source| LeaveOneOutError::Shape { replicate, source };
        own.check().map_err(shape)?;
        crate::observed::expect("pixels of a channel", own.pixels, first.pixels).map_err(shape)?;
        crate::observed::expect("mean", own.mean.len(), first.mean.len()).map_err(shape)?;
        for pixel in 0..own.pixels {
            let (got, expected) = (own.count_at(pixel), first.count_at(pixel));
            if got != expected {
                return Err(LeaveOneOutError::Counts { replicate, pixel, got, expected });
            }
        }
    }
    Ok(())
}

/// For each replicate: counts of pixel-channels whose interval at `level`, widened by √(R/(R−1)), covers the mean of the
/// other R−1 replicates, for all pixels (index 0) and each group (1 + group). The replicates' rates give an interval, as
/// those of [`crate::coverage`] do.
///
/// What differs from coverage of a reference is the centre: this asks whether the intervals are as wide as the means
/// spread, and is blind to an error that all replicates share. Where samples are skewed the others' mean is less skewed
/// than x̄_r but not symmetric, so that the rate is near that of the truth without being the same.
///
/// Covered means |x̄_r−x̄_(−r)| ≤ t_{n−1}·(s_r/√n)·√(R/(R−1)) + 4·eps·max(|x̄_r|,|x̄_(−r)|), with eps that of f32. Left out
/// are pixels that take no part in some replicate, pixels with fewer than 2 samples, and pixel-channels that are not finite
/// in some replicate.
///
/// # Errors
/// [`LeaveOneOutError`] below 2 replicates, if samples per pixel differ between replicates, or if slices do not belong
/// together.
pub fn leave_one_out(
    replicates: &[Observed<'_>],
    level: Level,
    groups: Option<Groups<'_>>,
) -> Result<Vec<Vec<LeaveOneOutTally>>, LeaveOneOutError> {
    check(replicates)?;
    let first = &replicates[0];
    let t = first.critical_values(level);
    let others = (replicates.len() - 1) as f64; // at least 1
    let widened = (1.0 + 1.0 / others).sqrt();
    let visit = |own: &Observed<'_>, pixel: usize| {
        let mut tally = LeaveOneOutTally::default();
        if first.count_at(pixel) < 2 || !replicates.iter().all(|r| r.takes_part(pixel)) {
            return tally;
        }
        for i in (pixel..first.mean.len()).step_by(first.pixels) {
            if replicates.iter().any(|r| !(r.mean[i].is_finite() && r.variance[i].is_finite())) {
                continue;
            }
            let mean = f64::from(own.mean[i]);
            // The own replicate adds 0.
            let apart = replicates.iter().map(|r| f64::from(r.mean[i]) - mean).sum::<f64>() / others;
            let variance = f64::from(own.variance[i]).max(0.0);
            let distance = apart.abs() - rounding(mean, mean + apart);
            let covered = distance <= t(pixel) * variance.sqrt() * widened;
            match (variance > 0.0, covered) {
                (true, _) => {
                    tally.total += 1;
                    tally.covered += u64::from(covered);
                    tally.truth_above += u64::from(!covered && apart > 0.0);
                    tally.truth_below += u64::from(!covered && apart < 0.0);
                }
                (false, true) => tally.constant += 1,
                (false, false) => tally.missed += 1,
            }
        }
        tally
    };
    let of_replicate = |(replicate, own): (usize, &Observed<'_>)| {
        let counted = tally(groups, first.pixels, |pixel| visit(own, pixel));
        counted.map_err(|source| LeaveOneOutError::Shape { replicate, source })
    };
    replicates.iter().enumerate().map(of_replicate).collect()
}

#[cfg(test)]
mod tests {
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
            let tallies = leave_one_out(&all, level, None).unwrap();
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
        let own = leave_one_out(&all, level, None).unwrap()[0][0].rate().unwrap();
        assert!((own - 0.95).abs() < 4.0 * mcse, "{own}");
        // x̄_r minus the mean of all four has the variance σ²/n·(1 − 1/4), independent of s.
        let centre: Vec<f32> =
            (0..pixels).map(|p| frames.iter().map(|f| f.0[p]).sum::<f32>() / 4.0).collect();
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
            leave_one_out(&all, Level::TWO_SIDED_95, None).unwrap()[0][0]
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
        let tallies = leave_one_out(&all, Level::TWO_SIDED_95, Some(groups)).unwrap();
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
}
