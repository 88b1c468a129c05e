//! Families whose ends are Student's critical values times the standard error, which differ in what they leave outside.

use super::critical::{Critical, Tails, reach};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use crate::{Level, ShapeError};

/// The work that all of them rest on.
pub(super) const STUDENT: &str = "Student, The probable error of a mean, Biometrika 6(1), 1908";

/// From x̄ − t(below)·s/√n to x̄ + t(above)·s/√n.
#[derive(Debug)]
pub(super) struct ByT {
    pub id: &'static str,
    pub name: &'static str,
    pub source: &'static str,
    /// What is left outside at a level.
    pub tails: fn(Level) -> Tails,
    /// Whether it is a limit on one side, which promises at least its level.
    pub limit: bool,
}

impl IntervalFamily for ByT {
    fn id(&self) -> &'static str {
        self.id
    }

    fn name(&self) -> &'static str {
        self.name
    }

    fn source(&self) -> &'static str {
        self.source
    }

    fn has_both_ends(&self) -> bool {
        !self.limit
    }

    fn at_least(&self) -> bool {
        self.limit
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
        let critical = Critical::new((self.tails)(level), planes.observed.counts);
        let intervals = each(planes, |seen| {
            let [below, above] = critical.at(seen.n).map(|t| reach(t, seen.standard_error));
            Some([seen.mean - below, seen.mean + above])
        })?;
        Ok(Some(intervals))
    }
}
