//! Values of a metric over replicates and levels, in the form that comparisons and fits take.

use noisefloor_stats::{self as stats, Levels, ReferenceShare, paired_ratio};

use crate::records::index::Index;
use crate::records::{LEVEL, told, value};
use noisefloor_study::context::SceneContext;
use noisefloor_study::record::Record;
use noisefloor_study::summary::{Interval, Source};

/// Values of a metric, at the index of their replicate.
pub(crate) fn by_replicate(records: &[&Record], class: Option<&str>, metric: &str) -> Vec<Option<f64>> {
    let count = records.iter().map(|r| r.replicate as usize + 1).max().unwrap_or(0);
    let mut out = vec![None; count];
    for record in records {
        out[record.replicate as usize] = value(record, class, metric);
    }
    out
}

/// What the reference contributes to the mean over replicates; nothing where none is stated.
pub(crate) fn reference_share(records: &[&Record], class: Option<&str>, metric: &str) -> ReferenceShare {
    let shares: Vec<ReferenceShare> =
        records.iter().filter_map(|record| share(record, class, metric)).collect();
    ReferenceShare::mean(&shares).unwrap_or_default()
}

fn share(record: &Record, class: Option<&str>, metric: &str) -> Option<ReferenceShare> {
    // The root moves with the squared error.
    let (source, factor) = match metric {
        "rmse" => ("mse", 0.5 / value(record, class, metric)?),
        _ => (metric, 1.0),
    };
    let influence = record.contribution(class, source).filter(|found| !found.parts.is_empty());
    let stated = record.metrics_reference_se.get(metric).copied().filter(|_| class.is_none());
    let derived = || influence.and_then(|found| found.variance()).map(|v| v.sqrt() * factor);
    let standard_error = stated.or_else(derived).filter(|se| se.is_finite())?;
    let parts = influence.filter(|_| factor.is_finite());
    Some(ReferenceShare {
        standard_error,
        parts: parts.map_or(Vec::new(), |found| found.parts.iter().map(|l| l * factor).collect()),
        product: parts.map_or(0.0, |found| found.product * factor),
    })
}

/// Errors of a row over all levels of a scene where it can be ranked.
pub(crate) fn series(index: &Index<'_>, scene: &SceneContext, label: &str, metric: &str) -> Levels {
    let mut levels = Levels::new();
    for &spp in scene.replicates.keys() {
        // Means over other frames or fewer pixels than at the other levels.
        if index.left_out(scene, spp, label).is_some() {
            continue;
        }
        let records = index.records(scene, spp, label);
        let share = reference_share(records, None, metric);
        levels.push(f64::from(spp), &by_replicate(records, None, metric), share);
    }
    levels
}

/// Ratio of a row's errors to another row's on the same frames; `within` is the standard error of its logarithm within
/// one image, for where there is no second replicate. `None` where no replicate has both or a corrected error is not
/// positive.
pub(crate) fn error_ratio(
    own: &[&Record],
    other: &[&Record],
    class: Option<&str>,
    metric: &str,
    within: Option<f64>,
) -> Option<Interval> {
    let common = [own, other].map(|records| reference_share(records, class, metric));
    let (a, b) = (by_replicate(own, class, metric), by_replicate(other, class, metric));
    let effect = paired_ratio(&a, &b, [&common[0], &common[1]], LEVEL)?;
    match within {
        Some(se) if effect.interval.low.is_none() => {
            let log = stats::Interval::symmetric(effect.interval.value.ln(), se, LEVEL, None, 1);
            Some(told(log.exp(), Source::WithinImage, None))
        }
        _ => Some(told(effect.interval, Source::Replicates, None)),
    }
}
