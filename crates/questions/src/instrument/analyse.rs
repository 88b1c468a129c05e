use noisefloor_frame::FindingKind;
use noisefloor_stats::holm_adjusted;
use noisefloor_study::check::{CheckFound, CheckKind, CheckRecord};
use noisefloor_study::summary::Summary;
use serde::{Deserialize, Serialize};

use super::id::ID;
use crate::records::Index;

/// Rate of false alarms of a report without a fault, all of its checks together.
pub(super) const ALPHA: f64 = 0.01;

/// A check with its p-value beside all others of the report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// The check.
    #[serde(flatten)]
    pub record: CheckRecord,
    /// p-value after Holm's rule over the report's checks; none where nothing could be told.
    pub adjusted: Option<f64>,
    /// Whether it found a fault.
    pub failed: bool,
}

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    let mut records: Vec<CheckRecord> = index.context.self_check.clone();
    for level in index.scenes().iter().flat_map(|scene| &scene.levels) {
        let answer = level.answers.get(ID).cloned();
        records.extend(
            answer.and_then(|v| serde_json::from_value::<Vec<CheckRecord>>(v).ok()).into_iter().flatten(),
        );
    }
    records.extend(identical(summary));
    let p: Vec<f64> = records.iter().filter_map(|record| Some(record.found?.p)).collect();
    let mut adjusted = holm_adjusted(&p).into_iter();
    let checks: Vec<Check> = records
        .into_iter()
        .map(|record| {
            let adjusted = record.found.and_then(|_| adjusted.next());
            Check { failed: adjusted.is_some_and(|p| p <= ALPHA), record, adjusted }
        })
        .collect();
    if let (false, Ok(value)) = (checks.is_empty(), serde_json::to_value(checks)) {
        summary.answers.insert(ID.into(), value);
    }
}

/// Frames, parts or replicates that hold the same numbers or were drawn from the same random numbers.
fn identical(summary: &Summary) -> Vec<CheckRecord> {
    let certain = [FindingKind::EqualData, FindingKind::SharedSeed];
    let found = summary.findings.iter().filter(|finding| certain.contains(&finding.kind));
    found
        .map(|finding| CheckRecord {
            kind: CheckKind::Dependence,
            what: finding.text.clone(),
            scene: finding.subject.clone(),
            spp: None,
            // It cannot happen by chance.
            found: Some(CheckFound { value: 1.0, expected: 0.0, z: f64::MAX, p: 0.0 }),
            note: String::new(),
        })
        .collect()
}

/// The checks of a report.
#[must_use]
pub fn checks(summary: &Summary) -> Vec<Check> {
    let found = summary.answers.get(ID).cloned();
    found.and_then(|value| serde_json::from_value(value).ok()).unwrap_or_default()
}

/// Checks that found a fault, in sentences; a run with one has failed.
#[must_use]
pub fn failed_checks(summary: &Summary) -> Vec<String> {
    checks(summary).iter().filter(|check| check.failed).map(sentence).collect()
}

/// Check, scene, level and size.
pub(super) fn sentence(check: &Check) -> String {
    let record = &check.record;
    let spp = record.spp.map_or_else(String::new, |spp| format!(" at {spp} spp"));
    let size = match record.found {
        Some(found) if found.z < f64::MAX => format!(
            ": {:.4} where {:.4} is expected, {:+.1} standard errors",
            found.value, found.expected, found.z
        ),
        _ => String::new(),
    };
    format!("{} on {}{spp}, {}{size}", record.kind, record.scene, record.what)
}
