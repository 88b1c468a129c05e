use noisefloor_study::exhibit::{Column, Number, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::{CellSummary, Interval};

use crate::shown;
use crate::view::View;

/// The best rows of all scenes and levels; nothing without scenes.
pub(crate) fn board(view: &View<'_>) -> Option<Table> {
    let study = &view.summary.study;
    if view.summary.scenes.is_empty() {
        return None;
    }
    let chosen = view.default_spp();
    // Its numbers say how many times below the unfiltered input the row is.
    let column = |&spp: &u32| Column {
        text: true,
        chosen: Some(spp) == chosen,
        ..shown::level_column(spp).unit("times below mc")
    };
    let rows = view.summary.scenes.iter().map(|scene| {
        let cells = study.spp.iter().map(|&spp| cell(view, &scene.id, spp).unwrap_or_else(TableCell::none));
        TableRow::new(std::iter::once(TableCell::text(&scene.title)).chain(cells).collect())
    });
    Some(Table {
        id: "board".into(),
        caption: format!("Best {} at each level, and how far below the unfiltered input", view.primary().1),
        rows: rows.collect(),
        columns: std::iter::once(Column::text("Scene")).chain(study.spp.iter().map(column)).collect(),
        notes: Vec::new(),
    })
}

fn cell(view: &View<'_>, scene: &str, spp: u32) -> Option<TableCell> {
    let (metric, _) = view.primary();
    let label = *view.ranking(scene, spp, metric).first()?;
    let cell = view.cell(scene, spp, label)?;
    let so_far = if view.complete_at(scene, spp) { "" } else { "so far" };
    let gain = gain(cell, metric);
    let how_far = match gain {
        _ if Some(label) == view.baseline() => "nothing beats the input".into(),
        Some(gain) => format!("{}× lower", format::ratio(gain.value)),
        None => cell.metrics.get(metric).map(|i| format::interval(i).value).unwrap_or_default(),
    };
    let tied = view.tied(scene, spp, metric, label);
    let (with, about) = match tied.len() {
        0 => (String::new(), String::new()),
        n => (format!("tied with {n}"), format!("Not distinguishable from {}", tied.join(", "))),
    };
    let aside = shown::joined(&[so_far, &how_far, &with], " · ");
    Some(TableCell { number: gain, ..view.row_cell(label).aside(aside).about(about) })
}

/// How many times below plain Monte Carlo's error; nothing if it is not below, as of plain Monte Carlo itself.
fn gain(cell: &CellSummary, metric: &str) -> Option<Number> {
    let below = |r: &&Interval| r.value > 0.0 && r.value < 1.0;
    let ratio = cell.ratio_to_mc.get(metric).filter(below)?;
    let end = |end: Option<f64>| end.filter(|v| *v > 0.0).map(|v| 1.0 / v);
    Some(Number { value: 1.0 / ratio.value, low: end(ratio.high), high: end(ratio.low), below: None })
}
