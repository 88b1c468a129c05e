//! Coverage of the intervals of sample means (of t-intervals: moon2013flash, Table 1).

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::observed::{Tally, expect, rounding, tally};
use crate::{Groups, IntervalPlanes, Level, Observed, ShapeError, Truth, normal_quantile};

/// Counts over pixel-channels. A miss is on one side: `covered`, `truth_above` and `truth_below` add up to `total`, and so do
/// the three without allowance.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CoverageTally {
    /// With s > 0.
    pub total: u64,
    /// Of those: covered, allowing for the noise of the truth.
    pub covered: u64,
    /// Of those: covered without that allowance.
    pub covered_uncorrected: u64,
    /// Of those: the truth lies above the interval, allowing for its noise.
    #[serde(default)]
    pub truth_above: u64,
    /// Of those: the truth lies above the interval, without that allowance.
    #[serde(default)]
    pub truth_above_uncorrected: u64,
    /// Of those: the truth lies below the interval, allowing for its noise.
    #[serde(default)]
    pub truth_below: u64,
    /// Of those: the truth lies below the interval, without that allowance.
    #[serde(default)]
    pub truth_below_uncorrected: u64,
    /// With s = 0 and an interval that covers the truth, allowing for its noise: a t-interval is then the mean alone.
    pub constant: u64,
    /// With s = 0 and an interval that does not: all samples missed the event.
    pub missed: u64,
}

impl CoverageTally {
    /// All pixel-channels.
    #[must_use]
    pub fn all(&self) -> u64 {
        self.total + self.constant + self.missed
    }

    /// Covered or constant over all, allowing for the noise of the truth; `None` if there is none at all.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        (self.all() > 0).then(|| (self.covered + self.constant) as f64 / self.all() as f64)
    }

    /// Counts one pixel-channel.
    fn count(&mut self, varies: bool, uncorrected: Side, corrected: Side) {
        if !varies {
            let counted = if corrected == Side::Inside { &mut self.constant } else { &mut self.missed };
            *counted += 1;
            return;
        }
        self.total += 1;
        *match corrected {
            Side::Inside => &mut self.covered,
            Side::Above => &mut self.truth_above,
            Side::Below => &mut self.truth_below,
        } += 1;
        *match uncorrected {
            Side::Inside => &mut self.covered_uncorrected,
            Side::Above => &mut self.truth_above_uncorrected,
            Side::Below => &mut self.truth_below_uncorrected,
        } += 1;
    }
}

impl Tally for CoverageTally {
    fn add(&mut self, other: &Self) {
        self.total += other.total;
        self.covered += other.covered;
        self.covered_uncorrected += other.covered_uncorrected;
        self.truth_above += other.truth_above;
        self.truth_above_uncorrected += other.truth_above_uncorrected;
        self.truth_below += other.truth_below;
        self.truth_below_uncorrected += other.truth_below_uncorrected;
        self.constant += other.constant;
        self.missed += other.missed;
    }
}

/// Where the truth lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    Inside,
    Above,
}

/// A truth r beside an interval from x̄ − below to x̄ + above, each end moved outwards as if the noise of the truth were
/// one more error in quadrature, and by what rounding may move both numbers.
fn side(mean: f64, r: f64, [below, above]: [f64; 2], allowance: f64) -> Side {
    let rounding = rounding(mean, r);
    if (r - mean) - rounding > widened(above, allowance) {
        Side::Above
    } else if (mean - r) - rounding > widened(below, allowance) {
        Side::Below
    } else {
        Side::Inside
    }
}

/// √(d² + w²) for the distance d of an end from the mean. An end on the other side of the mean, d < 0, moves as far outwards:
/// by √(d² + w²) − |d|.
fn widened(distance: f64, allowance: f64) -> f64 {
    let length = distance.hypot(allowance);
    // The fraction has no cancellation, and below 0 no denominator of 0.
    if distance < 0.0 { distance + allowance * allowance / (length - distance) } else { length }
}

/// Counts pixel-channels whose t-interval at `level` covers the truth, for all pixels (index 0) and each group
/// (1 + group): [`coverage_of`] for Student's t.
///
/// Covered means |x̄−r| ≤ √((t·s/√n)² + t_r²·v_r) + 4·eps·max(|x̄|,|r|), with t Student's critical value for
/// n−1 degrees of freedom, t_r the normal one, v_r the variance of the truth and eps that of f32. Without the
/// allowance, v_r = 0. The allowance assumes near-normal errors of both, so a noisy truth should have at
/// least 16 times the samples. Of an upper level this takes the critical value, on both sides of the mean.
///
/// Pixels with fewer than 2 samples have no interval and are left out, like pixel-channels that are not
/// finite.
///
/// # Errors
/// [`ShapeError`] if the slices do not belong together.
pub fn coverage(
    observed: &Observed<'_>,
    truth: &Truth<'_>,
    level: Level,
    groups: Option<Groups<'_>>,
) -> Result<Vec<CoverageTally>, ShapeError> {
    observed.check()?;
    let t = observed.critical_values(level);
    count(observed, truth, level, groups, |i| {
        let pixel = i % observed.pixels;
        let reach = t(pixel) * f64::from(observed.variance[i]).max(0.0).sqrt();
        (observed.count_at(pixel) >= 2).then_some([reach; 2])
    })
}

