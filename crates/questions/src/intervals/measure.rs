//! Coverage and width of every family that the study asks for.

use noisefloor_stats::{IntervalFamily, IntervalPlanes, Level, Observed, coverage_of, students_t};
use noisefloor_study::BASELINE;
use noisefloor_study::record::{CoverageCount, Record};
use serde::{Deserialize, Serialize};

use crate::answers;
use crate::cell::{Cell, Measure, MeasureError};
use crate::coverage::counted;

/// Name of its answers on disk.
pub(super) const ID: &str = "intervals";

/// What one family gave on one frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct OfFamily {
    /// Its id.
    pub(super) family: String,
    /// Per confidence and class, as for Student's t.
    pub(super) counts: Vec<CoverageCount>,
    /// Confidence, and the sum of its widths over that of Student's t where both are finite and that is not 0; absent
    /// for one-sided limits.
    pub(super) widths: Vec<(f64, Option<f64>)>,
}

/// Of the baseline only, whose output is the noisy mean.
pub(super) fn measure(cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    if cell.method != BASELINE || cell.study.intervals.is_empty() {
        return Ok(());
    }
    let Some(observed) = cell.measure.intervals() else { return Ok(()) };
    let mut out = Vec::new();
    for family in cell.study.interval_families() {
        out.extend(of_family(cell.measure, family, &observed, &cell.study.coverage)?);
    }
    if !out.is_empty() {
        answers::keep(&mut record.answers, ID, &out);
    }
    Ok(())
}

/// Nothing where the frame lacks what the family needs.
pub(crate) fn of_family(
    measure: &Measure<'_>,
    family: &dyn IntervalFamily,
    observed: &Observed<'_>,
    confidences: &[f64],
) -> Result<Option<OfFamily>, MeasureError> {
    let mut out = OfFamily { family: family.id().into(), counts: Vec::new(), widths: Vec::new() };
    for level in confidences.iter().filter_map(|&c| Level::two_sided(c).ok()) {
        let planes = measure.planes(*observed);
        let Some(intervals) = family.intervals(&planes, level)? else { return Ok(None) };
        let tallies = coverage_of(&intervals, observed, &measure.truth, level, Some(measure.groups()))?;
        for (class, tally) in measure.names().zip(tallies).filter(|(_, tally)| tally.all() > 0) {
            out.counts.push(counted(level, class, &tally));
        }
        let t = students_t().intervals(&planes, level)?;
        out.widths.push((level.confidence(), t.and_then(|t| relative_width(&intervals, &t))));
    }
    Ok(Some(out))
}

fn relative_width(own: &IntervalPlanes, t: &IntervalPlanes) -> Option<f64> {
    let width = |planes: &IntervalPlanes, i: usize| planes.high[i] - planes.low[i];
    let (mut sum, mut of_t) = (0.0, 0.0);
    for i in 0..own.low.len().min(t.low.len()) {
        let (a, b) = (width(own, i), width(t, i));
        if b.is_finite() {
            sum += a;
            of_t += b;
        }
    }
    (of_t > 0.0 && sum.is_finite()).then(|| sum / of_t)
}
