//! What a reader sees.

use noisefloor_study::exhibit::{Column, Exhibit, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::FlickerSummary;

use crate::shown;
use crate::view::{View, file_name};

const NOTE: &str = "Unbiased variance over the frames of the error of each pixel and channel, averaged over these. An error that \
    stays the same in every frame does not flicker; one that moves with the picture does. The squared error of the same frames \
    stands beside it: it contains both.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let tables = tables(view);
    if tables.is_empty() {
        return Vec::new();
    }
    vec![Exhibit {
        id: "flicker".into(),
        name: "Flicker".into(),
        title: "Flicker: errors that change from frame to frame".into(),
        parts: std::iter::once(Part::Note(NOTE.into())).chain(tables.into_iter().map(Part::Table)).collect(),
    }]
}

/// One table per sequence, in the order of the summary.
fn tables(view: &View<'_>) -> Vec<Table> {
    let mut out: Vec<(&str, Table)> = Vec::new();
    for f in &view.summary.flicker {
        let cells = vec![
            TableCell::count(f.spp.into()),
            view.row_cell(&f.label),
            shown::value(&f.variance),
            ratio(f).about(format!("Over that of {}", f.first)),
            shown::value(&f.squared_error),
        ];
        match out.iter_mut().find(|(sequence, _)| *sequence == f.sequence) {
            Some((_, table)) => table.rows.push(TableRow::new(cells)),
            None => out.push((&f.sequence, Table { rows: vec![TableRow::new(cells)], ..empty(f) })),
        }
    }
    out.into_iter().map(|(_, table)| table).collect()
}

fn empty(f: &FlickerSummary) -> Table {
    let note = match f.reference_variance {
        Some(0.0) => "The truth is exact: nothing was subtracted.".into(),
        Some(variance) => format!(
            "{} was subtracted: the references' own noise, the mean of their variances.",
            format::significant(variance, 2)
        ),
        None => {
            "A reference states no variance: its own noise was not subtracted and counts as flicker.".into()
        }
    };
    Table {
        id: format!("flicker-{}", file_name(&f.sequence)),
        caption: format!("Sequence {}, {} frames", f.sequence, f.scenes.len()),
        columns: vec![
            Column::number("spp").unit("spp"),
            Column::text("Method"),
            Column::number("Temporal variance of the error"),
            Column::number("Ratio to the first row"),
            Column::number("Squared error"),
        ],
        rows: Vec::new(),
        notes: vec![note],
    }
}

/// The variance over that of the first row.
pub(super) fn ratio(f: &FlickerSummary) -> TableCell {
    match &f.ratio_to_first {
        Some(ratio) => shown::value(ratio),
        None if f.first == f.label => TableCell::text("1").number(Number::exact(1.0)),
        None => TableCell::none(),
    }
}
