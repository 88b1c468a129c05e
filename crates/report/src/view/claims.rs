//! Coverage, error bounds and enclosures as tables.

use std::collections::BTreeSet;

use noisefloor_harness::summary::{BoundSummary, CoverageSummary, SceneSummary};
use serde::Serialize;

use crate::format;
use crate::index::Index;

/// Coverage on one scene.
#[derive(Debug, Serialize)]
pub(crate) struct CoverageView {
    pub title: String,
    /// Nominal levels, as text.
    pub nominal: Vec<String>,
    pub rows: Vec<CoverageRow>,
    pub classes: Vec<CoverageRow>,
    pub marks: Vec<String>,
}

/// One class at one level.
#[derive(Debug, Serialize)]
pub(crate) struct CoverageRow {
    pub class: String,
    pub spp: u32,
    /// Per nominal level: measured, interval, uncorrected.
    pub levels: Vec<(String, String, String)>,
    pub constant: String,
    pub missed: String,
}

/// Coverage tables of a scene; nothing if it was not measured.
pub(crate) fn coverage(index: &Index<'_>, scene: &SceneSummary) -> Option<CoverageView> {
    let all: Vec<&CoverageSummary> = index.summary.coverage.iter().filter(|c| c.scene == scene.id).collect();
    let mut nominal: Vec<f64> = all.iter().map(|c| c.confidence).collect();
    nominal.sort_by(f64::total_cmp);
    nominal.dedup();
    if nominal.is_empty() {
        return None;
    }
    let keys: BTreeSet<(&str, u32)> = all.iter().map(|c| (c.class.as_str(), c.spp)).collect();
    let (mut rows, mut classes) = (Vec::new(), Vec::new());
    for (class, spp) in keys {
        let here: Vec<&CoverageSummary> =
            all.iter().filter(|c| c.class == class && c.spp == spp).copied().collect();
        let row = coverage_row(class, spp, &nominal, &here);
        if class == "all" { rows.push(row) } else { classes.push(row) }
    }
    Some(CoverageView {
        title: scene.title.clone(),
        nominal: nominal.iter().map(|n| format::percent_short(*n)).collect(),
        rows,
        classes,
        marks: distinct(all.iter().filter_map(|c| c.mark.as_deref())),
    })
}

fn coverage_row(class: &str, spp: u32, nominal: &[f64], here: &[&CoverageSummary]) -> CoverageRow {
    let level = |level: &f64| {
        let Some(c) = here.iter().find(|c| c.confidence == *level) else {
            return (String::new(), String::new(), String::new());
        };
        let shown = format::percent_interval(&c.covered);
        let mark = if c.mark.is_some() { " *" } else { "" };
        (format!("{}{mark}", shown.value), shown.spread, format::percent(c.covered_uncorrected.value))
    };
    // The split does not depend on the nominal level, except through the reference's noise.
    let first = here.first();
    CoverageRow {
        class: class.to_owned(),
        spp,
        levels: nominal.iter().map(level).collect(),
        constant: first.map_or_else(String::new, |c| format::percent(c.constant)),
        missed: first.map_or_else(String::new, |c| format::percent(c.missed)),
    }
}

fn distinct<'a>(texts: impl Iterator<Item = &'a str>) -> Vec<String> {
    let set: BTreeSet<&str> = texts.collect();
    set.into_iter().map(str::to_owned).collect()
}

/// Error bounds on one scene.
#[derive(Debug, Serialize)]
pub(crate) struct BoundsView {
    pub title: String,
    pub spp: Vec<u32>,
    pub rows: Vec<BoundRow>,
    pub classes: Vec<BoundRow>,
    pub marks: Vec<String>,
}

/// A claim of a row, level by level.
#[derive(Debug, Serialize)]
pub(crate) struct BoundRow {
    pub label: String,
    pub swatch: usize,
    pub claim: String,
    pub proven: bool,
    pub alpha: String,
    pub class: String,
    pub cells: Vec<Option<BoundCell>>,
}

/// One measured rate.
#[derive(Debug, Serialize)]
pub(crate) struct BoundCell {
    pub rate: String,
    pub spread: String,
    /// `holds`, `fails` or `undecided`.
    pub verdict: String,
    pub marked: bool,
    /// Uncorrected rate, share of missed events, looseness: shown on demand.
    pub details: String,
}

