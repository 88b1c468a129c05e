//! Values of a metric over replicates and levels, in the form that comparisons and fits take.

use noisefloor_stats::{self as stats, Levels, paired_ratio};

use crate::analysis::index::Index;
use crate::analysis::number::{LEVEL, mean, told, value};
use crate::context::SceneContext;
use crate::record::Record;
use crate::summary::{Interval, Source};

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

/// Ratio of a row's errors to another row's on the same frames; `within` is the standard error of its logarithm within
/// one image, for where there is no second replicate. `None` where no replicate has both or a corrected error is not
/// positive.
pub(super) fn error_ratio(
    own: &[&Record],
    other: &[&Record],
    class: Option<&str>,
    metric: &str,
    within: Option<f64>,
) -> Option<Interval> {
    let common = match class {
        None => [reference_se(own, metric), reference_se(other, metric)],
        Some(_) => [0.0; 2],
    };
    let (a, b) = (by_replicate(own, class, metric), by_replicate(other, class, metric));
    let effect = paired_ratio(&a, &b, common, LEVEL)?;
    match within {
        Some(se) if effect.interval.low.is_none() => {
            let log = stats::Interval::symmetric(effect.interval.value.ln(), se, LEVEL, None, 1);
            Some(told(log.exp(), Source::WithinImage, None))
        }
        _ => Some(told(effect.interval, Source::Replicates, None)),
    }
}
