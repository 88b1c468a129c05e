use noisefloor_study::exhibit::{GalleryLevel, GalleryRow, GalleryScene};
use noisefloor_study::format;
use noisefloor_study::summary::{MethodSummary, SceneSummary};

use crate::view::View;

/// The images that the page can show, of the levels that the study chose for it; scenes without any are absent.
pub(super) fn gallery(view: &View<'_>) -> Vec<GalleryScene> {
    let study = &view.summary.study;
    let mut levels = if study.viewer_spp.is_empty() { study.spp.clone() } else { study.viewer_spp.clone() };
    levels.sort_unstable();
    levels.dedup();
    let of_scene = |scene: &SceneSummary| GalleryScene {
        id: scene.id.clone(),
        title: scene.title.clone(),
        // A reference that is not what was written has no path.
        reference: scene.reference_image.clone(),
        levels: levels.iter().filter_map(|&spp| level(view, scene, spp)).collect(),
    };
    let shows = |scene: &GalleryScene| !scene.reference.is_empty() || !scene.levels.is_empty();
    view.summary.scenes.iter().map(of_scene).filter(shows).collect()
}

fn level(view: &View<'_>, scene: &SceneSummary, spp: u32) -> Option<GalleryLevel> {
    let rows: Vec<GalleryRow> =
        view.summary.methods.iter().filter_map(|method| row(view, scene, spp, method)).collect();
    (!rows.is_empty()).then_some(GalleryLevel { spp, rows })
}

/// A row that has an image or diagnostics here.
fn row(view: &View<'_>, scene: &SceneSummary, spp: u32, method: &MethodSummary) -> Option<GalleryRow> {
    let label = &method.label;
    let image = scene.images.get(label).and_then(|by_spp| by_spp.get(&spp));
    let diagnostics = scene.diagnostics.get(label).and_then(|by_spp| by_spp.get(&spp));
    if image.is_none() && diagnostics.is_none() {
        return None;
    }
    let interval = view.cell(&scene.id, spp, label).and_then(|cell| cell.metrics.get(view.primary().0));
    Some(GalleryRow {
        label: label.clone(),
        image: image.cloned().unwrap_or_default(),
        value: interval.map(|i| format::interval(i).value).unwrap_or_default(),
        diagnostics: diagnostics
            .into_iter()
            .flatten()
            .map(|(name, path)| (name.clone(), path.clone()))
            .collect(),
    })
}
