//! Optional statistics that a study asks for.

use noisefloor_frame::{Sampling, Statistic};

use crate::error::StudyError;
use crate::study::lines::{Lines, quoted};
use crate::study::model::Study;

impl Study {
    /// The optional statistics that rendered and drawn frames get; those without a meaning, which [`Study::check`] refuses, are left
    /// out.
    #[must_use]
    pub fn optional_statistics(&self) -> Vec<Statistic> {
        self.statistics.iter().filter_map(|name| name.parse().ok()).collect()
    }
}

pub(super) fn check_statistics(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    let wrong = |value: String, allowed: String| {
        let (place, field) = (lines.place(lines.of_key("statistics")), "statistics".into());
        Err(StudyError::Field { place, field, value, allowed })
    };
    let mut seen = Vec::new();
    for name in &study.statistics {
        let statistic: Statistic = match name.parse() {
            Ok(found) => found,
            Err(error) => return wrong(quoted(name), error.to_string()),
        };
        if seen.contains(&statistic) {
            return wrong(quoted(name), "each statistic once".into());
        }
        if statistic == Statistic::FourParts && study.sampling != Sampling::Independent {
            return wrong(
                quoted(name),
                "independent sampling, for parts that are independent of each other".into(),
            );
        }
        let levels = study.spp.iter().chain(study.scenes.iter().flat_map(|scene| scene.spp.iter().flatten()));
        let least = statistic.row().least;
        if let Some(spp) = levels.copied().find(|spp| *spp < least) {
            return wrong(quoted(name), format!("at least {least} samples at every level; one has {spp}"));
        }
        seen.push(statistic);
    }
    Ok(())
}
