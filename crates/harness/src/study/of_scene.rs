use std::path::Path;

use noisefloor_frame::{PixelFilter, Reference, Sampling};
use noisefloor_render::FeatureHit;

use crate::error::{HarnessError, Place};
use crate::study::check::{Lines, check};
use crate::study::{
    Family, MethodRow, ReferenceSpec, Replicates, SceneSource, SceneSpec, Shot, Study, Timing,
};

impl Study {
    /// A small study of one scene, built-in or from a glTF file: 4, 16 and 64 samples per pixel, 4 replicates, 160×120. The
    /// rows are the caller's, because the harness names no method.
    ///
    /// # Errors
    /// [`HarnessError::Scene`] if `name` is neither a file nor a built-in scene, [`HarnessError::Field`] for rows of equal
    /// label.
    pub fn for_scene(name: &str, shot: Shot, rows: Vec<MethodRow>) -> Result<Self, HarnessError> {
        let path = Path::new(name);
        let (id, source, about) = if path.is_file() {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let named = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' };
            let id: String = stem.chars().map(named).collect();
            (id, SceneSource::Gltf(path.to_owned()), "a scene from a file".to_owned())
        } else {
            let entry = noisefloor_scenes::find(name).map_err(|source| HarnessError::Scene {
                place: Place { file: "command line".into(), line: None },
                source,
            })?;
            (entry.id.to_owned(), SceneSource::Builtin(entry.id.into()), entry.about.to_owned())
        };
        let metrics = crate::metric::ids();
        let study = Self {
            name: format!("scene-{id}"),
            title: format!("Scene {id}"),
            question: format!(
                "On this scene ({about}): which denoiser has the lowest error at which cost, and do the confidence intervals \
                 and error bounds hold?"
            ),
            analysis: Vec::new(),
            reproduces: None,
            spp: vec![4, 16, 64],
            replicates: Replicates::uniform(4),
            width: 160,
            height: 120,
            depth: 8,
            filter: PixelFilter::Box,
            feature_hit: FeatureHit::First,
            seed: 0,
            sampling: Sampling::Independent,
            reference: ReferenceSpec {
                spp: 1024,
                parts: Reference::LEAST_PARTS as u32,
                sampling: Sampling::LowDiscrepancy,
            },
            scenes: vec![SceneSpec { id, source, spp: None, replicates: None, shot }],
            methods: rows,
            primary_metric: crate::metric::primary(&metrics),
            metrics,
            coverage: vec![0.95, 0.99, 0.998],
            timing: Timing::default(),
            comparison: Family::AllPairs,
            viewer_spp: Vec::new(),
            probe: None,
            figures: Vec::new(),
        };
        check(&study, &Lines { file: name.to_owned(), ..Lines::default() })?;
        Ok(study)
    }
}
