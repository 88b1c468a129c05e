use super::critical::{Critical, Tails, reach};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use crate::{Level, ShapeError};

/// x̄ ± t·s/√n (Student 1908): exact for independent normal samples.
#[derive(Debug)]
pub(super) struct StudentT;

impl IntervalFamily for StudentT {
    fn id(&self) -> &'static str {
        "t"
    }

    fn name(&self) -> &'static str {
        "Student's t"
    }

    fn source(&self) -> &'static str {
        "Student, The probable error of a mean, Biometrika 6(1), 1908"
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        planes.check()?;
        let critical = Critical::new(Tails::equal(level), planes.observed.counts);
        let intervals = each(planes, |seen| {
            let [below, above] = critical.at(seen.n).map(|t| reach(t, seen.standard_error));
            Some([seen.mean - below, seen.mean + above])
        })?;
        Ok(Some(intervals))
    }
}
