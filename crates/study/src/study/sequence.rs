//! Scenes that are frames of one sequence.

use std::collections::BTreeSet;

use crate::error::StudyError;
use crate::study::check::Lines;
use crate::study::{SceneSpec, Study};

/// Fewest frames whose variance over time says anything.
const LEAST_FRAMES: usize = 3;

impl Study {
    /// Sequences in the order of their first scenes: name, and scenes by frame.
    #[must_use]
    pub fn sequences(&self) -> Vec<(&str, Vec<&SceneSpec>)> {
        let mut out: Vec<(&str, Vec<&SceneSpec>)> = Vec::new();
        for scene in &self.scenes {
            let Some(name) = &scene.sequence else { continue };
            match out.iter_mut().find(|(known, _)| known == name) {
                Some((_, frames)) => frames.push(scene),
                None => out.push((name, vec![scene])),
            }
        }
        for (_, frames) in &mut out {
            frames.sort_by_key(|scene| scene.shot.frame);
        }
        out
    }
}

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
