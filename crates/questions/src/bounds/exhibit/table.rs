use std::collections::BTreeSet;

use noisefloor_study::exhibit::{Column, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::BoundSummary;

use super::super::analyse::id_of;
use super::guard::covers;
use crate::charts::distinct;
use crate::shown;
use crate::view::View;

/// Error bounds on one scene.
pub(in crate::bounds) struct Promises<'a> {
    /// Levels, ascending.
    pub(in crate::bounds) spp: Vec<u32>,
    /// Claims of rows, in the study's order.
    pub(in crate::bounds) claims: Vec<Promise<'a>>,
    marks: Vec<String>,
}

/// A claim of a row, level by level.
pub(in crate::bounds) struct Promise<'a> {
    pub(in crate::bounds) label: &'a str,
    pub(in crate::bounds) claim: &'a str,
    pub(in crate::bounds) proven: bool,
    pub(in crate::bounds) alpha: f64,
    pub(in crate::bounds) class: &'a str,
    /// One per level.
    pub(in crate::bounds) found: Vec<Option<&'a BoundSummary>>,
}

impl Promise<'_> {
    /// `proven` or `unproven`.
    pub(in crate::bounds) fn kind(&self) -> &'static str {
        if self.proven { "proven" } else { "unproven" }
    }
}

/// Bounds of a scene; nothing if no row claims one.
pub(in crate::bounds) fn promises<'a>(view: &View<'a>, scene: &str) -> Option<Promises<'a>> {
    let all: Vec<&'a BoundSummary> = view.summary.bounds.iter().filter(|b| b.scene == scene).collect();
    let spp = distinct(all.iter().map(|b| b.spp));
    if spp.is_empty() {
        return None;
    }
    // Proven claims come before others of the same name.
    let key = |b: &&'a BoundSummary| {
        let (label, claim, class) = (b.label.as_str(), b.claim.as_str(), b.class.as_str());
        (view.row(label), label, claim, !b.proven, b.alpha.to_bits(), class)
    };
    let keys: BTreeSet<_> = all.iter().map(key).collect();
    let claims = keys.into_iter().map(|this| {
        let (_, label, claim, unproven, alpha, class) = this;
        let at = |spp: &u32| all.iter().find(|b| key(b) == this && b.spp == *spp).copied();
        let found = spp.iter().map(at).collect();
        Promise { label, claim, proven: !unproven, alpha: f64::from_bits(alpha), class, found }
    });
    let claims = claims.collect();
    let marks = shown::marks(all.iter().filter_map(|b| b.mark.as_deref()));
    Some(Promises { spp, claims, marks })
}

/// The table over all pixels, and behind a line those by class.
pub(super) fn parts(view: &View<'_>, promises: &Promises<'_>, name: &str) -> Vec<Part> {
    let (all, classes): (Vec<&Promise<'_>>, Vec<_>) = promises.claims.iter().partition(|p| p.class == "all");
    let columns = |by_class: bool| {
        let mut columns = vec![Column::text("Method"), Column::text("Claim")];
        columns.extend(by_class.then(|| Column::text("Class")));
        columns.push(Column::number("α"));
        columns.extend(promises.spp.iter().map(|&spp| shown::level_column(spp)));
        columns
    };
    let rows =
        |claims: Vec<&Promise<'_>>, by_class| claims.into_iter().map(|p| row(view, p, by_class)).collect();
    let table = Table {
        id: format!("bounds-{name}"),
        columns: columns(false),
        rows: rows(all, false),
        notes: promises.marks.clone(),
        ..Table::default()
    };
    let mut parts = vec![Part::Table(table)];
    if !classes.is_empty() {
        let table = Table {
            id: format!("bounds-{name}-classes"),
            columns: columns(true),
            rows: rows(classes, true),
            ..Table::default()
        };
        parts.push(Part::folded("By pixel class", vec![Part::Table(table)]));
    }
    parts
}

fn row(view: &View<'_>, p: &Promise<'_>, by_class: bool) -> TableRow {
    let claim = TableCell::text(p.claim).tag(p.kind(), noisefloor_study::exhibit::Tone::Plain, "");
    let mut cells = vec![view.row_cell(p.label), claim];
    cells.extend(by_class.then(|| TableCell::text(p.class)));
    cells.push(TableCell::text(format::percent_short(p.alpha)).number(Number::exact(p.alpha)));
    cells.extend(p.found.iter().map(|found| {
        let Some(b) = found else { return TableCell::none() };
        if by_class { rate(b) } else { whole(view, b) }
    }));
    TableRow::new(cells)
}

/// A rate over all pixels with its verdict and, for a guard, what its interval covers.
fn whole(view: &View<'_>, b: &BoundSummary) -> TableCell {
    let cell = rate(b).about(details(b));
    let covers = covers(view, b).unwrap_or_default();
    let cell = TableCell { aside: shown::joined(&[&cell.aside, &covers], "; "), ..cell };
    shown::judged(cell, view.claim(&id_of(b)))
}

/// One measured rate.
fn rate(b: &BoundSummary) -> TableCell {
    let mut cell = shown::fraction(&b.violations);
    if b.mark.is_some() {
        cell.text += " *";
    }
    cell
}

/// Uncorrected rate, share of missed events, looseness: shown on demand.
fn details(b: &BoundSummary) -> String {
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
    details
}
