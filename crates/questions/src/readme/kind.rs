//! Kinds of tables, and what makes them.

use noisefloor_study::exhibit::{Column, Table, TableCell, TableRow};

use super::asked::Block;
use super::chosen::Chosen;

/// A kind of table.
#[derive(Debug)]
pub struct Kind {
    /// Name.
    pub name: &'static str,
    /// Keys that it obeys.
    pub keys: &'static [&'static str],
    /// What makes it.
    pub(crate) make: fn(&Chosen<'_>) -> Vec<Block>,
}

/// A list, or nothing where it would be empty.
pub(crate) fn lines(lines: Vec<String>) -> Vec<Block> {
    if lines.is_empty() { Vec::new() } else { vec![Block::Text(lines.join("\n"))] }
}

/// A table without rows, with these heads.
pub(crate) fn headed(id: String, heads: impl IntoIterator<Item = String>) -> Table {
    let column = |(k, head)| if k == 0 { Column::text(head) } else { Column::number(head) };
    Table { id, columns: heads.into_iter().enumerate().map(column).collect(), ..Table::default() }
}

/// The same from plain words.
pub(crate) fn headed_by(id: &str, heads: &[&str]) -> Table {
    headed(id.to_owned(), heads.iter().map(|head| (*head).to_owned()))
}

/// Adds a row.
pub(crate) fn push(table: &mut Table, cells: Vec<TableCell>) {
    table.rows.push(TableRow::new(cells));
}

/// A cell of a page as one text. A star in Markdown text is one that is not obeyed.
pub(crate) fn plain(cell: &TableCell) -> TableCell {
    let text = format!("{} {}", cell.text, cell.aside);
    let text = text.trim_end().replace(" *", " \\*");
    TableCell { number: cell.number, ..TableCell::text(text) }
}

/// The name of a row or a parameter.
pub(crate) fn code(name: &str) -> TableCell {
    TableCell::text(format!("`{name}`"))
}
