use noisefloor_study::exhibit::{Column, Part, RowState, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::Skipped;

use crate::view::View;

/// Rows that did not run somewhere, with the reason; nothing if all did.
pub(super) fn parts(view: &View<'_>) -> Vec<Part> {
    let skipped = &view.summary.skipped;
    if skipped.is_empty() {
        return Vec::new();
    }
    let row = |s: &Skipped| TableRow {
        cells: vec![
            TableCell::text(view.scene_title(&s.scene)),
            view.row_cell(&s.label),
            TableCell::text(format::list(&s.spp.iter().map(u32::to_string).collect::<Vec<_>>())),
            TableCell::text(s.status.name()),
            TableCell::text(&s.reason),
        ],
        state: RowState::Absent,
    };
    let table = Table {
        id: "failures".into(),
        columns: ["Scene", "Method", "spp", "Status", "Why"].map(Column::text).to_vec(),
        rows: skipped.iter().map(row).collect(),
        ..Table::default()
    };
    vec![Part::Heading("Rows that did not run".into()), Part::Table(table)]
}
