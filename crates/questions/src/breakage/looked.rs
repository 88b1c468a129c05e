//! Whether somebody looked before there were as many replicates.

use std::collections::BTreeSet;

use noisefloor_study::context::Context;
use noisefloor_study::look::Look;
use noisefloor_study::record::Record;
use noisefloor_study::summary::{Warning, WarningKind};

/// A sentence if replicates were added after the study had been analysed with fewer.
pub(super) fn warning(context: &Context, records: &[Record]) -> Option<Warning> {
    let now = Look::of(context.planned(), records, String::new());
    let outgrown = context.looks.iter().map(|look| (look, look.outgrown(&now)));
    let grown: Vec<(&Look, BTreeSet<u32>)> = outgrown.filter(|(_, numbers)| !numbers.is_empty()).collect();
    if grown.is_empty() {
        return None;
    }
    let told: Vec<String> = grown
        .iter()
        .map(|(look, numbers)| {
            let numbers: Vec<String> = numbers.iter().map(u32::to_string).collect();
            format!("{} ({})", numbers.join(", "), look.date)
        })
        .collect();
    Some(Warning::new(
        WarningKind::Looked,
        format!(
            "numbers of replicates grew after a look at {}: 95 % intervals hold for a number fixed beforehand",
            told.join(" and at ")
        ),
    ))
}
