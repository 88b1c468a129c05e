//! Numbers beyond the limits.

use noisefloor_denoiser::Guarded;

use crate::error::StudyError;
use crate::study::limits::{
    LONGEST_NAME, MOST_CELLS, MOST_CONFIDENCES, MOST_LEVELS, MOST_REPLICATES, MOST_ROWS, MOST_RUNS,
    MOST_SCENES,
};
use crate::study::lines::{Lines, quoted};
use crate::study::model::{Replicates, Study};

/// Cells of a study, as far as it knows its levels: those of folders of frames are not known yet.
fn cells(study: &Study) -> u64 {
    let of_scene = study.scenes.iter().map(|scene| {
        let replicates = study.levels(scene).iter().map(|spp| u64::from(study.replicates(scene, *spp)));
        replicates.sum::<u64>()
    });
    of_scene.sum::<u64>().saturating_mul(study.methods.len() as u64)
}

/// The first number of replicates that is out of range.
pub(super) fn bad_replicates(replicates: &Replicates) -> Option<u32> {
    let all = std::iter::once(replicates.default).chain(replicates.above.iter().map(|(_, count)| *count));
    all.into_iter().find(|n| !(1..=MOST_REPLICATES).contains(n))
}

/// What is wrong with a name, if something is.
pub(super) fn name_problem(name: &str) -> Option<String> {
    let length = name.chars().count();
    if length > LONGEST_NAME {
        return Some(format!(
            "at most {LONGEST_NAME} characters, because folders are named after it; it has {length}"
        ));
    }
    name.chars().any(char::is_control).then(|| "text without control characters".to_owned())
}

/// Refuses numbers beyond the limits.
pub(super) fn check_limits(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    let wrong = |field: &str, line: Option<usize>, value: String, allowed: String| {
        Err(StudyError::Field { place: lines.place(line), field: field.into(), value, allowed })
    };
    let at_most = |n: usize, what: &str| format!("at most {n} {what}");
    if let Some(problem) = name_problem(&study.name) {
        return wrong("name", lines.of_key("name"), quoted(&study.name), problem);
    }
    for (field, value, least) in
        [("timing.runs", study.timing.runs, 1), ("timing.warmup", study.timing.warmup, 0)]
    {
        if !(least..=MOST_RUNS).contains(&value) {
            let key = field.trim_start_matches("timing.");
            let allowed = format!("{least} to {MOST_RUNS}");
            return wrong(field, lines.of_key(key), value.to_string(), allowed);
        }
    }
    for (field, count, most, what) in [
        ("scene", study.scenes.len(), MOST_SCENES, "scenes"),
        ("method", study.methods.len(), MOST_ROWS, "rows"),
        ("spp", study.spp.len(), MOST_LEVELS, "levels"),
        ("coverage", study.coverage.len(), MOST_CONFIDENCES, "confidences"),
    ] {
        if count > most {
            return wrong(field, lines.of_key(field), format!("a list of {count}"), at_most(most, what));
        }
    }
    for (index, scene) in study.scenes.iter().enumerate() {
        let line = lines.scenes.get(index).copied();
        if let Some(problem) = name_problem(&scene.id) {
            return wrong(&format!("scene[{index}].id"), line, quoted(&scene.id), problem);
        }
        if let Some(problem) = scene.sequence.as_deref().and_then(name_problem) {
            let value = quoted(scene.sequence.as_deref().unwrap_or_default());
            return wrong(&format!("scene[{index}].sequence"), line, value, problem);
        }
        if let Some(bad) = scene.replicates.as_ref().and_then(bad_replicates) {
            let allowed = format!("1 to {MOST_REPLICATES}");
            return wrong(&format!("scene[{index}].replicates"), line, bad.to_string(), allowed);
        }
        if let Some(levels) = scene.spp.as_ref().filter(|levels| levels.len() > MOST_LEVELS) {
            let value = format!("a list of {}", levels.len());
            return wrong(&format!("scene[{index}].spp"), line, value, at_most(MOST_LEVELS, "levels"));
        }
    }
    for (index, row) in study.methods.iter().enumerate() {
        // Told before the label, which is the id if nothing else is said.
        let levels = Guarded::levels(&row.id);
        if levels > Guarded::MOST_LEVELS {
            let value = format!("{}, guarded {levels} times", quoted(&row.id));
            let allowed = format!("methods guarded at most {} times", Guarded::MOST_LEVELS);
            return wrong(&format!("method[{index}].id"), row.line, value, allowed);
        }
        if let Some(problem) = name_problem(&row.label) {
            return wrong(&format!("method[{index}].label"), row.line, quoted(&row.label), problem);
        }
    }
    let cells = cells(study);
    if cells > MOST_CELLS {
        let value = format!("{cells} cells (scenes × levels × replicates × rows)");
        return wrong("the whole study", None, value, format!("at most {MOST_CELLS} cells"));
    }
    Ok(())
}
