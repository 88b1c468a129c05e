use super::critical::{Critical, Tails, reach};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use super::window::window;
use crate::{Level, ShapeError};

/// The t-interval with the larger of the pixel's own variance of the mean and the average of those in the 7×7 pixels around
/// it, cut at the borders; the critical value stays that of the pixel's own n−1 degrees of freedom.
///
/// A heuristic: where few samples missed the light of a pixel its neighbours may have met it. It widens, never narrows, and
/// beside brighter surfaces it widens without need; what it covers is measured, nothing is proven. Averaged are the
/// variances that are finite, of pixels that take part and have at least 2 samples.
#[derive(Debug)]
pub(super) struct PooledT;

impl IntervalFamily for PooledT {
    fn id(&self) -> &'static str {
        "pooled-t"
    }

    fn name(&self) -> &'static str {
        "t with pooled variance"
    }

    fn source(&self) -> &'static str {
        "none: a heuristic, no theorem gives its level"
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[IntervalNeed::Neighbours]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        planes.check()?;
        let observed = &planes.observed;
        let critical = Critical::new(Tails::equal(level), observed.counts);
        let intervals = each(planes, |seen| {
            let known =
                |&i: &usize| observed.count_at(i % observed.pixels) >= 2 && observed.variance[i].is_finite();
            let (sum, count) =
                window(planes, seen.index).filter(known).fold((0.0, 0u32), |(sum, count), i| {
                    (sum + f64::from(observed.variance[i]).max(0.0), count + 1)
                });
            // The pixel itself is one of them.
            let pooled = (sum / f64::from(count)).sqrt();
            let spread = seen.standard_error.max(pooled);
            let [below, above] = critical.at(seen.n).map(|t| reach(t, spread));
            Some([seen.mean - below, seen.mean + above])
        })?;
        Ok(Some(intervals))
    }
}
