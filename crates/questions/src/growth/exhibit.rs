//! What a reader sees.

use noisefloor_study::exhibit::{Column, Exhibit, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::Interval;

use super::ID;
use super::analyse::Finding;
use crate::answers;
use crate::view::View;

const NOTE: &str = "Pixels whose squared error is larger after filtering than before, as shares of the pixels; what growth \
    adds and what shrinking takes away, as shares of the input's squared error. A right filter, too, makes pixels worse whose \
    noise happened to be small: what growth adds is the harm.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let found: Vec<Finding> = answers::read(&view.summary.answers, ID).unwrap_or_default();
    let mut parts = vec![Part::Note(NOTE.into())];
    for (scene, name) in view.summary.scenes.iter().zip(view.file_names()) {
        let rows: Vec<TableRow> =
            found.iter().filter(|f| f.scene == scene.id).map(|f| row(view, f)).collect();
        if !rows.is_empty() {
            let columns = vec![
                Column::number("spp").unit("spp"),
                Column::text("Method"),
                Column::number("Pixels that grew"),
                Column::number("surely"),
                Column::number("Error added"),
                Column::number("Error taken away"),
            ];
            parts.push(Part::Heading(scene.title.clone()));
            parts.push(Part::Table(Table {
                id: format!("growth-{name}"),
                columns,
                rows,
                ..Table::default()
            }));
        }
    }
    if parts.len() == 1 {
        return Vec::new();
    }
    let title = "Pixels that a filter makes worse".into();
    vec![Exhibit { id: ID.into(), name: "Growth".into(), title, parts }]
}

fn row(view: &View<'_>, f: &Finding) -> TableRow {
    let percent = |i: &Interval| {
        let shown = format::percent_interval(i);
        TableCell::text(shown.value).aside(shown.spread).number(Number::from(i))
    };
    // What growth adds can be more than all there was.
    let share = |i: &Interval| {
        TableCell::text(format::percent(i.value))
            .aside(format::bracket(i, format::percent))
            .number(Number::from(i))
    };
    TableRow::new(vec![
        TableCell::count(f.spp.into()),
        view.row_cell(&f.label),
        percent(&f.grew),
        f.surely.as_ref().map_or_else(TableCell::none, percent),
        share(&f.added),
        share(&f.removed),
    ])
}
