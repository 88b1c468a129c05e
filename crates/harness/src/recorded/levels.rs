//! What was measured over all replicates of levels: in a recording compressed, because it is long and repeats itself.

use std::path::Path;

use noisefloor_study::context::{Context, LevelContext, SceneContext};
use serde::{Deserialize, Serialize};

use super::packed;
use crate::error::HarnessError;

/// Levels of a scene.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    scene: String,
    levels: Vec<LevelContext>,
}

/// Moves the levels of all scenes to a file, which replaces what an earlier recording left there; none if there are none.
pub(super) fn take(context: &mut Context, path: &Path) -> Result<(), HarnessError> {
    let measured = context.scenes.iter_mut().filter(|scene| !scene.levels.is_empty());
    let line = |scene: &mut SceneContext| Line {
        scene: scene.id.clone(),
        levels: std::mem::take(&mut scene.levels),
    };
    let lines: Vec<Line> = measured.map(line).collect();
    if lines.is_empty() {
        // Of an earlier recording in the same place.
        return match std::fs::remove_file(path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(HarnessError::io("remove", path)(error))
            }
            _ => Ok(()),
        };
    }
    packed::write(path, &lines)
}

/// Gives the levels back; recordings of earlier programs have no such file.
pub(super) fn give(path: &Path, context: &mut Context) -> Result<(), HarnessError> {
    if !path.is_file() {
        return Ok(());
    }
    let bytes = packed::read(path)?;
    for line in serde_json::Deserializer::from_slice(&bytes).into_iter::<Line>() {
        let Line { scene, levels } = line.map_err(|e| HarnessError::kept(path, e))?;
        context.scenes.iter_mut().filter(|kept| kept.id == scene).for_each(|kept| {
            kept.levels.clone_from(&levels);
        });
    }
    Ok(())
}
