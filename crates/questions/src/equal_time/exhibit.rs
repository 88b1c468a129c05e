//! What a reader sees.

use noisefloor_study::exhibit::{Column, Exhibit, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::EqualTime;

use crate::view::View;

const NOTE: &str = "Rows that get as much time as another row takes with its denoising. The samples used stand in the study; the \
    samples implied are what the median times of this run would buy: the level, and the other row's denoising time over the time of \
    one plain sample in every pixel (of an adaptive row all its time).";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    if view.summary.equal_time.is_empty() {
        return Vec::new();
    }
    let columns = vec![
        Column::text("Scene"),
        Column::number("spp").unit("spp"),
        Column::text("Row"),
        Column::text("As much time as"),
        Column::number("Samples used").unit("spp"),
        Column::number("Implied by this run").unit("spp"),
        Column::number("Denoising").unit("s"),
        Column::number("One sample in every pixel").unit("s"),
    ];
    let row = |e: &EqualTime| {
        TableRow::new(vec![
            TableCell::text(&e.scene),
            TableCell::count(e.spp.into()),
            view.row_cell(&e.label),
            view.row_cell(&e.with),
            TableCell::count(e.used.into()),
            implied(e),
            milliseconds(Some(e.denoise_seconds)),
            milliseconds(e.seconds_per_sample),
        ])
    };
    let rows = view.summary.equal_time.iter().map(row).collect();
    let table = Table { id: "equal-time".into(), columns, rows, ..Table::default() };
    vec![Exhibit {
        id: "equal-time".into(),
        name: "Equal time".into(),
        title: "Equal time".into(),
        parts: vec![Part::Note(NOTE.into()), Part::Table(table)],
    }]
}

/// Samples per pixel that the times of this run would buy.
pub(super) fn implied(e: &EqualTime) -> TableCell {
    e.implied
        .map_or_else(TableCell::none, |n| TableCell::text(format::significant(n, 3)).number(Number::exact(n)))
}

/// A time in one unit for the whole table, so that its rows can be divided by each other in the head.
pub(super) fn milliseconds(seconds: Option<f64>) -> TableCell {
    let text = |s: f64| format!("{} ms", format::significant(1000.0 * s, 3));
    seconds.map_or_else(TableCell::none, |s| TableCell::text(text(s)).number(Number::exact(s)))
}
