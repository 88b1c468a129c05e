//! Which builds of the program ran the cells.

use std::collections::BTreeMap;

use noisefloor_study::record::{Outcome, Record};
use noisefloor_study::summary::{Warning, WarningKind};

/// A sentence if finished cells are of several builds. Their methods and metrics gave the same numbers on fixed inputs, or
/// the cells would not stand beside each other; their times may differ.
pub(super) fn warning(records: &[Record]) -> Option<Warning> {
    let mut rows: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for record in records.iter().filter(|record| record.outcome == Outcome::Done) {
        let of_build = rows.entry(&record.build).or_default();
        if !of_build.contains(&record.label.as_str()) {
            of_build.push(&record.label);
        }
    }
    if rows.len() < 2 {
        return None;
    }
    let told: Vec<String> = rows
        .iter()
        .map(|(build, labels)| {
            let build = if build.is_empty() { "an unnamed one" } else { build };
            format!("{build} ({})", labels.join(", "))
        })
        .collect();
    Some(Warning::new(
        WarningKind::Builds,
        format!(
            "rows come from {} builds of the program, which agree on what methods and metrics give; times may differ: {}",
            rows.len(),
            told.join(", ")
        ),
    ))
}
