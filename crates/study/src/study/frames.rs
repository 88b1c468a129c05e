//! Which frames a row gets: the study's, or frames of its own.

use serde::{Deserialize, Serialize};

use crate::error::StudyError;
use crate::study::check::Lines;
use crate::study::{SceneSource, Study};

/// Which noisy frames a row denoises.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RowFrames {
    /// The study's own: the same number of samples in every pixel, shared by all such rows.
    #[default]
    Uniform,
    /// As many samples, placed in rounds where the row's own method asks for them.
    Adaptive(AdaptiveFrames),
    /// The same number in every pixel, as many as another row's time buys: [`crate::SceneSpec::equal_time_spp`].
    EqualTime {
        /// Label of the other row.
        with: String,
    },
}

/// How adaptive frames are rendered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AdaptiveFrames {
    /// Rounds in all. The first is uniform, the others have equal budgets; together they have the level's samples per
    /// pixel on average, exactly.
    pub rounds: u32,
    /// Samples per pixel of the first round, at least 2; a `rounds`-th of the level if absent.
    pub first: Option<u32>,
    /// Most samples that a pixel gets in one round, over the round's average.
    pub most: u32,
}

impl Default for AdaptiveFrames {
    fn default() -> Self {
        Self { rounds: 4, first: None, most: 16 }
    }
}

impl AdaptiveFrames {
    /// Samples per pixel of the first round at level `spp`.
    pub fn first(&self, spp: u32) -> u32 {
        self.first.unwrap_or(spp / self.rounds).max(2).min(spp)
    }

    /// Samples of each round after the first, for `pixels` pixels at level `spp`.
    pub fn budgets(&self, spp: u32, pixels: u64) -> Vec<u64> {
        let rest = u64::from(spp - self.first(spp)) * pixels;
        let rounds = u64::from(self.rounds - 1);
        (0..rounds).map(|i| rest * (i + 1) / rounds - rest * i / rounds).collect()
    }
}

/// Refuses rows whose frames cannot be made.
pub(super) fn check_frames(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    for (index, row) in study.methods.iter().enumerate() {
        let wrong = |line: Option<usize>, field: String, value: String, allowed: String| {
            Err(StudyError::Field { place: lines.place(line), field, value, allowed })
        };
        let of_row = |name: &str| format!("method[{index}].{name}");
        let own = match &row.frames {
            RowFrames::Uniform => continue,
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

#[cfg(test)]
mod tests {
    use super::AdaptiveFrames;

    #[test]
    fn rounds_of_adaptive_frames_add_up_to_the_level_exactly() {
        for (rounds, first, spp) in
            [(4, None, 16), (4, None, 7), (3, Some(4), 4), (5, Some(2), 33), (2, None, 2)]
        {
            let frames = AdaptiveFrames { rounds, first, most: 16 };
            let budgets = frames.budgets(spp, 101);
            assert_eq!(budgets.len() as u32, rounds - 1);
            assert_eq!(
                budgets.iter().sum::<u64>() + u64::from(frames.first(spp)) * 101,
                u64::from(spp) * 101
            );
            let (least, most) = (budgets.iter().min(), budgets.iter().max());
            assert!(most.unwrap() - least.unwrap() <= 1);
        }
    }
}
