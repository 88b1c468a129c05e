use noisefloor_stats::Verdict;
use noisefloor_study::exhibit::{Column, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::{EstimateSummary, SceneSummary};

use super::super::analyse::id;
use crate::shown;
use crate::view::View;

/// The table over all pixels, and behind a line those by class; nothing if no row estimates its own error there.
pub(super) fn parts(view: &View<'_>, scene: &SceneSummary, name: &str) -> Vec<Part> {
    let here = view.summary.estimates.iter().filter(|e| e.scene == scene.id);
    let (all, classes): (Vec<&EstimateSummary>, Vec<_>) = here.partition(|e| e.class == "all");
    if all.is_empty() {
        return Vec::new();
    }
    let mut parts = vec![Part::Table(table(view, format!("estimates-{name}"), &all, false))];
    if !classes.is_empty() {
        let table = table(view, format!("estimates-{name}-classes"), &classes, true);
        parts.push(Part::folded("By pixel class", vec![Part::Table(table)]));
    }
    parts
}

fn table(view: &View<'_>, id: String, estimates: &[&EstimateSummary], by_class: bool) -> Table {
    let mut columns = vec![Column::number("spp").unit("spp"), Column::text("Method")];
    columns.extend(by_class.then(|| Column::text("Class")));
    columns.extend(["Estimated", "Measured", "Ratio"].map(Column::number));
    columns.push(Column::text("Verdict"));
    let row = |e: &&EstimateSummary| {
        let mut cells = vec![TableCell::count(e.spp.into()), view.row_cell(&e.label)];
        cells.extend(by_class.then(|| TableCell::text(&e.class)));
        cells.extend([shown::value(&e.estimated), shown::value(&e.measured), effect(e)]);
        let verdict = if by_class { TableCell::default() } else { word(view, e) };
        cells.push(verdict.aside(note(e)));
        TableRow::new(cells)
    };
    Table { id, columns, rows: estimates.iter().map(row).collect(), ..Table::default() }
}

/// Estimated beside measured.
pub(in crate::own_error) fn effect(e: &EstimateSummary) -> TableCell {
    shown::effect(shown::value(&e.effect), e.is_ratio)
}

/// The verdict, and on which side a refuted estimate errs.
fn word(view: &View<'_>, e: &EstimateSummary) -> TableCell {
    let claim = view.claim(&id(&e.scene, e.spp, &e.label));
    let side = match claim {
        Some(claim) if claim.verdict == Verdict::Refuted && e.effect.value < 1.0 => ": too optimistic",
        Some(claim) if claim.verdict == Verdict::Refuted => ": too pessimistic",
        _ => "",
    };
    let cell = shown::word(claim);
    TableCell { text: format!("{}{side}", cell.text), ..cell }
}

/// Which image it is about, and what is left out.
fn note(e: &EstimateSummary) -> String {
    let about = e.of.as_ref().map_or_else(String::new, |of| format!("both of the {of}, not of the output"));
    let left_out = match e.non_finite {
        0 => String::new(),
        n => format!("{} without a finite estimate are left out", format::plural(n as usize, "value")),
    };
    shown::joined(&[&about, &left_out], "; ")
}
