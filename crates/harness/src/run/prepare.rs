//! Reference and pixel classes of a scene, kept in the study's folder so that an analysis needs nothing else.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_frame::{Reference, SquaredError};
use noisefloor_metrics::{Classes, Measurer};

use crate::access::Access;
use crate::error::HarnessError;
use crate::source::Scene;
use crate::store::{Layout, damaged, hash_of, read_json, write_json};
use noisefloor_questions::PixelClasses;
use noisefloor_questions::measuring;
use noisefloor_study::context::Files;
use noisefloor_study::context::{ReferenceContext, SceneContext};
use noisefloor_study::files;

/// What cells of a scene are measured against.
pub(super) struct Truth {
    pub(super) reference: Reference,
    pub(super) classes: PixelClasses,
}

impl Truth {
    pub(super) fn measurer(&self, scene: &Scene) -> Result<Measurer<'_>, HarnessError> {
        let classes = Classes { names: &self.classes.names, of_pixel: &self.classes.of_pixel };
        Measurer::new(&self.reference, Some(classes))
            .map_err(|source| HarnessError::Metric { scene: scene.id.clone(), source })
    }
}

/// The scene's description from an earlier run, if its reference is still the right one, the measuring is that of this
/// program, and its files are what was written.
pub(super) fn kept_context(layout: &Layout, scene: &Scene) -> Option<SceneContext> {
    let kept: SceneContext = read_json(&layout.root().join(files::scene(&scene.id))).ok()?;
    // What it says of the reference is of one measuring, as the numbers of the records are.
    let right = kept.reference.key == scene.reference_key && kept.measuring == measuring();
    (right && damaged(layout.root(), &kept.files).is_empty()).then(|| SceneContext {
        replicates: scene.replicates(),
        settings: scene.settings.clone(),
        maps: scene.maps,
        ..kept
    })
}

/// The scene's kept files that should be the right ones and are not what was written.
pub(super) fn damaged_files(layout: &Layout, scene: &Scene) -> Vec<String> {
    let description = files::scene(&scene.id);
    match read_json::<SceneContext>(&layout.root().join(&description)) {
        Ok(kept) if kept.reference.key == scene.reference_key => damaged(layout.root(), &kept.files),
        Err(HarnessError::Kept { .. }) => vec![description],
        // Nothing there, or of another reference.
        _ => Vec::new(),
    }
}

/// How the reference's noise is taken out, in words.
fn correction(measurer: &Measurer<'_>) -> String {
    match measurer.bias_correction() {
        "" => measurer.correction().into(),
        bias => format!("{}; bias of relative errors by the denominator: {bias}", measurer.correction()),
    }
}

/// Renders or reads the reference, and writes all that describes the scene.
pub(super) fn truth(
    scene: &Scene,
    layout: &Layout,
    access: Access<'_>,
) -> Result<(Truth, SceneContext), HarnessError> {
    let (reference, mut findings) = scene.reference(access)?;
    findings.extend(scene.findings.iter().cloned());
    let classes = scene.classes(&reference)?;
    let truth = Truth { classes, reference: reference.clone() };
    let measurer = truth.measurer(scene)?;
    let mut counts = BTreeMap::new();
    for &class in &truth.classes.of_pixel {
        *counts.entry(usize::from(class)).or_insert(0u64) += 1;
    }
    let named = truth.classes.names.iter().enumerate();
    let mut context = SceneContext {
        id: scene.id.clone(),
        title: scene.title.clone(),
        about: scene.about.clone(),
        width: scene.width,
        height: scene.height,
        sampling: scene.sampling,
        settings: scene.settings.clone(),
        maps: scene.maps,
        replicates: scene.replicates(),
        classes: named
            .map(|(index, name)| (name.clone(), counts.get(&index).copied().unwrap_or(0)))
            .collect(),
        reference: ReferenceContext {
            key: scene.reference_key.clone(),
            spp: scene.reference_spp,
            parts: reference.parts.len() as u32,
            sampling: scene.reference_sampling.clone(),
            exact: reference.squared_error() == SquaredError::Exact,
            correction: correction(&measurer),
            floor: measurer.floor(),
        },
        measuring: measuring().to_owned(),
        files: Files::new(),
        damaged: BTreeSet::new(),
        findings,
        levels: Vec::new(),
    };
    // With its parts: metrics that are computed again are the run's own.
    let (image, map) = (files::reference(&scene.id), files::classes(&scene.id));
    noisefloor_io::write_reference(layout.ready(&image)?, &reference)?;
    let indices = truth.classes.to_image(scene.width, scene.height);
    noisefloor_io::write_image(layout.ready(&map)?, &indices, &BTreeMap::new())?;
    for file in [image, map] {
        let hash = hash_of(&layout.root().join(&file))?;
        context.files.insert(file, hash);
    }
    write_json(&layout.ready(&files::scene(&scene.id))?, &context)?;
    drop(measurer);
    Ok((truth, context))
}
