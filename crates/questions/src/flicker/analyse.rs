use noisefloor_stats::{ReferenceShare, paired_ratio, replicate_interval};

use crate::records::Index;
use crate::records::{LEVEL, mean, told};
use noisefloor_study::summary::{FlickerSummary, Interval, Source, Summary};
use noisefloor_study::{Corrected, Flicker, OverTime};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.flicker = flicker(index);
}

/// Flicker per sequence, level and row, over replicates.
fn flicker(index: &Index<'_>) -> Vec<FlickerSummary> {
    let measured = index.flicker;
    let mut out = Vec::new();
    for (name, frames) in index.study.sequences() {
        let scenes: Vec<String> = frames.iter().map(|scene| scene.id.clone()).collect();
        for spp in index.levels() {
            let mut first: Option<(&str, Vec<&Flicker>)> = None;
            for row in index.rows() {
                let label = row.summary.label.as_str();
                let same = |f: &&Flicker| f.sequence == name && f.spp == spp && f.label == label;
                let own: Vec<&Flicker> = measured.iter().filter(same).collect();
                let variance = corrected(&own, |found| found.variance);
                let squared = corrected(&own, |found| found.squared_error);
                let (Some(variance), Some(squared_error)) = (variance, squared) else { continue };
                let ratio_to_first = first.as_ref().and_then(|(_, other)| ratio(&own, other));
                // The same for all replicates, up to pixels that are not finite in some of them.
                let noise: Option<Vec<f64>> = own.iter().map(|f| f.found.reference_variance).collect();
                let (first, _) = first.get_or_insert((label, own));
                out.push(FlickerSummary {
                    sequence: name.to_owned(),
                    scenes: scenes.clone(),
                    spp,
                    label: label.to_owned(),
                    variance,
                    ratio_to_first,
                    first: (*first).to_owned(),
                    squared_error,
                    reference_variance: noise.and_then(|all| mean(all.into_iter())),
                });
            }
        }
    }
    out
}

/// Mean over replicates of a number that the references' noise was taken out of.
fn corrected(found: &[&Flicker], of: fn(&OverTime) -> Corrected) -> Option<Interval> {
    let numbers = || found.iter().map(|f| of(&f.found));
    let values: Vec<f64> = numbers().map(|number| number.value).collect();
    let common = mean(numbers().map(|number| number.reference_se))?;
    let interval = replicate_interval(&values, common, LEVEL)?;
    let floor = mean(numbers().map(|number| number.floor))?;
    let mut out = told(interval, Source::Replicates, interval.below(floor));
    // Neither is negative, whatever its corrected estimate.
    out.low = out.low.map(|low| low.max(0.0));
    Some(out)
}

/// What the references contribute to two rows: influences whose products are the variances and the covariance.
fn shares(own: &[&Flicker], other: &[&Flicker]) -> [ReferenceShare; 2] {
    let se = |found: &[&Flicker]| mean(found.iter().map(|f| f.found.variance.reference_se)).unwrap_or(0.0);
    let (a, b) = (se(own), se(other));
    let covariance = mean(own.iter().filter_map(|f| f.found.covariance));
    match covariance {
        Some(covariance) if a > 0.0 && b > 0.0 => {
            let along = (covariance / b).clamp(-a, a);
            let parts = |parts: [f64; 2], standard_error| ReferenceShare {
                standard_error,
                parts: parts.to_vec(),
                product: 0.0,
            };
            [parts([along, (a * a - along * along).max(0.0).sqrt()], a), parts([b, 0.0], b)]
        }
        _ => [a.into(), b.into()],
    }
}

/// Ratio of the variances of two rows, paired over replicates.
fn ratio(own: &[&Flicker], other: &[&Flicker]) -> Option<Interval> {
    let by_replicate = |found: &[&Flicker]| {
        let count = found.iter().map(|f| f.replicate as usize + 1).max().unwrap_or(0);
        let mut out = vec![None; count];
        found.iter().for_each(|f| out[f.replicate as usize] = Some(f.found.variance.value));
        out
    };
    let [own_share, other_share] = shares(own, other);
    let effect = paired_ratio(&by_replicate(own), &by_replicate(other), [&own_share, &other_share], LEVEL)?;
    Some(told(effect.interval, Source::Replicates, None))
}
