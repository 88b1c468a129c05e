use std::path::Path;

use crate::error::{Place, StudyError};
use crate::study::limits::LONGEST_NAME;
use crate::study::{MethodRow, Replicates, SceneSource, SceneSpec, Shot, Study};

impl Study {
    /// A small study of one scene, built-in or from a glTF file: 4, 16 and 64 samples per pixel, 4 replicates, 160×120.
    /// The rows are the caller's, because the harness names no method.
    ///
    /// # Errors
    /// [`StudyError::Scene`] if `name` is neither a file nor a built-in scene, [`StudyError::Field`] for rows of
    /// equal label.
    pub fn for_scene(name: &str, shot: Shot, rows: Vec<MethodRow>) -> Result<Self, StudyError> {
        let path = Path::new(name);
        let (id, source, about) = if path.is_file() {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let named = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' };
            let id: String = stem.chars().take(LONGEST_NAME - 40).map(named).collect();
            (id, SceneSource::Gltf(path.to_owned()), "a scene from a file".to_owned())
        } else {
            let entry = noisefloor_scenes::find(name).map_err(|source| StudyError::Scene {
                place: Place { file: "command line".into(), line: None },
                source,
            })?;
            (entry.id.to_owned(), SceneSource::Builtin(entry.id.into()), entry.about.to_owned())
        };
        let scenes = vec![SceneSpec {
            id: id.clone(),
            source,
            spp: None,
            replicates: None,
            shot,
            sequence: None,
            set: serde_json::Map::new(),
            equal_time_spp: None,
        }];
        let study = Self {
            title: format!("Scene {id}"),
            question: format!(
                "On this scene ({about}): which denoiser has the lowest error at which cost, and do the confidence intervals \
                 and error bounds hold?"
            ),
            replicates: Replicates::uniform(4),
            ..Self::plain(format!("scene-{id}"), vec![4, 16, 64], scenes, rows)
        };
        study.check(name)?;
        Ok(study)
    }
}
