//! Numbers with their uncertainty, from the values of replicates.

use noisefloor_metrics::Contribution;
use noisefloor_stats::{self as stats, Level, replicate_interval};

use crate::records::reference_share;
use noisefloor_study::record::Record;
use noisefloor_study::summary::{Interval, Source};

/// Level of every interval in a summary.
pub(crate) const LEVEL: Level = Level::TWO_SIDED_95;

/// Puts an interval into the summary's form; one without ends has no known uncertainty.
pub(crate) fn told(interval: stats::Interval, source: Source, below: Option<f64>) -> Interval {
    Interval {
        value: interval.value,
        standard_error: interval.standard_error,
        low: interval.low,
        high: interval.high,
        confidence: interval.level.confidence(),
        n: interval.n,
        source: if interval.low.is_some() { source } else { Source::None },
        below,
    }
}

/// Value of a metric in a record, over all pixels or in a class.
pub(crate) fn value(record: &Record, class: Option<&str>, metric: &str) -> Option<f64> {
    let values = match class {
        None => &record.metrics,
        Some(class) => record.classes.get(class)?,
    };
    values.get(metric).copied().flatten()
}

/// Mean of a metric over replicates; with one replicate, its interval within the image. `None` if no replicate has a
/// value.
pub(crate) fn metric(
    records: &[&Record],
    class: Option<&str>,
    metric: &str,
    floor: Option<f64>,
) -> Option<Interval> {
    let values: Vec<f64> = records.iter().filter_map(|r| value(r, class, metric)).collect();
    // The reference is common to all replicates.
    let common = reference_share(records, class, metric).standard_error;
    let within = records.first().and_then(|r| r.metrics_within_se.get(metric)).filter(|_| class.is_none());
    let (interval, source) = match (values.as_slice(), within) {
        ([value], Some(within)) => {
            let se = within.hypot(common);
            (stats::Interval::symmetric(*value, se, LEVEL, None, 1), Source::WithinImage)
        }
        _ => (replicate_interval(&values, common, LEVEL)?, Source::Replicates),
    };
    let info = noisefloor_study::metric::info(metric)?;
    // Only errors that the reference's noise was taken out of can fall to where the reference shows nothing.
    let corrected = info.lower_is_better && info.reference_noise_removed;
    let hidden = || interval.below(floor.unwrap_or(0.0));
    let doubtful = || {
        let bias = bias(records, class, metric)?;
        let noise = mean(records.iter().filter_map(|r| Some(r.contribution(class, metric)?.noise)))?;
        Contribution { bias, noise, ..Contribution::default() }.upper_limit(interval.value, interval.high)
    };
    let below = if corrected { doubtful().or_else(hidden) } else { None };
    let mut out = told(interval, source, below);
    if info.lower_is_better {
        // An error is not negative, whatever its corrected estimate.
        out.low = out.low.map(|low| low.max(0.0));
    }
    Some(out)
}

/// Bias by the reference that was taken out of a metric, mean over replicates; `None` where none is stated.
pub(crate) fn bias(records: &[&Record], class: Option<&str>, metric: &str) -> Option<f64> {
    mean(records.iter().filter_map(|record| Some(record.contribution(class, metric)?.bias)))
}

/// Rate over replicates, from the counts of each: hits and trials. With one replicate, its interval within the image.
pub(crate) fn rate(counts: &[(u64, u64)], within: Option<f64>) -> Option<Interval> {
    let rates: Vec<f64> = counts
        .iter()
        .filter(|(_, trials)| *trials > 0)
        .map(|(hits, trials)| *hits as f64 / *trials as f64)
        .collect();
    if let ([rate], Some(se)) = (rates.as_slice(), within) {
        let mut interval = stats::Interval::symmetric(*rate, se, LEVEL, None, 1);
        interval.low = interval.low.map(|low| low.max(0.0));
        interval.high = interval.high.map(|high| high.min(1.0));
        return Some(told(interval, Source::WithinImage, None));
    }
    // Three channels of a pixel are one trial.
    let trials = counts.iter().map(|(_, trials)| trials).sum::<u64>() / 3;
    Some(told(stats::proportion_interval(&rates, trials, LEVEL)?, Source::Replicates, None))
}

/// Mean of some numbers, if there are any.
pub(crate) fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0u32), |(sum, count), v| (sum + v, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}

/// Median of some numbers, if there are any.
pub fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n % 2 == 1 => Some(sorted[middle]),
        _ => Some(0.5 * (sorted[middle - 1] + sorted[middle])),
    }
}