/// Bound tables of a scene; nothing if no row claims a bound.
pub(crate) fn bounds(index: &Index<'_>, scene: &SceneSummary) -> Option<BoundsView> {
    let all: Vec<&BoundSummary> = index.summary.bounds.iter().filter(|b| b.scene == scene.id).collect();
    let spp: Vec<u32> = all.iter().map(|b| b.spp).collect::<BTreeSet<_>>().into_iter().collect();
    if spp.is_empty() {
        return None;
    }
    let position = |label: &str| index.summary.methods.iter().position(|m| m.label == label).unwrap_or(0);
    let keys: BTreeSet<(usize, &str, &str, bool, u64, &str)> = all
        .iter()
        .map(|b| {
            (
                position(&b.label),
                b.label.as_str(),
                b.claim.as_str(),
                !b.proven,
                b.alpha.to_bits(),
                b.class.as_str(),
            )
        })
        .collect();
    let (mut rows, mut classes) = (Vec::new(), Vec::new());
    for (swatch, label, claim, unproven, alpha, class) in keys {
        let same = |b: &&&BoundSummary| {
            b.label == label
                && b.claim == claim
                && b.proven != unproven
                && b.alpha.to_bits() == alpha
                && b.class == class
        };
        let cells = spp.iter().map(|&n| all.iter().filter(same).find(|b| b.spp == n).map(|b| bound_cell(b)));
        let row = BoundRow {
            label: label.to_owned(),
            swatch,
            claim: claim.to_owned(),
            proven: !unproven,
            alpha: format::percent_short(f64::from_bits(alpha)),
            class: class.to_owned(),
            cells: cells.collect(),
        };
        if class == "all" { rows.push(row) } else { classes.push(row) }
    }
    Some(BoundsView {
        title: scene.title.clone(),
        spp,
        rows,
        classes,
        marks: distinct(all.iter().filter_map(|b| b.mark.as_deref())),
    })
}

fn bound_cell(b: &BoundSummary) -> BoundCell {
    let shown = format::percent_interval(&b.violations);
    let mut details = format!(
        "without the allowance for the reference's noise {}; from pixels without variance {}",
        format::percent(b.violations_uncorrected),
        format::percent(b.missed)
    );
    if let Some(ratio) = b.mean_ratio {
        details += &format!("; mean |D−μ| is {} of the bound", format::percent(ratio));
    }
    if let Some(mark) = &b.mark {
        details += &format!("; {mark}");
    }
    BoundCell {
        rate: shown.value,
        spread: shown.spread,
        verdict: b.verdict.clone(),
        marked: b.mark.is_some(),
        details,
    }
}

/// Worst |D − x̄| over the half-width, per row and scene.
#[derive(Debug, Serialize)]
pub(crate) struct EnclosureView {
    pub scenes: Vec<String>,
    pub rows: Vec<EnclosureRow>,
}

/// Label, swatch, and per scene the ratio and whether the promise held.
type EnclosureRow = (String, usize, Vec<Option<(String, bool)>>);

/// The enclosure table; nothing if no row claims an enclosure.
pub(crate) fn enclosures(index: &Index<'_>) -> Option<EnclosureView> {
    let summary = index.summary;
    let worst = |scene: &str, label: &str| {
        let here = summary.cells.iter().filter(|c| c.scene == scene && c.label == label);
        here.filter_map(|c| c.enclosure_worst_ratio).reduce(f64::max)
    };
    let mut rows = Vec::new();
    for (swatch, method) in summary.methods.iter().enumerate() {
        let ratios: Vec<_> = summary
            .scenes
            .iter()
            .map(|s| worst(&s.id, &method.label).map(|r| (format!("{r:.6}"), r <= 1.0)))
            .collect();
        if ratios.iter().any(Option::is_some) {
            rows.push((method.label.clone(), swatch, ratios));
        }
    }
    let scenes = summary.scenes.iter().map(|s| s.title.clone()).collect();
    (!rows.is_empty()).then_some(EnclosureView { scenes, rows })
}
