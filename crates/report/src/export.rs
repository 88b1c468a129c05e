//! Tables and charts as files: for papers, spreadsheets and programs.

mod csv;
mod latex;
mod markdown;
mod text;

use std::fs;
use std::path::{Path, PathBuf};

use noisefloor_study::exhibit::Document;

use crate::charts::{Charts, Formats};
use crate::error::ReportError;
use crate::file::write_file;
use crate::names::{TABLE_ENDINGS, table_names};

pub use markdown::markdown;

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
