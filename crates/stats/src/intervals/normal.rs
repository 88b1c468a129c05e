use super::critical::{Tails, reach};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use crate::student::normal_beyond;
use crate::{Level, ShapeError};

/// x̄ ± z·s/√n with the normal quantile z: right for many samples, by the central limit theorem, and too narrow for few.
#[derive(Debug)]
pub(super) struct NormalInterval;

impl IntervalFamily for NormalInterval {
    fn id(&self) -> &'static str {
        "normal"
    }

    fn name(&self) -> &'static str {
        "normal"
    }

    fn source(&self) -> &'static str {
        "central limit theorem, n → ∞ (Lehmann, Elements of large-sample theory, Springer 1999, Sec. 4.1)"
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        let tails = Tails::equal(level);
        let critical = [tails.below, tails.above].map(|tail| tail.map_or(f64::INFINITY, normal_beyond));
        let intervals = each(planes, |seen| {
            let [below, above] = critical.map(|z| reach(z, seen.standard_error));
            Some([seen.mean - below, seen.mean + above])
        })?;
        Ok(Some(intervals))
    }
}
