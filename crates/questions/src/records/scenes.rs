use std::collections::{BTreeMap, BTreeSet};

use crate::records::index::Index;
use crate::records::{bias, mean, median, value};
use noisefloor_study::context::SceneContext;
use noisefloor_study::files;
use noisefloor_study::record::Record;
use noisefloor_study::summary::{ReferenceSummary, SceneSummary};

/// Samples of a reference over those of a level below which the coverage correction is doubtful.
pub(crate) const LONG_ENOUGH: f64 = 16.0;

/// Samples of the reference over `spp`; infinite for exact truth, 0 if the reference's count is unknown.
pub(crate) fn reference_ratio(scene: &SceneContext, spp: u32) -> f64 {
    if scene.reference.exact { f64::INFINITY } else { scene.reference.spp as f64 / f64::from(spp.max(1)) }
}

/// A ratio for a sentence: one decimal where it has one.
pub(crate) fn times(ratio: f64) -> f64 {
    (ratio * 10.0).round() / 10.0
}

/// Scenes in the order of the study; without images where the study is a recorded one.
pub(crate) fn scenes(index: &Index<'_>) -> Vec<SceneSummary> {
    let (all, records, recorded) = (index.scenes(), index.all, index.recorded);
    let title = |scene: &SceneContext| {
        // Frames of one sequence are told apart by their ids.
        let shared = all.iter().any(|other| other.id != scene.id && other.title == scene.title);
        if shared { format!("{} · {}", scene.title, scene.id) } else { scene.title.clone() }
    };
    let without_images = |scene: SceneSummary| SceneSummary {
        images: BTreeMap::new(),
        diagnostics: BTreeMap::new(),
        reference_image: String::new(),
        ..scene
    };
    all.iter()
        .map(|scene| SceneSummary { title: title(scene), ..summary(scene, records) })
        .map(|scene| if recorded { without_images(scene) } else { scene })
        .collect()
}

fn summary(scene: &SceneContext, records: &[Record]) -> SceneSummary {
    let mine = || records.iter().filter(|record| record.scene == scene.id);
    let mut images: BTreeMap<String, BTreeMap<u32, String>> = BTreeMap::new();
    let mut diagnostics: BTreeMap<String, BTreeMap<u32, BTreeMap<String, String>>> = BTreeMap::new();
    for record in mine().filter(|record| record.replicate == 0) {
        if let Some(image) = &record.image {
            images.entry(record.label.clone()).or_default().insert(record.spp, image.clone());
        }
        if !record.diagnostics.is_empty() {
            let of_row = diagnostics.entry(record.label.clone()).or_default();
            of_row.insert(record.spp, record.diagnostics.clone());
        }
    }
    for level in &scene.levels {
        for (label, maps) in &level.maps {
            let of_row = diagnostics.entry(label.clone()).or_default();
            of_row.entry(level.spp).or_default().extend(maps.clone());
        }
    }
    let mut render_seconds = BTreeMap::new();
    for &spp in scene.replicates.keys() {
        // All rows of the study's own frames carry the same time; one per replicate is enough.
        let mut of_frame = BTreeMap::new();
        let plain = |record: &&Record| record.frame_spp.is_none() && record.adaptive.is_none();
        for record in mine().filter(plain).filter(|record| record.spp == spp) {
            if let Some(seconds) = record.seconds.render {
                of_frame.insert(record.replicate, seconds);
            }
        }
        if let Some(seconds) = median(of_frame.into_values()) {
            render_seconds.insert(spp, seconds);
        }
    }
    SceneSummary {
        id: scene.id.clone(),
        title: scene.title.clone(),
        about: scene.about.clone(),
        width: scene.width as u32,
        height: scene.height as u32,
        replicates: scene.replicates.clone(),
        settings: scene.settings.clone(),
        reference: reference(scene, &mine().collect::<Vec<_>>()),
        classes: scene.classes.iter().filter(|(_, pixels)| *pixels > 0).cloned().collect(),
        reference_image: Some(files::reference(&scene.id))
            .filter(|path| !scene.damaged.contains(path))
            .unwrap_or_default(),
        render_seconds,
        images,
        diagnostics,
    }
}

/// Metric id to the largest bias that was taken out of a mean over replicates, relative to that mean.
fn largest_bias(records: &[&Record]) -> BTreeMap<String, f64> {
    let mut cells: BTreeMap<(u32, &str), Vec<&Record>> = BTreeMap::new();
    for record in records {
        cells.entry((record.spp, &record.label)).or_default().push(record);
    }
    let ids: BTreeSet<&String> = records.iter().flat_map(|record| record.reference.keys()).collect();
    let of = |id: &str| {
        let relative = cells.values().filter_map(|cell| {
            let value = mean(cell.iter().filter_map(|record| value(record, None, id)))?;
            let bias = bias(cell, None, id)?;
            (value > 0.0).then(|| (bias / value).abs())
        });
        relative.reduce(f64::max).filter(|largest| *largest > 0.0)
    };
    ids.into_iter().filter_map(|id| Some((id.clone(), of(id)?))).collect()
}

fn reference(scene: &SceneContext, records: &[&Record]) -> ReferenceSummary {
    let top = scene.replicates.keys().copied().max().unwrap_or(1);
    let ratio = reference_ratio(scene, top);
    ReferenceSummary {
        spp: scene.reference.spp,
        exact: scene.reference.exact,
        parts: scene.reference.parts,
        sampling: scene.reference.sampling.clone(),
        correction: scene.reference.correction.clone(),
        // JSON has no infinity; an exact truth is told by its sampling.
        ratio_to_top: if ratio.is_finite() { ratio } else { 0.0 },
        long_enough: ratio >= LONG_ENOUGH,
        floor: scene.reference.floor.clone(),
        bias: largest_bias(records),
    }
}
