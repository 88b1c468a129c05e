//! Tables: texts for people, and the numbers behind them for programs.

use serde::{Deserialize, Serialize};

use crate::summary::Interval;

/// A table.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Table {
    /// Name of its exported files: letters, digits, `-`, `_` and `.`.
    pub id: String,
    /// What stands above it; may be empty.
    pub caption: String,
    /// Columns, the first of which names the rows.
    pub columns: Vec<Column>,
    /// Rows.
    pub rows: Vec<TableRow>,
    /// Sentences below it.
    pub notes: Vec<String>,
}

/// A column.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Column {
    /// What stands above it, for people.
    pub head: String,
    /// Unit of its numbers as they are exported, such as `s` or `spp`; empty for texts and numbers without one.
    pub unit: String,
    /// Whether it holds sentences or names, set to the left, instead of numbers.
    pub text: bool,
    /// Whether it stands out: the level that a reader sees first.
    pub chosen: bool,
}

impl Column {
    /// A column of numbers.
    #[must_use]
    pub fn number(head: impl Into<String>) -> Self {
        Self { head: head.into(), ..Self::default() }
    }

    /// A column of texts.
    #[must_use]
    pub fn text(head: impl Into<String>) -> Self {
        Self { head: head.into(), text: true, ..Self::default() }
    }

    /// With a unit for exports.
    #[must_use]
    pub fn unit(self, unit: impl Into<String>) -> Self {
        Self { unit: unit.into(), ..self }
    }
}

/// A row.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct TableRow {
    /// One cell for each column, or fewer where the last one spans the rest.
    pub cells: Vec<TableCell>,
    /// How it stands among the others.
    pub state: RowState,
}

impl TableRow {
    /// A row like any other.
    #[must_use]
    pub fn new(cells: Vec<TableCell>) -> Self {
        Self { cells, state: RowState::Plain }
    }
}

/// How a row stands among the others.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RowState {
    /// Like any other.
    #[default]
    Plain,
    /// The best, or not distinguishable from it.
    Best,
    /// Has no numbers.
    Absent,
}

/// A cell.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct TableCell {
    /// For people.
    pub text: String,
    /// Its uncertainty or a remark, for people, in small type; may be empty.
    pub aside: String,
    /// For programs.
    pub number: Option<Number>,
    /// Place of the study's row that it names, whose look stands before it.
    pub row: Option<usize>,
    /// A word behind it.
    pub tag: Option<Tag>,
    /// What is shown on demand; may be empty.
    pub about: String,
    /// A small interval on an axis that all rows share.
    pub forest: Option<Forest>,
    /// What it says of a promise.
    pub tone: Tone,
}

impl TableCell {
    /// Text alone.
    #[must_use]
    pub fn text(text: impl Into<String>) -> Self {
        Self { text: text.into(), ..Self::default() }
    }

    /// The name of a row of the study.
    #[must_use]
    pub fn row(label: impl Into<String>, row: usize) -> Self {
        Self { text: label.into(), row: Some(row), ..Self::default() }
    }

    /// A whole number.
    #[must_use]
    pub fn count(count: u64) -> Self {
        Self { text: count.to_string(), number: Some(Number::exact(count as f64)), ..Self::default() }
    }

    /// Nothing is known here.
    #[must_use]
    pub fn none() -> Self {
        Self::text("–")
    }

    /// With something to be shown on demand.
    #[must_use]
    pub fn about(self, about: impl Into<String>) -> Self {
        Self { about: about.into(), ..self }
    }

    /// With a remark in small type.
    #[must_use]
    pub fn aside(self, aside: impl Into<String>) -> Self {
        Self { aside: aside.into(), ..self }
    }

    /// With a word behind it.
    #[must_use]
    pub fn tag(self, word: impl Into<String>, tone: Tone, about: impl Into<String>) -> Self {
        Self { tag: Some(Tag { word: word.into(), tone, about: about.into() }), ..self }
    }

    /// With what it says of a promise.
    #[must_use]
    pub fn tone(self, tone: Tone) -> Self {
        Self { tone, ..self }
    }

    /// With the number behind it.
    #[must_use]
    pub fn number(self, number: Number) -> Self {
        Self { number: Some(number), ..self }
    }
}

/// A number with the ends of its interval, unrounded.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Number {
    /// Point estimate.
    pub value: f64,
    /// Lower end, where known.
    pub low: Option<f64>,
    /// Upper end, where known.
    pub high: Option<f64>,
    /// The estimate is below what can be shown: this is an upper limit.
    pub below: Option<f64>,
}

impl Number {
    /// Without uncertainty.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self { value, low: None, high: None, below: None }
    }
}

impl From<&Interval> for Number {
    fn from(interval: &Interval) -> Self {
        Self { value: interval.value, low: interval.low, high: interval.high, below: interval.below }
    }
}

/// A word in a frame.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Tag {
    /// The word.
    pub word: String,
    /// How it sounds.
    pub tone: Tone,
    /// What it means, on demand; may be empty.
    pub about: String,
}

/// How something sounds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// Neither good nor bad.
    #[default]
    Plain,
    /// Tested and held.
    Good,
    /// Tested and broken.
    Bad,
}

/// Positions in percent along a small logarithmic axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Forest {
    /// Where 1 is.
    pub one: f64,
    /// Where the value is.
    pub at: f64,
    /// Where its interval begins.
    pub low: f64,
    /// How wide its interval is.
    pub width: f64,
}
