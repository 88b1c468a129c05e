//! Tables and charts as files: for papers, spreadsheets and programs.

mod csv;
mod latex;
mod markdown;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use noisefloor_study::exhibit::{Document, Table};

use crate::charts::{Charts, Formats};
use crate::error::ReportError;
use crate::write::write_file;

pub use markdown::markdown;

/// Endings of a table's files.
pub(crate) const TABLE_ENDINGS: [&str; 4] = ["csv", "json", "tex", "md"];

/// Writes every table and every chart of a document: `dir/tables/ID.csv`, `.json`, `.tex`, `.md` and
/// `dir/charts/ID.svg`, `.png`, `.pdf`. Gives the files in the order of the document.
///
/// # Errors
/// As [`export_tables`] and [`export_charts`].
pub fn export(document: &Document, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    let mut files = export_tables(document, &dir.join("tables"))?;
    files.extend(export_charts(document, &dir.join("charts"))?);
    Ok(files)
}

/// Writes every table of a document into a folder, in four formats:
///
/// * `ID.csv` by RFC 4180, with numbers in full precision, the unit in the head, and the ends of intervals in columns
///   `… low` and `… high`;
/// * `ID.json`, the table with the numbers behind its texts;
/// * `ID.tex`, a `booktabs` tabular that compiles on its own;
/// * `ID.md`, a pipe table.
///
/// # Errors
/// [`ReportError::Write`] and [`ReportError::Io`] if the folder cannot be written, [`ReportError::Table`] if a table has
/// no JSON.
pub fn export_tables(document: &Document, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    fs::create_dir_all(dir).map_err(ReportError::write(dir))?;
    let tables = document.tables();
    let mut files = Vec::new();
    for (table, name) in tables.iter().zip(table_names(document)) {
        let json = serde_json::to_string_pretty(table);
        let json = json.map_err(|source| ReportError::Table { name: name.clone(), source })? + "\n";
        let contents = [csv::csv(table), json, latex::latex(table, &document.study), markdown::file(table)];
        for (ending, text) in TABLE_ENDINGS.iter().zip(contents) {
            let path = dir.join(format!("{name}.{ending}"));
            write_file(&path, text.as_bytes())?;
            files.push(path);
        }
    }
    Ok(files)
}

/// Writes every chart of a document into a folder: `ID.svg`, `ID.png` at 300 dpi and `ID.pdf`.
///
/// # Errors
/// [`ReportError::Write`] and [`ReportError::Io`] if the folder cannot be written, [`ReportError::Plot`] and
/// [`ReportError::Png`] if a chart cannot be drawn.
pub fn export_charts(document: &Document, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    Charts::draw(document, None)?.write(dir, Formats::ALL)
}

/// Names of the files of a document's tables, in the order of [`Document::tables`].
pub(crate) fn table_names(document: &Document) -> Vec<String> {
    let mut taken = BTreeSet::new();
    document.tables().iter().map(|table| free_name(&table.id, &mut taken)).collect()
}

/// An id as the name of a file: letters, digits, `-`, `_` and `.` inside, and taken by nothing else.
pub(crate) fn free_name(id: &str, taken: &mut BTreeSet<String>) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '-' };
    let name: String = id.chars().map(plain).take(120).collect();
    // No hidden file, no folder above.
    let name = match name.trim_start_matches('.') {
        "" => "unnamed".to_owned(),
        name => name.to_owned(),
    };
    let numbered = (2..).map(|n| format!("{name}-{n}"));
    let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
    let free = free.unwrap_or(name);
    taken.insert(free.clone());
    free
}

/// Whether a cell's text says that there is nothing.
fn says_nothing(text: &str) -> bool {
    matches!(text.trim(), "" | "–" | "—" | "-" | "−")
}

/// A text in one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Rows of texts as a reader sees them, as many as there are columns, each cell with its remark and word.
fn shown(table: &Table) -> Vec<Vec<String>> {
    let cell = |cell: &noisefloor_study::exhibit::Cell| {
        let tag = cell.tag.as_ref().map_or("", |tag| tag.word.as_str());
        let parts = [cell.text.as_str(), cell.aside.as_str(), tag];
        one_line(&parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" "))
    };
    table.rows.iter().map(|row| row.cells.iter().map(cell).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_id_becomes_a_name_of_its_own_inside_the_folder() {
        let mut taken = BTreeSet::new();
        let names =
            ["cells-4", "cells-4", "../../etc/passwd", "", "ä b", ".."].map(|id| free_name(id, &mut taken));
        assert_eq!(names, ["cells-4", "cells-4-2", "-..-etc-passwd", "unnamed", "--b", "unnamed-2"]);
    }
}
