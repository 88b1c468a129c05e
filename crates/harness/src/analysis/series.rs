//! Values of a metric over replicates and levels, in the form that comparisons and fits take.

use noisefloor_stats::Levels;

use crate::analysis::index::Index;
use crate::analysis::number::{mean, value};
use crate::context::SceneContext;
use crate::record::Record;

/// Values of a metric, at the index of their replicate.
pub(super) fn by_replicate(records: &[&Record], class: Option<&str>, metric: &str) -> Vec<Option<f64>> {
    let count = records.iter().map(|r| r.replicate as usize + 1).max().unwrap_or(0);
    let mut out = vec![None; count];
    for record in records {
        out[record.replicate as usize] = value(record, class, metric);
    }
    out
}

/// Standard error that the reference contributes to every replicate; 0 where none is stated.
pub(super) fn reference_se(records: &[&Record], metric: &str) -> f64 {
    mean(records.iter().filter_map(|r| r.metrics_reference_se.get(metric).copied())).unwrap_or(0.0)
}

/// Errors of a row over all levels of a scene.
pub(super) fn series(index: &Index<'_>, scene: &SceneContext, label: &str, metric: &str) -> Levels {
    let mut levels = Levels::new();
    for &spp in scene.replicates.keys() {
        let records = index.records(scene, spp, label);
        levels.push(f64::from(spp), &by_replicate(records, None, metric), reference_se(records, metric));
    }
    levels
}
