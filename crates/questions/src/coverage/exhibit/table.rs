use std::collections::BTreeSet;

use noisefloor_study::exhibit::{Column, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::CoverageSummary;

use super::super::claims::id_of;
use crate::cell::ALL;
use crate::charts::distinct_values;
use crate::shown;
use crate::view::View;

/// Coverage on one scene.
pub(in crate::coverage) struct Covered<'a> {
    /// Nominal levels, ascending.
    pub(in crate::coverage) nominal: Vec<f64>,
    /// Class and level in samples per pixel with the cells of the nominal levels, of constant and of missed pixels.
    pub(in crate::coverage) rows: Vec<(&'a str, u32, Vec<TableCell>)>,
    marks: Vec<String>,
}

/// Coverage of a scene; nothing if it was not measured.
pub(in crate::coverage) fn covered<'a>(view: &View<'a>, scene: &str) -> Option<Covered<'a>> {
    let all: Vec<&CoverageSummary> = view.summary.coverage.iter().filter(|c| c.scene == scene).collect();
    let nominal = distinct_values(all.iter().map(|c| c.confidence));
    if nominal.is_empty() {
        return None;
    }
    let keys: BTreeSet<(&str, u32)> = all.iter().map(|c| (c.class.as_str(), c.spp)).collect();
    let label = view.baseline().unwrap_or_default();
    let row = |(class, spp): (&'a str, u32)| {
        let here: Vec<&CoverageSummary> =
            all.iter().filter(|c| c.class == class && c.spp == spp).copied().collect();
        let mut cells: Vec<TableCell> =
            nominal.iter().map(|level| cell(view, label, &here, *level)).collect();
        // The split does not depend on the nominal level, except through the reference's noise.
        let first = here.first();
        cells.push(first.map(|c| shown::share(c.constant)).unwrap_or_default());
        cells.push(first.map(|c| shown::share(c.missed)).unwrap_or_default());
        let side = |k: usize| {
            let sides = here.iter().find(|c| c.confidence == nominal[0]).and_then(|c| c.sides);
            sides.map_or_else(TableCell::none, |sides| shown::share(sides[k]))
        };
        cells.extend([side(0), side(1)]);
        (class, spp, cells)
    };
    let rows = keys.into_iter().map(row).collect();
    let marks = shown::marks(all.iter().filter_map(|c| c.mark.as_deref()));
    Some(Covered { nominal, rows, marks })
}

/// The share covered of all pixels, and the verdict, which is about those with s > 0.
fn cell(view: &View<'_>, label: &str, here: &[&CoverageSummary], nominal: f64) -> TableCell {
    let Some(c) = here.iter().find(|c| c.confidence == nominal) else { return TableCell::default() };
    let mut cell = shown::fraction(&c.covered);
    if c.mark.is_some() {
        cell.text += " *";
    }
    let raw = format::percent(c.covered_uncorrected.value);
    let of_varying = c.varying.as_ref().map_or_else(String::new, |share| {
        format!("; of pixels with s > 0: {}", format::percent_interval(share).line())
    });
    let cell = cell.about(format!("Without the allowance for the reference's noise: {raw}{of_varying}"));
    if c.class != ALL {
        return cell;
    }
    // What is judged stands beside the verdict.
    let claim = view.claim(&id_of(c, label));
    let cell = match claim.zip(c.varying.as_ref()) {
        Some((_, varying)) if format::percent(varying.value) != format::percent(c.covered.value) => {
            let judged = format!("{} where s > 0", format::percent(varying.value));
            TableCell { aside: shown::joined(&[&cell.aside, &judged], "; "), ..cell }
        }
        _ => cell,
    };
    shown::judged(cell, claim)
}

/// The table of all pixels, and behind a line those by class.
pub(super) fn parts(covered: &Covered<'_>, name: &str) -> Vec<Part> {
    let (all, classes): (Vec<_>, Vec<_>) = covered.rows.iter().partition(|(class, ..)| *class == "all");
    let spp = || Column::number("spp").unit("spp");
    let numbers = || {
        let nominal = covered.nominal.iter().map(|n| format!("nominal {}", format::percent_short(*n)));
        let lowest = covered.nominal.first().map_or_else(String::new, |n| format::percent_short(*n));
        let sides = ["above", "below"].map(|side| format!("truth {side} {lowest}"));
        nominal.chain(["constant".into(), "missed".into()]).chain(sides).map(Column::number)
    };
    let rows = all.into_iter().map(|(_, spp, cells)| {
        TableRow::new(std::iter::once(TableCell::count((*spp).into())).chain(cells.clone()).collect())
    });
    let table = Table {
        id: format!("coverage-{name}"),
        columns: std::iter::once(spp()).chain(numbers()).collect(),
        rows: rows.collect(),
        notes: covered.marks.clone(),
        ..Table::default()
    };
    let mut parts = vec![Part::Table(table)];
    if !classes.is_empty() {
        let rows = classes.into_iter().map(|(class, spp, cells)| {
            TableRow::new(
                [TableCell::text(*class), TableCell::count((*spp).into())]
                    .into_iter()
                    .chain(cells.clone())
                    .collect(),
            )
        });
        let table = Table {
            id: format!("coverage-{name}-classes"),
            columns: [Column::text("Class"), spp()].into_iter().chain(numbers()).collect(),
            rows: rows.collect(),
            ..Table::default()
        };
        parts.push(Part::folded("By pixel class", vec![Part::Table(table)]));
    }
    parts
}
