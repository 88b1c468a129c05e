use std::collections::BTreeSet;

use noisefloor_stats::{self as stats, ReferenceShare, Region, paired_effect, replicate_interval};

use crate::cell::ALL;
use crate::claims::{Claim, push};
use crate::records::Index;
use crate::records::reference_share;
use crate::records::{LEVEL, told};
use noisefloor_study::record::{EstimateCheck, EstimateMeans, Record};
use noisefloor_study::summary::{ClaimId, EstimateBin, EstimateSummary, Scale, Source, Summary};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.estimates = estimates(index);
    let all: Vec<EstimateSummary> =
        summary.estimates.iter().filter(|estimate| estimate.class == ALL).cloned().collect();
    all.iter().for_each(|estimate| push(summary, claim(estimate)));
}

/// Which claim the estimate of a row is.
pub(super) fn id(scene: &str, spp: u32, label: &str) -> ClaimId {
    ClaimId {
        question: "own_error".into(),
        what: "calibrated".into(),
        scene: scene.to_owned(),
        spp: Some(spp),
        label: label.to_owned(),
    }
}

/// That the estimate is within a fifth of the measured error, by the ratio of the two, or by their difference where an
/// estimate is not positive: an estimate below zero is no less wrong than one that is too small.
pub(crate) fn claim(estimate: &EstimateSummary) -> Claim {
    let measured = &estimate.measured;
    let (scale, region) = if estimate.is_ratio {
        (Scale::Ratio, Some(Region::ESTIMATE))
    } else {
        let Region { low, high } = Region::ESTIMATE;
        let about = |m: f64| Region { low: (low - 1.0) * m, high: (high - 1.0) * m };
        // Nothing can be judged where the measured error is not sure to be above 0.
        let sure = measured.low.is_some_and(|low| low > 0.0);
        (Scale::Number, sure.then(|| about(measured.value)))
    };
    Claim {
        id: id(&estimate.scene, estimate.spp, &estimate.label),
        sentence: "estimates its own squared error within 0.8 to 1.25 of the measured one".into(),
        effect: estimate.effect.clone(),
        uncorrected: None,
        scale,
        region,
        common: estimate.common,
        trials: None,
        replicates_per_value: 1,
    }
}

/// Estimated against measured squared error per scene, level, row and class, over replicates.
fn estimates(index: &Index<'_>) -> Vec<EstimateSummary> {
    let mut out = Vec::new();
    for scene in index.scenes() {
        for spp in index.levels_of(scene) {
            for row in index.rows() {
                let label = &row.summary.label;
                let records = index.records(scene, spp, label);
                let checks = || records.iter().filter_map(|record| record.error_estimate.as_ref());
                let classes: BTreeSet<&str> =
                    checks().flat_map(|check| check.classes.keys()).map(String::as_str).collect();
                for class in std::iter::once(ALL).chain(classes) {
                    out.extend(one(&scene.id, spp, label, class, records));
                }
            }
        }
    }
    out
}

/// Means of a class in a replicate.
fn means<'a>(record: &'a Record, class: &str) -> Option<(&'a EstimateCheck, EstimateMeans)> {
    let check = record.error_estimate.as_ref()?;
    let found = if class == ALL { Some(&check.all) } else { check.classes.get(class) };
    Some((check, *found?))
}

fn one(scene: &str, spp: u32, label: &str, class: &str, records: &[&Record]) -> Option<EstimateSummary> {
    let found: Vec<_> = records.iter().filter_map(|record| means(record, class)).collect();
    let estimated: Vec<f64> = found.iter().map(|(_, m)| m.estimated).collect();
    let measured: Vec<f64> = found.iter().map(|(_, m)| m.measured).collect();
    // What was measured over the same pixels; the estimate itself knows nothing of the reference.
    let share = reference_share(records, (class != ALL).then_some(class), "mse");
    let reference = share.standard_error;
    let some = |values: &[f64]| values.iter().copied().map(Some).collect::<Vec<_>>();
    let effect = paired_effect(
        &some(&estimated),
        &some(&measured),
        [&ReferenceShare::default(), &share],
        true,
        LEVEL,
    )?;
    let within = match found.as_slice() {
        [(check, _)] if class == ALL && effect.is_ratio => check.within_se,
        _ => None,
    };
    let interval = match within {
        Some(se) => {
            // A ratio is positive, and so is the measured error in it.
            let se = se.hypot(reference / measured[0]);
            let log = stats::Interval::symmetric(effect.interval.value.ln(), se, LEVEL, None, 1);
            told(log.exp(), Source::WithinImage, None)
        }
        None => told(effect.interval, Source::Replicates, None),
    };
    let mean = |values: &[f64], common| {
        replicate_interval(values, common, LEVEL).map(|i| told(i, Source::Replicates, None))
    };
    let bins = if class == ALL { found.iter().map(|(c, _)| c.deciles.len()).min().unwrap_or(0) } else { 0 };
    let bin = |k: usize| {
        let part = |of: fn(&EstimateMeans) -> f64| -> Vec<f64> {
            found.iter().filter_map(|(check, _)| check.deciles.get(k)).map(of).collect()
        };
        Some(EstimateBin {
            estimated: mean(&part(|m| m.estimated), 0.0)?,
            measured: mean(&part(|m| m.measured), 0.0)?,
        })
    };
    Some(EstimateSummary {
        scene: scene.to_owned(),
        spp,
        label: label.to_owned(),
        of: found.iter().find_map(|(check, _)| check.of.clone()),
        class: class.to_owned(),
        estimated: mean(&estimated, 0.0)?,
        measured: mean(&measured, reference)?,
        effect: interval,
        is_ratio: effect.is_ratio,
        common: effect.common,
        deciles: (0..bins).filter_map(bin).collect(),
        non_finite: found.iter().map(|(check, _)| check.non_finite).sum(),
    })
}
