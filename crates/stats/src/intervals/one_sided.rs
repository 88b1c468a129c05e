//! Limits on one side. Of a level they read 1−α alone: the limit at 95 % of a two-sided level of 95 % leaves 5 % beyond it.

use super::critical::{Critical, Tails, reach};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use crate::{Level, ShapeError};

const SOURCE: &str = "Student, The probable error of a mean, Biometrika 6(1), 1908";

/// From x̄ − t(α)·s/√n on: exact for independent normal samples. Samples skewed to the right lie above it more often than
/// 1−α.
#[derive(Debug)]
pub(super) struct LowerT;

/// Up to x̄ + t(α)·s/√n: exact for independent normal samples. Samples skewed to the right lie below it less often than 1−α.
#[derive(Debug)]
pub(super) struct UpperT;

fn limits(planes: &SamplePlanes<'_>, tails: Tails) -> Result<Option<IntervalPlanes>, ShapeError> {
    planes.check()?;
    let critical = Critical::new(tails, planes.observed.counts);
    let intervals = each(planes, |seen| {
        let [below, above] = critical.at(seen.n).map(|t| reach(t, seen.standard_error));
        Some([seen.mean - below, seen.mean + above])
    })?;
    Ok(Some(intervals))
}

impl IntervalFamily for LowerT {
    fn id(&self) -> &'static str {
        "lower-t"
    }

    fn name(&self) -> &'static str {
        "lower limit by t"
    }

    fn source(&self) -> &'static str {
        SOURCE
    }

    fn has_both_ends(&self) -> bool {
        false
    }

    fn at_least(&self) -> bool {
        true
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        limits(planes, Tails { below: Some(level.alpha()), above: None })
    }
}

impl IntervalFamily for UpperT {
    fn id(&self) -> &'static str {
        "upper-t"
    }

    fn name(&self) -> &'static str {
        "upper limit by t"
    }

    fn source(&self) -> &'static str {
        SOURCE
    }

    fn has_both_ends(&self) -> bool {
        false
    }

    fn at_least(&self) -> bool {
        true
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        limits(planes, Tails { below: None, above: Some(level.alpha()) })
    }
}
