//! Consistency: slopes and verdicts.

use noisefloor_harness::summary::SlopeSummary;
use serde::Serialize;

use crate::format;
use crate::index::Index;

/// Slopes of one metric on one scene.
#[derive(Debug, Serialize)]
pub(crate) struct SlopeTable {
    pub scene: String,
    pub metric: String,
    /// Whether the metric is the study's first.
    pub primary: bool,
    pub rows: Vec<SlopeRow>,
}

/// A row's slope.
#[derive(Debug, Serialize)]
pub(crate) struct SlopeRow {
    pub label: String,
    pub swatch: usize,
    pub slope: String,
    pub verdict: String,
    pub sentence: String,
}

/// Tables in the order of metrics and scenes, primary metric first.
pub(crate) fn tables(index: &Index<'_>) -> Vec<SlopeTable> {
    let summary = index.summary;
    let primary = &summary.study.primary_metric;
    let mut metrics: Vec<&String> = vec![primary];
    metrics.extend(summary.study.metrics.iter().map(|m| &m.id).filter(|id| *id != primary));
    let mut tables = Vec::new();
    for metric in metrics {
        for scene in &summary.scenes {
            let rows: Vec<SlopeRow> = summary
                .slopes
                .iter()
                .filter(|s| s.scene == scene.id && s.metric == *metric)
                .map(|s| row(index, s))
                .collect();
            if !rows.is_empty() {
                tables.push(SlopeTable {
                    scene: scene.title.clone(),
                    metric: index.metric_name(metric),
                    primary: metric == primary,
                    rows,
                });
            }
        }
    }
    tables
}

fn row(index: &Index<'_>, s: &SlopeSummary) -> SlopeRow {
    let mut sentence = plain(&s.sentence, &s.verdict);
    // The sentence names the bias itself; without one the number stands alone.
    if let (true, Some(bias)) = (sentence.is_empty(), &s.bias) {
        sentence = format!("levels off at {}", format::interval(bias).line());
    }
    SlopeRow {
        label: s.label.clone(),
        swatch: index.summary.methods.iter().position(|m| m.label == s.label).unwrap_or(0),
        slope: format::interval(&s.slope).line(),
        verdict: s.verdict.clone(),
        sentence,
    }
}

/// The sentence without the verdict that stands beside it, with true minus signs.
fn plain(sentence: &str, verdict: &str) -> String {
    let rest = sentence.strip_prefix(verdict).and_then(|s| s.strip_prefix(": ")).unwrap_or(sentence);
    let mut out = String::with_capacity(rest.len());
    let mut before = ' ';
    for (i, c) in rest.char_indices() {
        let number = rest[i + c.len_utf8()..].starts_with(|d: char| d.is_ascii_digit());
        out.push(if c == '-' && number && !before.is_alphanumeric() { '−' } else { c });
        before = c;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn sentences_lose_the_repeated_verdict_and_gain_minus_signs() {
        assert_eq!(
            plain("consistent: slope -0.99 (-1.01 to -0.97)", "consistent"),
            "slope −0.99 (−1.01 to −0.97)"
        );
        assert_eq!(plain("plateaus at 1e-5, two-step", "undecided"), "plateaus at 1e-5, two-step");
    }
}
