//! The study that checks the instrument, run beside the study that it measures.

use noisefloor_questions::{SELF_CHECK, SELF_CHECK_SIZE, self_check_study, self_checks};
use noisefloor_study::check::CheckRecord;
use noisefloor_study::{Place, StudyError};
use serde_json::Map;

use crate::error::HarnessError;
use crate::run::request::StudyRun;
use crate::store::{Layout, Records};

/// Folder inside that of the study.
const FOLDER: &str = "instrument";

/// What the instrument finds where everything is known; `run` runs a study. Nothing for the check itself.
pub(super) fn self_check(
    request: &StudyRun<'_>,
    run: impl FnOnce(&StudyRun<'_>) -> Result<noisefloor_study::summary::Summary, HarnessError>,
) -> Result<Vec<CheckRecord>, HarnessError> {
    if request.study.name == SELF_CHECK {
        return Ok(Vec::new());
    }
    let card = |factory: &std::sync::Arc<dyn noisefloor_denoiser::Factory>| {
        let method = request.registry.build(factory.id(), &Map::new()).ok()?;
        Some(method.denoiser.card()).filter(|card| card.unbiased_estimate)
    };
    let unbiased: Vec<String> =
        request.registry.factories().iter().filter_map(card).map(|card| card.id).collect();
    // Never a run without its check: what cannot be made is an error.
    let study = self_check_study(request.study, &unbiased).map_err(|error| StudyError::Field {
        place: Place::of_study(SELF_CHECK, None),
        field: "scenes".into(),
        value: "those of the check of the instrument".into(),
        allowed: error.to_string(),
    })?;
    let out = request.out_dir.join(FOLDER);
    // Beside the records: whoever doubts a check has its frames.
    let frames = out.join("frames");
    let summary = run(&StudyRun {
        size: Some(SELF_CHECK_SIZE),
        command: request.command.clone(),
        simd: request.simd.clone(),
        laboratory: request.laboratory,
        ..StudyRun::new(&study, request.registry, &out, &frames)
    })?;
    let records = Records::read(&Layout::new(&out).records())?.records;
    Ok(self_checks(&records, &summary))
}
