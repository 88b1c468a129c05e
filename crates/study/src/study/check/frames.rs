//! Rows with frames of their own.

use crate::error::StudyError;
use crate::study::frames::{AdaptiveFrames, RowFrames};
use crate::study::lines::Lines;
use crate::study::model::{SceneSource, SceneSpec, Study};

/// Refuses rows whose frames cannot be made.
pub(super) fn check_frames(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    for (index, row) in study.methods.iter().enumerate() {
        let wrong = |line: Option<usize>, field: String, value: String, allowed: String| {
            Err(StudyError::Field { place: lines.place(line), field, value, allowed })
        };
        let of_row = |name: &str| format!("method[{index}].{name}");
        let own = match &row.frames {
            RowFrames::Uniform => continue,
            RowFrames::KnownVariance => {
                let rendered = |scene: &&SceneSpec| !matches!(scene.source, SceneSource::Synthetic(_));
                if let Some(scene) = study.scenes.iter().find(rendered) {
                    let allowed = "synthetic scenes: nobody knows the variance of others";
                    return wrong(
                        row.line,
                        of_row("variance"),
                        format!("on scene `{}`", scene.id),
                        allowed.into(),
                    );
                }
                continue;
            }
            RowFrames::Adaptive(adaptive) => {
                if !(2..=64).contains(&adaptive.rounds) {
                    let allowed = "2 to 64 rounds, the first of which is uniform".into();
                    return wrong(row.line, of_row("adaptive.rounds"), adaptive.rounds.to_string(), allowed);
                }
                if !(2..=4096).contains(&adaptive.most) {
                    return wrong(
                        row.line,
                        of_row("adaptive.most"),
                        adaptive.most.to_string(),
                        "2 to 4096".into(),
                    );
                }
                if let Some(first) = adaptive.first.filter(|first| *first < 2) {
                    let allowed = "at least 2, for a variance in every pixel".into();
                    return wrong(row.line, of_row("adaptive.first"), first.to_string(), allowed);
                }
                "adaptive"
            }
            RowFrames::EqualTime { with } => {
                let others = study.methods.iter().filter(|other| other.label != row.label);
                let others: Vec<&str> = others.map(|other| other.label.as_str()).collect();
                if !others.contains(&with.as_str()) {
                    let allowed = format!("the label of another row: {}", others.join(", "));
                    return wrong(row.line, of_row("equal_time"), format!("`{with}`"), allowed);
                }
                "equal_time"
            }
        };
        for (k, scene) in study.scenes.iter().enumerate() {
            let line = lines.scenes.get(k).copied();
            if !matches!(scene.source, SceneSource::Builtin(_) | SceneSource::Gltf(_)) {
                let allowed = "scenes that are rendered: the row has frames of its own";
                return wrong(row.line, of_row(own), format!("on scene `{}`", scene.id), allowed.into());
            }
            if let RowFrames::Adaptive(AdaptiveFrames { first: Some(first), .. }) = row.frames
                && let Some(low) = study.levels(scene).iter().find(|spp| **spp <= first)
            {
                let allowed =
                    format!("less than the level {low} of scene `{}`, for there to be more rounds", scene.id);
                return wrong(row.line, of_row("adaptive.first"), first.to_string(), allowed);
            }
            if own == "equal_time" && scene.equal_time_spp.is_none() {
                let field = format!("scene[{k}].equal_time_spp");
                let allowed = format!("samples per pixel for the row `{}`", row.label);
                return wrong(line, field, format!("absent for `{}`", scene.id), allowed);
            }
        }
    }
    for (k, scene) in study.scenes.iter().enumerate() {
        if let Some(spp) = scene.equal_time_spp.filter(|spp| !(1..=1 << 20).contains(spp)) {
            return Err(StudyError::Field {
                place: lines.place(lines.scenes.get(k).copied()),
                field: format!("scene[{k}].equal_time_spp"),
                value: spp.to_string(),
                allowed: "1 to 1048576".into(),
            });
        }
    }
    Ok(())
}
