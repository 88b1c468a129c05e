//! Scenes that are frames of one sequence.

use std::collections::BTreeSet;

use crate::error::StudyError;
use crate::study::lines::Lines;
use crate::study::model::Study;

/// Fewest frames whose variance over time says anything.
const LEAST_FRAMES: usize = 3;

/// Refuses sequences that are too short or show a frame twice. Sizes are checked once the scenes are open.
pub(super) fn check_sequences(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    let named = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    let mut met = BTreeSet::new();
    for (index, scene) in study.scenes.iter().enumerate() {
        let Some(name) = &scene.sequence else { continue };
        let wrong = |field: &str, value: String, allowed: String| {
            Err(StudyError::Field {
                place: lines.place(lines.scenes.get(index).copied()),
                field: format!("scene[{index}].{field}"),
                value,
                allowed,
            })
        };
        if name.is_empty() || !name.chars().all(named) {
            return wrong("sequence", format!("`{name}`"), "letters, digits, `-`, `_` and `.`".into());
        }
        let frames = study.scenes.iter().filter(|other| other.sequence.as_ref() == Some(name)).count();
        if frames < LEAST_FRAMES {
            let value = format!("`{name}`, which {frames} of the scenes are of");
            return wrong("sequence", value, format!("sequences of at least {LEAST_FRAMES} scenes"));
        }
        if !met.insert((name, scene.shot.frame)) {
            let allowed = format!("frames that differ within sequence `{name}`");
            return wrong("frame", scene.shot.frame.to_string(), allowed);
        }
    }
    Ok(())
}
