//! Rows that got as much time as another.

use noisefloor_harness::summary::Summary;
use serde::Serialize;

use crate::format;

/// One row at one level of one scene.
#[derive(Debug, Serialize)]
pub(crate) struct EqualTimeRow {
    pub scene: String,
    pub spp: u32,
    pub label: String,
    pub with: String,
    pub used: u32,
    pub implied: String,
    pub denoise: String,
    pub per_sample: String,
}

/// In the order of the summary.
pub(crate) fn equal_time(summary: &Summary) -> Vec<EqualTimeRow> {
    let milliseconds = |seconds: f64| format!("{} ms", format::significant(1000.0 * seconds, 3));
    summary
        .equal_time
        .iter()
        .map(|e| EqualTimeRow {
            scene: e.scene.clone(),
            spp: e.spp,
            label: e.label.clone(),
            with: e.with.clone(),
            used: e.used,
            implied: e.implied.map_or_else(|| "–".into(), |n| format::significant(n, 3)),
            denoise: milliseconds(e.denoise_seconds),
            per_sample: e.seconds_per_sample.map_or_else(|| "–".into(), milliseconds),
        })
        .collect()
}
