//! What a gate found, for people.

use noisefloor_questions::{CellChange, GateOutcome, Overall};
use noisefloor_stats::{Answer, Effect, Judgement};

use crate::table::aligned;

/// The word for an answer.
fn word(answer: Answer) -> &'static str {
    match answer {
        Answer::Same => "same",
        Answer::WithinMargin => "within margin",
        Answer::Better => "better",
        Answer::Worse => "WORSE",
        Answer::CannotBeTold => "cannot be told",
    }
}

/// A table of rows, the cells that changed, and one sentence.
pub fn text(found: &GateOutcome) -> String {
    let mut rows =
        vec![heads(&["row", "answer", "new/old", "cells", "better", "worse", "told from", "in a cell from"])];
    for row in &found.rows {
        rows.push(vec![
            row.label.clone(),
            word(row.judged.answer).into(),
            row.judged.effect.as_ref().map_or_else(dash, effect),
            row.judged.cells.to_string(),
            row.better.to_string(),
            row.worse.to_string(),
            smallest(row.judged.smallest_told),
            smallest(row.smallest_told_in_a_cell),
        ]);
    }
    let mut out = format!("{}, new over old, geometric mean over cells and replicates\n\n", found.metric);
    out.push_str(&aligned(&rows));
    let changed: Vec<&CellChange> = found
        .cells
        .iter()
        .filter(|cell| matches!(cell.judged.answer, Answer::Better | Answer::Worse))
        .collect();
    if !changed.is_empty() {
        let mut rows = vec![heads(&["cell", "answer", "new/old", "adjusted p"])];
        rows.extend(changed.into_iter().map(cell));
        out.push_str(&format!("\n{}", aligned(&rows)));
    }
    for broken in &found.broken {
        out.push_str(&format!(
            "! {} on {} at {} spp: {}\n",
            broken.label, broken.scene, broken.spp, broken.reason
        ));
    }
    for note in &found.notes {
        out.push_str(&format!("! {note}\n"));
    }
    out.push_str(&format!("\n{}\n", sentence(found)));
    out
}

fn heads(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn dash() -> String {
    "–".into()
}

fn cell(cell: &CellChange) -> Vec<String> {
    let Judgement { answer, effect: found, p_adjusted, .. } = &cell.judged;
    vec![
        format!("{} on {} at {}", cell.label, cell.scene, cell.spp),
        word(*answer).into(),
        found.as_ref().map_or_else(dash, effect),
        format!("{p_adjusted:.2e}"),
    ]
}

/// A ratio or difference with its interval.
fn effect(found: &Effect) -> String {
    let interval = &found.interval;
    let kind = if found.is_ratio { "" } else { " (difference)" };
    match (interval.low, interval.high) {
        (Some(low), Some(high)) if found.is_ratio => {
            format!("{:.4} [{low:.4}, {high:.4}]", interval.value)
        }
        (Some(low), Some(high)) => format!("{:.3e} [{low:.3e}, {high:.3e}]{kind}", interval.value),
        _ => format!("{:.4}{kind}", interval.value),
    }
}

/// The smallest change that would have been told, as a percentage.
fn smallest(ratio: Option<f64>) -> String {
    ratio.map_or_else(dash, |ratio| match 100.0 * (ratio - 1.0) {
        percent if percent >= 1000.0 => format!("{ratio:.0} times"),
        percent => format!("{percent:.2} %"),
    })
}

fn sentence(found: &GateOutcome) -> String {
    let alpha = 100.0 * found.alpha;
    let chance = format!("any false answer in {alpha:.3} % of such gates at most");
    match found.overall {
        Overall::Same => "same: all numbers are equal, bit by bit".into(),
        Overall::Passed => format!("passed: nothing is worse ({chance})"),
        Overall::CannotBeTold => format!(
            "nothing is found to be worse, but not everything can be told: half of such gates would see a change as large as \
             `told from` ({chance})"
        ),
        Overall::Worse => format!("worse ({chance})"),
    }
}
