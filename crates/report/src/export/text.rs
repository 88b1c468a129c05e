//! Cells as a reader sees them.

use noisefloor_study::exhibit::Table;

/// Whether a cell's text says that there is nothing.
pub(super) fn says_nothing(text: &str) -> bool {
    matches!(text.trim(), "" | "–" | "—" | "-" | "−")
}

/// A text in one line.
pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Rows of texts as a reader sees them, as many as there are columns, each cell with its remark and word.
pub(super) fn shown(table: &Table) -> Vec<Vec<String>> {
    let cell = |cell: &noisefloor_study::exhibit::TableCell| {
        let tag = cell.tag.as_ref().map_or("", |tag| tag.word.as_str());
        let parts = [cell.text.as_str(), cell.aside.as_str(), tag];
        one_line(&parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" "))
    };
    table.rows.iter().map(|row| row.cells.iter().map(cell).collect()).collect()
}
