//! The metric table, as a study sees it.

use noisefloor_metrics::{Better, METRICS, Metric, on_request};

use crate::summary::MetricInfo;

/// Ids of the metrics of a study that lists none, in the order of display.
#[must_use]
pub fn ids() -> Vec<String> {
    METRICS.iter().map(|metric| metric.id.to_owned()).collect()
}

/// Ids of all metrics that a study may list.
#[must_use]
pub fn known() -> Vec<String> {
    METRICS.iter().chain(on_request()).map(|metric| metric.id.to_owned()).collect()
}

/// Those that are measured because a study lists them.
#[must_use]
pub fn asked(listed: &[String]) -> Vec<&'static Metric> {
    on_request().into_iter().filter(|metric| listed.iter().any(|id| id == metric.id)).collect()
}

fn of(id: &str) -> Option<&'static Metric> {
    noisefloor_metrics::metric(id).ok()
}

/// The metric shown first unless a study says otherwise: `relmse` where it is listed, else the first that ranks rows.
#[must_use]
pub fn primary(listed: &[String]) -> String {
    let preferred = listed.iter().find(|id| *id == "relmse");
    preferred.or(listed.iter().find(|id| ranks(id))).cloned().unwrap_or_default()
}

/// How to read a metric.
#[must_use]
pub fn info(id: &str) -> Option<MetricInfo> {
    let metric = of(id)?;
    Some(MetricInfo {
        id: metric.id.into(),
        name: metric.name.into(),
        formula: metric.formula_text(),
        lower_is_better: metric.better == Better::Lower,
        ideal: match metric.better {
            Better::CloserTo(ideal) => Some(ideal),
            Better::Lower | Better::Higher => None,
        },
        unit: metric.unit.into(),
        reference_noise_removed: metric.reference_noise_removed,
        order: metric.order,
    })
}

/// 2 for squared errors, 1 for their roots, `None` where plain Monte Carlo has no fixed rate.
#[must_use]
pub fn order(id: &str) -> Option<u32> {
    of(id)?.order
}

/// The squared error that a metric is, or is the root of; `None` where plain Monte Carlo has no fixed rate.
#[must_use]
pub fn squared(id: &str) -> Option<&str> {
    match order(id)? {
        2 => Some(id),
        _ => (id == "rmse").then_some("mse"),
    }
}

/// Whether smaller is better; `false` for an unknown metric.
#[must_use]
pub fn lower_is_better(id: &str) -> bool {
    of(id).is_some_and(|metric| metric.better == Better::Lower)
}

/// Whether rows can be ranked by it; `false` for an unknown metric.
#[must_use]
pub fn ranks(id: &str) -> bool {
    of(id).is_some_and(|metric| matches!(metric.better, Better::Lower | Better::Higher))
}
