//! How often a test tells pixels apart, over pairs of pixels of which it is known whether they are equal.

use serde::{Deserialize, Serialize};

use super::mean::SampleMean;
use super::test::MembershipTest;
use crate::observed::{Tally, expect, tally};
use crate::{Groups, Level, Observed, ShapeError};

/// Counts over pairs of pixels and their channels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RejectionTally {
    /// Channels whose centre has s > 0.
    pub total: u64,
    /// Of those: told apart.
    pub rejected: u64,
    /// Channels whose centre has s = 0, where no shift is made.
    pub constant: u64,
    /// Of those: told apart.
    pub constant_rejected: u64,
    /// Pixels all of whose channels can be tested.
    pub pixels: u64,
    /// Of those: told apart in at least one channel, the joint test of colours.
    pub pixels_rejected: u64,
}

impl RejectionTally {
    /// Share of channels with s > 0 that are told apart; `None` if there is none.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        (self.total > 0).then(|| self.rejected as f64 / self.total as f64)
    }

    /// Share of pixels that are told apart in at least one channel; `None` if there is none.
    #[must_use]
    pub fn joint_rate(&self) -> Option<f64> {
        (self.pixels > 0).then(|| self.pixels_rejected as f64 / self.pixels as f64)
    }
}

impl Tally for RejectionTally {
    fn add(&mut self, other: &Self) {
        self.total += other.total;
        self.rejected += other.rejected;
        self.constant += other.constant;
        self.constant_rejected += other.constant_rejected;
        self.pixels += other.pixels;
        self.pixels_rejected += other.pixels_rejected;
    }
}

/// Counts how often a pixel is told apart from the same pixel of another replicate, for all pixels (index 0) and each group
/// (1 + group).
///
/// The pair has one mean, so without a shift every rejection is false: the rate is that of false alarms. With a shift the
/// other mean is moved up by that many standard errors s/√n of the centre, as estimated: the rate is the power against
/// that difference. Both frames must show the same scene with samples of their own. Left out are pixels that take no part
/// in either, and channels that cannot be tested.
///
/// # Errors
/// [`ShapeError`] if the frames do not belong together.
pub fn rejections(
    centre: &Observed<'_>,
    other: &Observed<'_>,
    test: MembershipTest,
    shift: f64,
    level: Level,
    groups: Option<Groups<'_>>,
) -> Result<Vec<RejectionTally>, ShapeError> {
    centre.check()?;
    other.check()?;
    expect("means of the other replicate", other.mean.len(), centre.mean.len())?;
    expect("pixels of the other replicate", other.pixels, centre.pixels)?;
    let critical = [centre, other].map(|observed| observed.critical_values(level));
    let at = |observed: &Observed<'_>, i: usize, pixel: usize| SampleMean {
        mean: f64::from(observed.mean[i]),
        variance: f64::from(observed.variance[i]),
        n: observed.count_at(pixel),
    };
    tally(groups, centre.pixels, |pixel| {
        let mut tally = RejectionTally::default();
        if !centre.takes_part(pixel) || !other.takes_part(pixel) {
            return tally;
        }
        let [of_centre, of_other] = critical.each_ref().map(|critical| critical(pixel));
        let (mut tested, mut apart) = (true, false);
        for i in (pixel..centre.mean.len()).step_by(centre.pixels) {
            let (p, mut q) = (at(centre, i, pixel), at(other, i, pixel));
            q.mean += shift * p.standard_error();
            // Two counts at most, so that the table is looked at once a pixel.
            let critical = |n| if n == p.n { of_centre } else { of_other };
            let Some(rejected) = test.rejects_with(&p, &q, level, critical) else {
                tested = false;
                continue;
            };
            let (total, counted) = if p.variance > 0.0 {
                (&mut tally.total, &mut tally.rejected)
            } else {
                (&mut tally.constant, &mut tally.constant_rejected)
            };
            *total += 1;
            *counted += u64::from(rejected);
            apart |= rejected;
        }
        if tested && !centre.mean.is_empty() {
            tally.pixels += 1;
            tally.pixels_rejected += u64::from(apart);
        }
        tally
    })
}
