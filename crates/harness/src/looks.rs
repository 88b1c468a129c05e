//! `looks.jsonl`: with how many replicates a study was analysed, and when.

use noisefloor_study::context::Context;
use noisefloor_study::look::Look;
use noisefloor_study::record::Record;

use crate::error::HarnessError;
use crate::machine;
use crate::store::{Layout, append_lines};

/// The looks so far; lines that cannot be read are no looks.
pub(crate) fn read(layout: &Layout) -> Vec<Look> {
    let text = std::fs::read_to_string(layout.looks()).unwrap_or_default();
    text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

/// The looks so far and this one, which is written down if the study had not been analysed with these numbers of replicates
/// before.
pub(crate) fn noted(
    layout: &Layout,
    context: &Context,
    records: &[Record],
) -> Result<Vec<Look>, HarnessError> {
    let mut looks = read(layout);
    let now = Look::of(context.planned(), records, machine::now());
    let known = looks.iter().any(|look| look.replicates == now.replicates);
    if !known && !now.replicates.is_empty() {
        let path = layout.looks();
        let line = serde_json::to_vec(&now).map_err(|e| HarnessError::kept(&path, e))?;
        append_lines(&path, [line])?;
        looks.push(now);
    }
    Ok(looks)
}
