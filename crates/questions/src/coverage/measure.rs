//! How often Student's interval around the noisy mean contains the truth.

use noisefloor_stats::{self as stats, CoverageTally, Groups, Level, Observed, ShapeError};
use noisefloor_study::BASELINE;
use noisefloor_study::record::{CoverageCount, Record};

use crate::cell::{Cell, Measure, MeasureError};

/// Of the baseline only, whose output is the noisy mean.
pub(super) fn measure(cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    if cell.method == BASELINE {
        record.coverage = cell.measure.coverage(&cell.study.coverage)?;
    }
    Ok(())
}

impl Measure<'_> {
    /// Coverage of the t-intervals of the input mean, per level and class; empty where intervals are void or unknown.
    ///
    /// # Errors
    /// If frame and truth differ in size.
    pub fn coverage(&self, confidences: &[f64]) -> Result<Vec<CoverageCount>, ShapeError> {
        let Some(observed) = self.intervals() else { return Ok(Vec::new()) };
        let mut out = Vec::new();
        // Confidences were checked with the study.
        for level in confidences.iter().filter_map(|&c| Level::two_sided(c).ok()) {
            let Some(planes) = self.intervals_at(&observed, level)? else { continue };
            let count = |observed: &Observed<'_>, groups: Groups<'_>| {
                stats::coverage_of(&planes, observed, &self.truth, level, Some(groups))
            };
            let tallies = count(&observed, self.groups())?;
            for (index, (class, tally)) in
                self.names().zip(tallies).enumerate().filter(|(_, (_, t))| t.all() > 0)
            {
                let within_se =
                    self.within(index, count, |t: &CoverageTally| (t.covered + t.constant, t.all()));
                out.push(CoverageCount { within_se, ..counted(level, class, &tally) });
            }
        }
        Ok(out)
    }
}

/// A tally in the form of a record, without an error within the image.
pub(crate) fn counted(level: Level, class: &str, tally: &CoverageTally) -> CoverageCount {
    CoverageCount {
        confidence: level.confidence(),
        class: class.to_owned(),
        total: tally.total,
        covered: tally.covered,
        covered_uncorrected: tally.covered_uncorrected,
        truth_above: tally.truth_above,
        truth_below: tally.truth_below,
        constant: tally.constant,
        missed: tally.missed,
        within_se: None,
    }
}