/// Counts pixel-channels whose interval covers the truth, for all pixels (index 0) and each group (1 + group).
///
/// Each end is moved outwards by the noise of the truth: an end at distance d from the mean x̄ moves to √(d² + t_r²·v_r), with
/// t_r the normal critical value of `level` and v_r the variance of the truth. For an interval of normal means with a normal
/// truth that keeps the level on each side, and so does it for ends at different distances. Besides, 4·eps·max(|x̄|,|r|) is
/// allowed for rounding. Uncorrected, v_r = 0.
///
/// A pixel-channel with s = 0 is counted apart, and judged by its interval, which families that look further than the pixel
/// may give it. Where no end is finite there is no interval: left out, like pixel-channels that are not finite.
///
/// # Errors
/// [`ShapeError`] if the slices do not belong together.
pub fn coverage_of(
    intervals: &IntervalPlanes,
    observed: &Observed<'_>,
    truth: &Truth<'_>,
    level: Level,
    groups: Option<Groups<'_>>,
) -> Result<Vec<CoverageTally>, ShapeError> {
    count(observed, truth, level, groups, reach_of(intervals, observed)?)
}

/// The counts of [`coverage_of`] in every pixel, all channels together; row by row.
///
/// # Errors
/// [`ShapeError`] if the slices do not belong together.
pub fn coverage_of_pixels(
    intervals: &IntervalPlanes,
    observed: &Observed<'_>,
    truth: &Truth<'_>,
    level: Level,
) -> Result<Vec<CoverageTally>, ShapeError> {
    let reach = reach_of(intervals, observed)?;
    truth.check(observed.mean.len())?;
    let t_truth = normal_quantile(level);
    Ok((0..observed.pixels).map(|pixel| of_pixel(observed, truth, t_truth, &reach, pixel)).collect())
}

/// Distances of both ends from the mean, where there is an interval.
fn reach_of<'a>(
    intervals: &'a IntervalPlanes,
    observed: &'a Observed<'_>,
) -> Result<impl Fn(usize) -> Option<[f64; 2]> + 'a, ShapeError> {
    observed.check()?;
    expect("lower ends", intervals.low.len(), observed.mean.len())?;
    expect("upper ends", intervals.high.len(), observed.mean.len())?;
    Ok(move |i: usize| {
        let mean = f64::from(observed.mean[i]);
        let (below, above) = (mean - intervals.low[i], intervals.high[i] - mean);
        (below.is_finite() || above.is_finite()).then_some([below, above])
    })
}

/// Counts with `reach`, the distances of the lower and the upper end from the mean.
fn count(
    observed: &Observed<'_>,
    truth: &Truth<'_>,
    level: Level,
    groups: Option<Groups<'_>>,
    reach: impl Fn(usize) -> Option<[f64; 2]>,
) -> Result<Vec<CoverageTally>, ShapeError> {
    truth.check(observed.mean.len())?;
    let t_truth = normal_quantile(level);
    tally(groups, observed.pixels, |pixel| of_pixel(observed, truth, t_truth, &reach, pixel))
}

/// The channels of a pixel; `t_truth` is the critical value of the truth's noise.
fn of_pixel(
    observed: &Observed<'_>,
    truth: &Truth<'_>,
    t_truth: f64,
    reach: &impl Fn(usize) -> Option<[f64; 2]>,
    pixel: usize,
) -> CoverageTally {
    let mut tally = CoverageTally::default();
    if !observed.takes_part(pixel) {
        return tally;
    }
    for i in (pixel..observed.mean.len()).step_by(observed.pixels) {
        let (mean, r) = (f64::from(observed.mean[i]), f64::from(truth.mean[i]));
        let (variance, noise) = (f64::from(observed.variance[i]).max(0.0), truth.variance_at(i));
        if !(mean - r + variance + noise).is_finite() {
            continue;
        }
        if let Some(reach) = reach(i) {
            let corrected = side(mean, r, reach, t_truth * noise.sqrt());
            tally.count(variance > 0.0, side(mean, r, reach, 0.0), corrected);
        }
    }
    tally
}
