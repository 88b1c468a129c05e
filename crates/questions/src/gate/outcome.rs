//! What a gate found, for people and programs.

use noisefloor_stats::{Answer, Gate, Judgement, Terms};
use serde::Serialize;

use crate::gate::changes::{Broken, Changes};

/// What a gate says in one word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Overall {
    /// All numbers are the same, bit by bit.
    Same,
    /// Something changed, and nothing was found to be worse: everything is better, within the margin or the same.
    Passed,
    /// Nothing was found to be worse, but of some cells or rows nothing can be told.
    CannotBeTold,
    /// A row, or a row on some scene at some level, is worse or does not run any more.
    Worse,
}

/// A row over all its cells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RowChange {
    /// Label of the row.
    pub label: String,
    /// What is said of its mean log ratio over the cells.
    #[serde(flatten)]
    pub judged: Judgement,
    /// Cells that are better.
    pub better: usize,
    /// Cells that are worse.
    pub worse: usize,
    /// Cells of which nothing can be told.
    pub untold: usize,
    /// Median over its cells of the smallest ratio that each could have told; absent where no cell has one.
    pub smallest_told_in_a_cell: Option<f64>,
}

/// A row on a scene at a level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CellChange {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Label of the row.
    pub label: String,
    /// What is said of it.
    #[serde(flatten)]
    pub judged: Judgement,
}

/// What a gate found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GateOutcome {
    /// In one word.
    pub overall: Overall,
    /// Metric compared.
    pub metric: String,
    /// Largest chance of any false "better" or "worse".
    pub alpha: f64,
    /// Relative change that does not matter.
    pub margin: f64,
    /// By row.
    pub rows: Vec<RowChange>,
    /// By scene, level and row.
    pub cells: Vec<CellChange>,
    /// Cells that do not run any more.
    pub broken: Vec<Broken>,
    /// What was left out.
    pub notes: Vec<String>,
}

pub(super) fn outcome(found: Changes, gate: Gate, metric: &str, terms: Terms) -> GateOutcome {
    let cells: Vec<CellChange> = found
        .cells
        .into_iter()
        .zip(gate.cells)
        .map(|(cell, judged)| CellChange { scene: cell.scene, spp: cell.spp, label: cell.label, judged })
        .collect();
    let rows: Vec<RowChange> =
        found.labels.into_iter().zip(gate.rows).map(|(label, judged)| row(label, judged, &cells)).collect();
    let all = || rows.iter().map(|row| row.judged.answer).chain(cells.iter().map(|cell| cell.judged.answer));
    let any = |answer: Answer| all().any(|found| found == answer);
    let overall = if any(Answer::Worse) || !found.broken.is_empty() {
        Overall::Worse
    } else if any(Answer::CannotBeTold) || rows.is_empty() {
        Overall::CannotBeTold
    } else if all().all(|answer| answer == Answer::Same) {
        Overall::Same
    } else {
        Overall::Passed
    };
    GateOutcome {
        overall,
        metric: metric.to_owned(),
        alpha: terms.level.alpha(),
        margin: terms.margin,
        rows,
        cells,
        broken: found.broken,
        notes: found.notes,
    }
}

fn row(label: String, judged: Judgement, cells: &[CellChange]) -> RowChange {
    let mine = || cells.iter().filter(|cell| cell.label == label).map(|cell| &cell.judged);
    let count = |answer: Answer| mine().filter(|judged| judged.answer == answer).count();
    RowChange {
        better: count(Answer::Better),
        worse: count(Answer::Worse),
        untold: count(Answer::CannotBeTold),
        smallest_told_in_a_cell: crate::records::median(mine().filter_map(|judged| judged.smallest_told)),
        judged,
        label,
    }
}
