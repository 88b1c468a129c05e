//! Methods' estimates of their own error as tables.

use noisefloor_harness::summary::{EstimateSummary, SceneSummary};
use serde::Serialize;

use super::table::Texts;
use crate::format;
use crate::index::Index;

/// Estimated and measured errors on one scene.
#[derive(Debug, Serialize)]
pub(crate) struct EstimatesView {
    pub title: String,
    pub rows: Vec<EstimateRow>,
    pub classes: Vec<EstimateRow>,
}

/// One row of the study at one level.
#[derive(Debug, Serialize)]
pub(crate) struct EstimateRow {
    pub spp: u32,
    pub label: String,
    pub swatch: usize,
    pub class: String,
    pub estimated: Texts,
    pub measured: Texts,
    /// Ratio, or difference where `is_ratio` is false.
    pub effect: Texts,
    pub is_ratio: bool,
    pub verdict: String,
    /// Class of the verdict's tag.
    pub tone: &'static str,
    /// Which image it is about if not the output; values without an estimate, if any.
    pub note: String,
}

/// Tables of a scene; nothing if no row estimates its own error there.
pub(crate) fn estimates(index: &Index<'_>, scene: &SceneSummary) -> Option<EstimatesView> {
    let here = || index.summary.estimates.iter().filter(|e| e.scene == scene.id);
    let (all, classes): (Vec<_>, Vec<_>) = here().partition(|e| e.class == "all");
    let rows = |list: Vec<&EstimateSummary>| list.into_iter().map(|e| row(index, e)).collect();
    (!all.is_empty()).then(|| EstimatesView {
        title: scene.title.clone(),
        rows: rows(all),
        classes: rows(classes),
    })
}

fn row(index: &Index<'_>, e: &EstimateSummary) -> EstimateRow {
    EstimateRow {
        spp: e.spp,
        label: e.label.clone(),
        swatch: index.summary.methods.iter().position(|m| m.label == e.label).unwrap_or(0),
        class: e.class.clone(),
        estimated: format::interval(&e.estimated).into(),
        measured: format::interval(&e.measured).into(),
        effect: format::interval(&e.effect).into(),
        is_ratio: e.is_ratio,
        verdict: e.verdict.clone(),
        tone: match e.verdict.as_str() {
            "calibrated" => "consistent",
            "too optimistic" => "plateaus",
            _ => "undecided",
        },
        note: note(e),
    }
}

/// Which image it is about, and what is left out.
fn note(e: &EstimateSummary) -> String {
    let about = e.of.as_ref().map(|of| format!("both of the {of}, not of the output"));
    let left_out = (e.non_finite > 0).then(|| {
        let values = format::plural(e.non_finite as usize, "value");
        format!("{values} without a finite estimate are left out")
    });
    [about, left_out].into_iter().flatten().collect::<Vec<_>>().join("; ")
}
