//! A table as the template reads it.

use noisefloor_study::exhibit::{Column, Forest, RowState, Table, TableCell, TableRow, Tag, Tone};
use serde::Serialize;

/// A column of texts with one longer than this holds sentences.
const SENTENCE: usize = 36;

/// A table.
#[derive(Debug, Serialize)]
pub(super) struct TableView<'a> {
    /// Name of its files in `tables/`, without extension.
    name: String,
    caption: &'a str,
    columns: Vec<ColumnView<'a>>,
    rows: Vec<RowView<'a>>,
    notes: &'a [String],
}

#[derive(Debug, Serialize)]
struct ColumnView<'a> {
    head: &'a str,
    class: String,
}

#[derive(Debug, Serialize)]
struct RowView<'a> {
    class: &'static str,
    cells: Vec<CellView<'a>>,
}

#[derive(Debug, Serialize)]
struct CellView<'a> {
    text: &'a str,
    aside: &'a str,
    row: Option<usize>,
    tag: Option<&'a Tag>,
    about: &'a str,
    forest: Option<Forest>,
    /// Whether the column has small axes, so that this cell keeps the room of one.
    axis: bool,
    class: String,
    /// Columns that it takes.
    span: usize,
}

impl<'a> TableView<'a> {
    pub(super) fn of(table: &'a Table, name: String) -> Self {
        let width = table.rows.iter().map(|r| r.cells.len()).max().unwrap_or(0).max(table.columns.len());
        let kinds: Vec<Kind> = (0..width).map(|at| Kind::of(table, at)).collect();
        let columns = table.columns.iter().zip(&kinds);
        Self {
            name,
            caption: &table.caption,
            columns: columns.map(|(c, kind)| ColumnView { head: &c.head, class: kind.class() }).collect(),
            rows: table.rows.iter().map(|row| view(row, &kinds)).collect(),
            notes: &table.notes,
        }
    }
}

/// What all cells of a column have in common.
struct Kind {
    text: bool,
    long: bool,
    chosen: bool,
    axis: bool,
}

impl Kind {
    fn of(table: &Table, at: usize) -> Self {
        // A text that spans the rest of its row says nothing about the column that it begins in.
        let whole = |row: &&TableRow| row.cells.len() > at + 1 || row.cells.len() >= table.columns.len();
        let cells = || table.rows.iter().filter(whole).filter_map(|row| row.cells.get(at));
        let letters = |cell: &TableCell| cell.text.chars().count() + cell.aside.chars().count();
        let column = table.columns.get(at);
        let is = |of: fn(&Column) -> bool| column.is_some_and(of);
        let text = is(|c| c.text);
        Self {
            text,
            long: text && at > 0 && cells().map(letters).max().unwrap_or(0) > SENTENCE,
            chosen: is(|c| c.chosen),
            axis: cells().any(|cell| cell.forest.is_some()),
        }
    }

    fn class(&self) -> String {
        let named = [(self.text, "text"), (self.long, "long"), (self.chosen, "chosen")];
        named.iter().filter(|(is, _)| *is).map(|(_, name)| *name).collect::<Vec<_>>().join(" ")
    }
}

fn view<'a>(row: &'a TableRow, kinds: &[Kind]) -> RowView<'a> {
    let last = row.cells.len().saturating_sub(1);
    let cells = row.cells.iter().zip(kinds).enumerate().map(|(at, (cell, kind))| {
        let span = if at == last { kinds.len() - at } else { 1 };
        let mut class = if span > 1 { "text span".to_owned() } else { kind.class() };
        match cell.tone {
            Tone::Plain => {}
            Tone::Good => class += " good",
            Tone::Bad => class += " bad",
        }
        CellView {
            text: &cell.text,
            aside: &cell.aside,
            row: cell.row,
            tag: cell.tag.as_ref(),
            about: &cell.about,
            forest: cell.forest,
            axis: kind.axis && span == 1,
            class: class.trim().to_owned(),
            span,
        }
    });
    let class = match row.state {
        RowState::Plain => "",
        RowState::Best => "best",
        RowState::Absent => "absent",
    };
    RowView { class, cells: cells.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let rows = vec![
            TableRow::new(vec![TableCell::text("a"), TableCell::count(3), TableCell::text("short")]),
            TableRow::new(vec![
                TableCell::text("b"),
                TableCell::text("a reason that goes on to the end of the row"),
            ]),
        ];
        let columns = vec![Column::text("Row"), Column::number("n"), Column::text("Why")];
        Table { id: "t".into(), columns, rows, ..Table::default() }
    }

    #[test]
    fn the_last_cell_of_a_short_row_spans_the_rest() {
        let table = table();
        let view = TableView::of(&table, "t".into());
        let spans = |row: usize| view.rows[row].cells.iter().map(|c| c.span).collect::<Vec<_>>();
        assert_eq!((spans(0), spans(1)), (vec![1, 1, 1], vec![1, 2]));
        assert_eq!(view.rows[1].cells[1].class, "text span");
        assert_eq!(view.columns[1].class, "", "a spanning text does not make its column one of texts");
        assert_eq!(view.columns[2].class, "text");
    }

    #[test]
    fn a_column_with_a_sentence_is_wide() {
        let mut table = table();
        table.rows[0].cells[2] = TableCell::text("a sentence that a narrow column would break to pieces");
        table.columns[2].chosen = true;
        assert_eq!(TableView::of(&table, "t".into()).columns[2].class, "text long chosen");
    }
}
