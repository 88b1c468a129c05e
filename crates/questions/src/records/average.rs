//! Numbers over replicates, with their uncertainty.

use noisefloor_metrics::Contribution;
use noisefloor_stats::{self as stats, replicate_interval};
use noisefloor_study::record::Record;
use noisefloor_study::summary::{Interval, Source};

use crate::records::number::{LEVEL, bias, mean, told, value};
use crate::records::series::reference_share;

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
