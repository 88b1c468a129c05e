//! What the interval covers that a guard projects into, beside the bound that follows from it.

use noisefloor_study::format;
use noisefloor_study::summary::{BoundSummary, Interval};
use serde_json::Value;

use crate::cell::ALL;
use crate::intervals::coverage_of;
use crate::view::View;

/// `its interval covers 93.1 %`, where the bound is a guard's and its interval was measured at its level; pixels that missed
/// events count as missed.
pub(super) fn covers(view: &View<'_>, b: &BoundSummary) -> Option<String> {
    let params = &view.summary.methods.iter().find(|row| row.label == b.label)?.params;
    let level = params.get("guard_level").and_then(Value::as_f64)?;
    let family = params.get("guard_interval").and_then(Value::as_str).unwrap_or("t");
    let covered = covered(view, b, family, level)?;
    Some(format!("its interval covers {}", format::percent(covered.value)))
}

fn covered(view: &View<'_>, b: &BoundSummary, family: &str, level: f64) -> Option<Interval> {
    if family != "t" {
        return coverage_of(view, &b.scene, b.spp, family, level);
    }
    let same = |confidence: f64| (confidence - level).abs() < 1e-12;
    let mut of_scene = view.summary.coverage.iter().filter(|c| c.scene == b.scene && c.spp == b.spp);
    of_scene.find(|c| c.class == ALL && same(c.confidence))?.lit.clone()
}
