use noisefloor_study::exhibit::{Column, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::CellSummary;

use crate::shown;
use crate::view::View;

/// Every metric that was measured.
pub(super) fn all(view: &View<'_>, name: &str, spp: u32, cells: &[&CellSummary]) -> Table {
    // Records of earlier programs lack metrics that came later.
    let measured = |id: &&str| cells.iter().any(|cell| cell.metrics.contains_key(*id));
    let ids: Vec<&str> = view.summary.study.metrics.iter().map(|m| m.id.as_str()).filter(measured).collect();
    let column = |id: &&str| {
        let mark = if *id == "relmse_trimmed" { " †" } else { "" };
        let unit = view.metric(id).map_or("", |m| m.unit.as_str());
        Column::number(format!("{}{mark}", view.metric_label(id))).unit(unit)
    };
    let row = |cell: &&CellSummary| {
        let values = ids.iter().map(|id| shown::value_or_empty(cell.metrics.get(*id)));
        TableRow::new(std::iter::once(view.row_cell(&cell.label)).chain(values).collect())
    };
    Table {
        id: format!("metrics-{name}-{spp}"),
        caption: String::new(),
        columns: std::iter::once(Column::text("Method")).chain(ids.iter().map(column)).collect(),
        rows: cells.iter().map(row).collect(),
        notes: trimmed(view).into_iter().collect(),
    }
}

/// Where trimmed and untrimmed values stand side by side: what keeps them from being compared.
fn trimmed(view: &View<'_>) -> Option<String> {
    let (trimmed, whole) = (view.metric("relmse_trimmed")?, view.metric("relmse")?);
    let noise = match trimmed.reference_noise_removed == whole.reference_noise_removed {
        true => String::new(),
        false => format!(", and the noise of the reference is taken out of {} only", whole.name),
    };
    Some(format!(
        "† {} and {} cannot be compared with each other: {} leaves out each row's own worst 0.1 % of the pixels{noise}.",
        trimmed.name, whole.name, trimmed.name
    ))
}

/// The first metric per pixel class, with the ratio to plain Monte Carlo; nothing if there are no classes.
pub(super) fn classes(view: &View<'_>, name: &str, spp: u32, cells: &[&CellSummary]) -> Option<Table> {
    let (metric, metric_name) = view.primary();
    let mut names: Vec<&String> = cells.iter().flat_map(|c| c.classes.keys()).collect();
    names.sort();
    names.dedup();
    if names.is_empty() {
        return None;
    }
    let row = |cell: &&CellSummary| {
        let values = names.iter().map(|class| of_class(cell, class, metric));
        TableRow::new(std::iter::once(view.row_cell(&cell.label)).chain(values).collect())
    };
    let unit = view.metric(metric).map_or("", |m| m.unit.as_str());
    let columns = names.iter().map(|class| Column::number(*class).unit(unit));
    Some(Table {
        id: format!("classes-{name}-{spp}"),
        caption: format!("{metric_name} by pixel class"),
        columns: std::iter::once(Column::text("Method")).chain(columns).collect(),
        rows: cells.iter().map(row).collect(),
        notes: Vec::new(),
    })
}

fn of_class(cell: &CellSummary, class: &str, metric: &str) -> TableCell {
    let value = cell.classes.get(class).and_then(|metrics| metrics.get(metric));
    let value = shown::value_or_empty(value);
    match cell.class_ratio_to_mc.get(class).and_then(|metrics| metrics.get(metric)) {
        Some(ratio) => {
            let ratio = format!("({} × mc)", format::ratio(ratio.value));
            let aside = shown::joined(&[&value.aside, &ratio], " ");
            value.aside(aside)
        }
        None => value,
    }
}
