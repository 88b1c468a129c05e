//! Families of intervals that a study asks for.

use noisefloor_frame::Statistic;
use noisefloor_stats::{FAMILIES, IntervalFamily, IntervalNeed, family};

use crate::error::StudyError;
use crate::study::lines::{Lines, quoted};
use crate::study::model::Study;

impl Study {
    /// The families that are measured beside Student's t; names without a meaning, which [`Study::check`] refuses, are
    /// left out.
    #[must_use]
    pub fn interval_families(&self) -> Vec<&'static dyn IntervalFamily> {
        self.intervals.iter().filter_map(|id| family(id)).collect()
    }
}

pub(super) fn check_intervals(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    let wrong = |value: String, allowed: String| {
        let (place, field) = (lines.place(lines.of_key("intervals")), "intervals".into());
        Err(StudyError::Field { place, field, value, allowed })
    };
    let recorded = study.optional_statistics();
    for (k, id) in study.intervals.iter().enumerate() {
        let known: Vec<&str> = FAMILIES.iter().map(|family| family.id()).filter(|id| *id != "t").collect();
        let Some(family) = family(id).filter(|_| known.contains(&id.as_str())) else {
            let allowed = format!("{}; t is measured always", known.join(", "));
            return wrong(quoted(id), allowed);
        };
        if study.intervals[..k].contains(id) {
            return wrong(quoted(id), "each family once".into());
        }
        let mut needed = family.needs().iter().flat_map(|need| statistics(*need));
        if let Some(statistic) = needed.find(|statistic| !recorded.contains(statistic)) {
            let allowed = format!("with `statistics = [\"{statistic}\", …]`, which it is made of");
            return wrong(quoted(id), allowed);
        }
    }
    Ok(())
}

/// What frames must have for a need.
fn statistics(need: IntervalNeed) -> &'static [Statistic] {
    match need {
        IntervalNeed::ThirdMoment => &[Statistic::ThirdMoment],
        IntervalNeed::Extremes => &[Statistic::Least, Statistic::Greatest],
        IntervalNeed::Neighbours => &[],
    }
}
