use super::critical::{Critical, Tails, reach};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use crate::{Level, ShapeError};

/// Share of α that a two-sided interval leaves above its upper end; the rest lies below the lower one.
///
/// Rendered samples are skewed to the right: where a t-interval misses, the truth lies above it in 85 to 100 % of cases.
/// One tenth above gives back nine tenths of the other tail, which is hardly used.
const SHARE_ABOVE: f64 = 0.1;

/// From x̄ − t(0.9·α)·s/√n to x̄ + t(0.1·α)·s/√n: the t-interval with unequal tails, exact for independent normal samples as
/// the other.
#[derive(Debug)]
pub(super) struct AsymmetricT;

impl IntervalFamily for AsymmetricT {
    fn id(&self) -> &'static str {
        "asymmetric-t"
    }

    fn name(&self) -> &'static str {
        "t with unequal tails"
    }

    fn source(&self) -> &'static str {
        "Student, The probable error of a mean, Biometrika 6(1), 1908; the split of the tails, 1 to 9, is ours"
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
        let critical = Critical::new(Tails::split(level, SHARE_ABOVE), planes.observed.counts);
        let intervals = each(planes, |seen| {
            let [below, above] = critical.at(seen.n).map(|t| reach(t, seen.standard_error));
            Some([seen.mean - below, seen.mean + above])
        })?;
        Ok(Some(intervals))
    }
}
