use noisefloor_frame::FindingKind;
use noisefloor_stats::holm_adjusted;
use noisefloor_study::check::{CheckFound, CheckKind, CheckRecord};
use noisefloor_study::summary::Summary;
use serde::{Deserialize, Serialize};

use super::id::ID;
use crate::answers;
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
        let answer: Option<Vec<CheckRecord>> = answers::read(&level.answers, ID);
        records.extend(answer.into_iter().flatten());
    }
    records.extend(identical(summary));
    let checks = judged(records);
    if !checks.is_empty() {
        answers::keep(&mut summary.answers, ID, &checks);
    }
}

/// All checks of a report as one family.
fn judged(records: Vec<CheckRecord>) -> Vec<Check> {
    let p: Vec<f64> = records.iter().filter_map(|record| Some(record.found?.p)).collect();
    let mut adjusted = holm_adjusted(&p).into_iter();
    let judge = |record: CheckRecord| {
        let adjusted = record.found.and_then(|_| adjusted.next());
        Check { failed: adjusted.is_some_and(|p| p <= ALPHA), record, adjusted }
    };
    records.into_iter().map(judge).collect()
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
    answers::read(&summary.answers, ID).unwrap_or_default()
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

#[cfg(test)]
mod tests {
    use noisefloor_frame::Finding;

    use super::*;

    fn record(p: Option<f64>) -> CheckRecord {
        CheckRecord {
            kind: CheckKind::Halves,
            what: "spread".into(),
            scene: "steps".into(),
            spp: Some(4),
            found: p.map(|p| CheckFound { value: 1.5, expected: 1.0, z: 3.25, p }),
            note: String::new(),
        }
    }

    #[test]
    fn holms_rule_is_over_the_checks_that_could_tell() {
        // 4 of 5 tell: 4·0.002, 3·0.003, 2·0.02, each at least the one before.
        let checks = judged([Some(0.02), None, Some(0.002), Some(0.003), Some(0.5)].map(record).to_vec());
        let adjusted: Vec<Option<f64>> = checks.iter().map(|check| check.adjusted).collect();
        for (found, expected) in adjusted.iter().zip([Some(0.04), None, Some(0.008), Some(0.009), Some(0.5)])
        {
            assert_eq!(found.is_some(), expected.is_some());
            assert!((found.unwrap_or(0.0) - expected.unwrap_or(0.0)).abs() < 1e-15, "{adjusted:?}");
        }
        let failed: Vec<bool> = checks.iter().map(|check| check.failed).collect();
        assert_eq!(failed, [false, false, true, true, false], "at 1 %");
        assert_eq!(judged(vec![record(Some(0.009)), record(Some(0.5))])[0].adjusted, Some(0.018));
    }

    #[test]
    fn a_failed_check_is_told_with_scene_level_and_size() {
        let summary = with(judged(vec![record(Some(1e-3)), record(Some(0.5)), record(None)]));
        let expected = "I3 (half buffers against the variance) on steps at 4 spp, spread: 1.5000 where 1.0000 is \
            expected, +3.2 standard errors";
        assert_eq!(failed_checks(&summary), [expected]);
        assert_eq!(checks(&summary).len(), 3);
        assert!(failed_checks(&Summary::default()).is_empty());
    }

    fn with(checks: Vec<Check>) -> Summary {
        let mut summary = Summary::default();
        summary.answers.insert(ID.into(), serde_json::to_value(checks).unwrap());
        summary
    }

    #[test]
    fn equal_frames_and_seeds_fail_beside_any_number_of_checks_and_nothing_else_of_the_inputs_does() {
        let mut summary = Summary::default();
        let found = |kind| Finding::new(kind, "steps", "two of them");
        summary.findings =
            [FindingKind::EqualData, FindingKind::RefusedFrame, FindingKind::SharedSeed].map(found).to_vec();
        let mut records = identical(&summary);
        assert_eq!(records.len(), 2);
        records.extend((0..1000).map(|_| record(Some(1e-3))));
        let checks = judged(records);
        assert_eq!(checks.iter().filter(|check| check.failed).count(), 2);
        let told = failed_checks(&with(checks));
        assert_eq!(told, ["I5 (independence) on steps, two of them"; 2], "kept and read, without a size");
    }
}
