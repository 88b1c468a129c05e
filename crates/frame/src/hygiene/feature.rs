//! Features and flash images.

use crate::{Estimate, Finding, FindingKind, Image, Samples, Variance};

use super::{Hygiene, halves, variance};

/// Mends a feature; `false` if it has no finite value and is to be dropped.
pub(super) fn clean(name: &str, estimate: &mut Estimate, samples: &Samples, report: &mut Hygiene) -> bool {
    let data = estimate.mean.data();
    let of = data.len();
    let invalid = estimate.mean.count_non_finite();
    if invalid == of {
        report.invalid_feature_values += invalid;
        let text = "no value is finite: taken for absent";
        report.findings.push(Finding::new(FindingKind::InvalidFeature, name, text).with_value(of as f64));
        return false;
    }
    report.invalid_feature_values += invalid;
    let of_half_file = crate::inspect::Precision::of(data).is_half();
    // Pixels without a value in some channel have no statistics in any.
    let without = super::invalid_pixels(&estimate.mean);
    let background = if name == "depth" { data.iter().filter(|v| **v == f32::INFINITY).count() } else { 0 };
    if invalid > background {
        let text = format!("{} of {of} values are not finite and were set to 0", invalid - background);
        let found = Finding::new(FindingKind::InvalidFeature, name, text);
        report.findings.push(found.with_value((invalid - background) as f64));
    }
    if let Some(stated) = estimate.variance.take() {
        let mut image = stated.into_mean_variance();
        if variance::clean(name, &mut image, &without, of_half_file, report).is_some() {
            estimate.variance = Some(Variance::of_mean(image));
        }
    }
    if !halves::clean(name, estimate, &without, samples, report) {
        estimate.halves = None;
    }
    if invalid > 0 {
        replace(name == "depth", estimate);
    }
    true
}

/// Gives values that are not finite one without noise: 0, or a depth behind everything.
fn replace(depth: bool, estimate: &mut Estimate) {
    let largest = estimate.mean.data().iter().copied().filter(|v| v.is_finite()).fold(0.0f32, f32::max);
    let far = (largest * 1.1).min(f32::MAX);
    let mut variance = estimate.variance.take().map(Variance::into_mean_variance);
    for i in 0..estimate.mean.data().len() {
        let value = estimate.mean.data()[i];
        if value.is_finite() {
            continue;
        }
        let with = if depth && value.is_infinite() { far } else { 0.0 };
        estimate.mean.data_mut()[i] = with;
        estimate.halves.iter_mut().flatten().for_each(|half| half.data_mut()[i] = with);
        variance.iter_mut().for_each(|image| image.data_mut()[i] = 0.0);
    }
    estimate.variance = variance.map(Variance::of_mean);
    // Channels that are finite in a pixel without statistics.
    for half in estimate.halves.iter_mut().flatten() {
        for (half, mean) in half.data_mut().iter_mut().zip(estimate.mean.data()) {
            *half = if half.is_finite() { *half } else { *mean };
        }
    }
}

/// Covariances that are not finite count as 0.
pub(super) fn zero_non_finite(image: &mut Image, report: &mut Hygiene) {
    let count = image.count_non_finite();
    if count == 0 {
        return;
    }
    image.data_mut().iter_mut().filter(|v| !v.is_finite()).for_each(|value| *value = 0.0);
    report.invalid_feature_values += count;
    let text = format!("{count} of {} values are not finite and were set to 0", image.data().len());
    report
        .findings
        .push(Finding::new(FindingKind::InvalidFeature, "flashCov", text).with_value(count as f64));
}
