use super::critical::{Critical, Tails, reach};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use super::skewness::skewness_over_root_n;
use crate::{Level, ShapeError};

/// x̄ + μ̂₃/(6·s²·n) ± t·s/√n with μ̂₃ = Σ(x − x̄)³/n: the t-interval with its centre shifted by the skewness (Johnson 1978).
///
/// A published baseline whose two-sided gain is nil: of exponential samples it covers at 95 % and 4, 8, 16, 32 samples
/// 88.15, 89.73, 91.62, 93.05 % where t covers 88.07, 89.48, 91.35, 92.85 %; of log-normal ones (σ = 1) at 16 samples
/// 86.3 where t covers 85.8. The shift is at most a sixth of a standard error, which is little beside t of them.
#[derive(Debug)]
pub(super) struct Johnson;

impl IntervalFamily for Johnson {
    fn id(&self) -> &'static str {
        "johnson"
    }

    fn name(&self) -> &'static str {
        "Johnson's shifted t"
    }

    fn source(&self) -> &'static str {
        "Johnson, Modified t tests and confidence intervals for asymmetrical populations, \
         J. Amer. Statist. Assoc. 73(363), 1978"
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[IntervalNeed::ThirdMoment]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        planes.check()?;
        let Some(third_moment) = planes.third_moment else { return Ok(None) };
        let critical = Critical::new(Tails::equal(level), planes.observed.counts);
        let intervals = each(planes, |seen| {
            // μ̂₃ = k₃·(n − 1)·(n − 2)/n², and k₃/(6·s²·n) = (s/√n)·a/6 with a = k₃/(s³·√n).
            let a = skewness_over_root_n(third_moment[seen.index], seen)?;
            let n = f64::from(seen.n);
            let shift = a / 6.0 * ((n - 1.0) / n) * ((n - 2.0) / n);
            let centre = seen.mean + seen.standard_error * shift;
            let [below, above] = critical.at(seen.n).map(|t| reach(t, seen.standard_error));
            Some([centre - below, centre + above])
        })?;
        Ok(Some(intervals))
    }
}
