//! Tables of a study inside a README.
//!
//! | kind | shows | keys |
//! | --- | --- | --- |
//! | `answers` | the first screen's sentences | |
//! | `levels` | a table per scene: levels down, rows of the study across | `metric`, `show`, `scenes`, `spp`, `rows` |
//! | `methods` | rows of the study down, scenes and levels across | the same |
//! | `coverage` | coverage of the input's intervals, per scene | `scenes`, `spp` |
//! | `bounds` | violations of error bounds, per scene | `scenes`, `spp`, `rows` |
//! | `slopes` | slopes and verdicts | `metric`, `scenes`, `rows` |
//! | `paper` | ratios beside the source work's | |
//! | `equal-time` | samples for equal time | |
//! | `estimates` | methods' estimates of their own error | `scenes`, `spp`, `rows` |
//! | `flicker` | errors that change from frame to frame | |
//! | `absent` | rows that did not run or are not ranked, with the reason | |
//! | `machine` | cells, processor, build, load and date | |
//!
//! `show` is `value`, `ratio` (to plain Monte Carlo) or `multiplier` (samples for an equal error); lists are split at `;`.
//! Every kind but `answers` and `machine` belongs to a question.

mod chosen;
mod common;

use std::collections::BTreeMap;

use noisefloor_study::exhibit::{Cell, Column, Table, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::Summary;

pub(crate) use chosen::{Chosen, Show};

use crate::question::QUESTIONS;
use crate::view::View;

/// What a README asks for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Asked {
    /// Kind of table, such as `levels`.
    pub kind: String,
    /// What is chosen of the study.
    pub keys: BTreeMap<String, String>,
}

impl Asked {
    /// The value of a key, split at `;` and trimmed; empty without the key.
    #[must_use]
    pub fn list(&self, key: &str) -> Vec<&str> {
        self.keys.get(key).map_or_else(Vec::new, |text| text.split(';').map(str::trim).collect())
    }
}

/// A piece of a README; texts, also those of cells, are Markdown.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A paragraph or a list.
    Text(String),
    /// A table.
    Table(Table),
}

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

/// Makes what a README asks for, in order.
///
/// # Errors
/// A clause for people, if the study has nothing of this name.
pub fn readme_table(summary: &Summary, asked: &Asked) -> Result<Vec<Block>, String> {
    let view = View::new(summary);
    let kinds = || QUESTIONS.iter().flat_map(|question| question.readme()).chain(common::KINDS);
    let kind = kinds()
        .find(|kind| kind.name == asked.kind)
        .ok_or_else(|| format!("there is no table `{}`", asked.kind))?;
    if let Some(key) = asked.keys.keys().find(|key| !kind.keys.contains(&key.as_str())) {
        let has = if kind.keys.is_empty() { "none".into() } else { format::list(kind.keys) };
        return Err(format!("`{}` has no key `{key}`; it has {has}", asked.kind));
    }
    Ok((kind.make)(&Chosen::new(&view, asked)?))
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
pub(crate) fn push(table: &mut Table, cells: Vec<Cell>) {
    table.rows.push(TableRow::new(cells));
}

/// A cell of a page as one text. A star in Markdown text is one that is not obeyed.
pub(crate) fn plain(cell: &Cell) -> Cell {
    let text = format!("{} {}", cell.text, cell.aside);
    let text = text.trim_end().replace(" *", " \\*");
    Cell { number: cell.number, ..Cell::text(text) }
}

/// The name of a row or a parameter.
pub(crate) fn code(name: &str) -> Cell {
    Cell::text(format!("`{name}`"))
}
