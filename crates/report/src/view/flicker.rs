//! Errors that change from frame to frame.

use noisefloor_harness::summary::FlickerSummary;
use serde::Serialize;

use super::table::Texts;
use crate::format;
use crate::index::Index;

/// Flicker over one sequence.
#[derive(Debug, Serialize)]
pub(crate) struct FlickerView {
    pub sequence: String,
    pub frames: usize,
    pub rows: Vec<FlickerRow>,
    /// What was subtracted for the noise of the references.
    pub note: String,
}

/// One row of the study at one level.
#[derive(Debug, Serialize)]
pub(crate) struct FlickerRow {
    pub spp: u32,
    pub label: String,
    pub swatch: usize,
    pub variance: Texts,
    pub ratio: Texts,
    pub first: String,
    pub squared: Texts,
}

/// One table per sequence, in the order of the summary.
pub(crate) fn flicker(index: &Index<'_>) -> Vec<FlickerView> {
    let mut out: Vec<FlickerView> = Vec::new();
    for f in &index.summary.flicker {
        let row = row(index, f);
        match out.iter_mut().find(|view| view.sequence == f.sequence) {
            Some(view) => view.rows.push(row),
            None => out.push(FlickerView {
                sequence: f.sequence.clone(),
                frames: f.scenes.len(),
                rows: vec![row],
                note: match f.reference_variance {
                    Some(0.0) => "The truth is exact: nothing was subtracted.".into(),
                    Some(variance) => format!(
                        "{} was subtracted: the references' own noise, the mean of their variances.",
                        format::significant(variance, 2)
                    ),
                    None => "A reference states no variance: its own noise was not subtracted and counts as flicker.".into(),
                },
            }),
        }
    }
    out
}

fn row(index: &Index<'_>, f: &FlickerSummary) -> FlickerRow {
    let missing = if f.first == f.label { "1" } else { "–" };
    let absent = || Texts { value: missing.into(), spread: String::new() };
    FlickerRow {
        spp: f.spp,
        label: f.label.clone(),
        swatch: index.summary.methods.iter().position(|m| m.label == f.label).unwrap_or(0),
        variance: format::interval(&f.variance).into(),
        ratio: f.ratio_to_first.as_ref().map_or_else(absent, |ratio| format::interval(ratio).into()),
        first: f.first.clone(),
        squared: format::interval(&f.squared_error).into(),
    }
}
