//! Coverage without a reference: each replicate against the mean of the others.
//!
//! x̄_r − x̄_(−r) has the variance σ²/n·(1 + 1/(R−1)) = σ²/n·R/(R−1), and for normal samples it is independent of s_r: the
//! intervals x̄_r ± t·(s_r/√n)·√(R/(R−1)) cover the mean of the others exactly as often as stated, with no reference, no
//! variance of one and no allowance. This is the bias-eliminated coverage of Morris, White, Crowther 2019 (Table 6)
//! for few replicates. Their centre, the mean of all R, is for many: it contains x̄_r, so that four intervals of 95 % cover
//! as often as ones that are wider by 1/√(1−1/R) would.

mod spread;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::observed::{LARGEST_GROUPS, Tally, expect, rounding};
use crate::{Groups, Level, Observed, ShapeError};

pub use spread::{PixelSpread, leave_one_out_interval};

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
        expect("pixels of a channel", own.pixels, first.pixels).map_err(shape)?;
        expect("mean", own.mean.len(), first.mean.len()).map_err(shape)?;
        for pixel in 0..own.pixels {
            let (got, expected) = (own.count_at(pixel), first.count_at(pixel));
            if got != expected {
                return Err(LeaveOneOutError::Counts { replicate, pixel, got, expected });
            }
        }
    }
    Ok(())
}

/// Counts of all replicates.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeaveOneOut {
    /// Of each replicate: all pixels (index 0) and each group (1 + group).
    pub replicates: Vec<Vec<LeaveOneOutTally>>,
    /// How the misses of all replicates and channels together spread over pixels, in the same order.
    pub spreads: Vec<PixelSpread>,
}

/// For each replicate: counts of pixel-channels whose interval at `level`, widened by √(R/(R−1)), covers the mean of the
/// other R−1 replicates, for all pixels and each group. [`leave_one_out_interval`] makes an interval of their rates.
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
) -> Result<LeaveOneOut, LeaveOneOutError> {
    check(replicates)?;
    let first = &replicates[0];
    if let Some(groups) = groups {
        let shape = |source| LeaveOneOutError::Shape { replicate: 0, source };
        expect("group map", groups.of_pixel.len(), first.pixels).map_err(shape)?;
    }
    let t = first.critical_values(level);
    let others = (replicates.len() - 1) as f64; // at least 1
    let widened = (1.0 + 1.0 / others).sqrt();
    let count = 1 + groups.map_or(0, |g| g.count.min(LARGEST_GROUPS));
    let mut out = LeaveOneOut {
        replicates: vec![vec![LeaveOneOutTally::default(); count]; replicates.len()],
        spreads: vec![PixelSpread::default(); count],
    };
    for pixel in 0..first.pixels {
        if first.count_at(pixel) < 2 || !replicates.iter().all(|r| r.takes_part(pixel)) {
            continue;
        }
        let group = groups.map(|g| 1 + usize::from(g.of_pixel[pixel])).filter(|index| *index < count);
        let (mut misses, mut trials) = (0, 0);
        for (tallies, own) in out.replicates.iter_mut().zip(replicates) {
            let tally = of_pixel(own, replicates, pixel, t(pixel) * widened);
            misses += tally.total - tally.covered;
            trials += tally.total;
            [Some(0), group].into_iter().flatten().for_each(|index| tallies[index].add(&tally));
        }
        [Some(0), group].into_iter().flatten().for_each(|index| out.spreads[index].add(misses, trials));
    }
    Ok(out)
}

/// Counts of the channels of a pixel in one replicate; half-widths are `critical` times √(s²/n).
fn of_pixel(
    own: &Observed<'_>,
    replicates: &[Observed<'_>],
    pixel: usize,
    critical: f64,
) -> LeaveOneOutTally {
    let others = (replicates.len() - 1) as f64; // at least 1
    let mut tally = LeaveOneOutTally::default();
    for i in (pixel..own.mean.len()).step_by(own.pixels) {
        if replicates.iter().any(|r| !(r.mean[i].is_finite() && r.variance[i].is_finite())) {
            continue;
        }
        let mean = f64::from(own.mean[i]);
        // The own replicate adds 0.
        let apart = replicates.iter().map(|r| f64::from(r.mean[i]) - mean).sum::<f64>() / others;
        let variance = f64::from(own.variance[i]).max(0.0);
        let distance = apart.abs() - rounding(mean, mean + apart);
        let covered = distance <= critical * variance.sqrt();
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
}

#[cfg(test)]
mod tests;
