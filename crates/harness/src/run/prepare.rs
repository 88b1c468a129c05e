//! Reference and pixel classes of a scene, kept in the study's folder so that an analysis needs nothing else.

use std::collections::BTreeMap;

use noisefloor_frame::{Reference, SquaredError};
use noisefloor_metrics::{Classes, Measurer};

use crate::cache::Cache;
use crate::context::{ReferenceContext, SceneContext};
use crate::error::HarnessError;
use crate::observer::Observer;
use crate::source::{PixelClasses, Scene};
use crate::store::{Layout, read_json, write_json};

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

/// The scene's description from an earlier run, if its reference is still the right one and in place.
pub(super) fn kept_context(layout: &Layout, scene: &Scene) -> Option<SceneContext> {
    let root = layout.root();
    let kept: SceneContext = read_json(&root.join(Layout::scene(&scene.id))).ok()?;
    let files = [Layout::reference(&scene.id), Layout::classes(&scene.id)];
    let whole =
        kept.reference.key == scene.reference_key && files.iter().all(|file| root.join(file).exists());
    whole.then(|| SceneContext { replicates: scene.replicates(), settings: scene.settings.clone(), ..kept })
}

/// Renders or reads the reference, and writes all that describes the scene.
pub(super) fn truth(
    scene: &Scene,
    cache: &Cache,
    layout: &Layout,
    observer: &dyn Observer,
) -> Result<(Truth, SceneContext), HarnessError> {
    let mut reference = scene.reference(cache, observer)?;
    let classes = scene.classes(&reference)?;
    let truth = Truth { classes, reference: reference.clone() };
    let measurer = truth.measurer(scene)?;
    let mut counts = BTreeMap::new();
    for &class in &truth.classes.of_pixel {
        *counts.entry(usize::from(class)).or_insert(0u64) += 1;
    }
    let named = truth.classes.names.iter().enumerate();
    let context = SceneContext {
        id: scene.id.clone(),
        title: scene.title.clone(),
        about: scene.about.clone(),
        width: scene.width,
        height: scene.height,
        sampling: scene.sampling,
        settings: scene.settings.clone(),
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
            correction: measurer.correction().into(),
            floor: measurer.floor(),
            bias: measurer.bias(),
        },
        findings: Vec::new(),
    };
    // The parts stay in the cache: mean, variance and halves are what metrics are computed from.
    reference.parts.clear();
    noisefloor_io::write_reference(layout.ready(&Layout::reference(&scene.id))?, &reference)?;
    let map = truth.classes.to_image(scene.width, scene.height);
    noisefloor_io::write_image(layout.ready(&Layout::classes(&scene.id))?, &map, &BTreeMap::new())?;
    write_json(&layout.ready(&Layout::scene(&scene.id))?, &context)?;
    drop(measurer);
    Ok((truth, context))
}
