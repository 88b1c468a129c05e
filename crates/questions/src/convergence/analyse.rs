use noisefloor_stats::convergence;

use crate::records::Index;
use crate::records::series;
use crate::records::{LEVEL, told};
use noisefloor_study::RowFrames;
use noisefloor_study::summary::{SlopeSummary, Source, Summary};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.slopes = slopes(index);
}

/// Slope and verdict per scene, row and metric that has a rate; none where fewer than two levels have a positive error.
fn slopes(index: &Index<'_>) -> Vec<SlopeSummary> {
    let mut out = Vec::new();
    for scene in index.scenes() {
        // Rows of equal time have the same samples at every level.
        for row in
            index.rows().iter().filter(|row| !matches!(row.summary.frames, RowFrames::EqualTime { .. }))
        {
            for metric in &index.study.metrics {
                let Some(order) = noisefloor_study::metric::order(metric) else { continue };
                let label = &row.summary.label;
                let found = convergence(&series(index, scene, label, metric), order, LEVEL);
                let Some(slope) = found.slope else { continue };
                out.push(SlopeSummary {
                    scene: scene.id.clone(),
                    label: label.clone(),
                    metric: metric.clone(),
                    slope: told(slope.interval, Source::Replicates, None),
                    verdict: found.verdict,
                    sentence: found.sentence,
                    bias: found
                        .bias
                        .filter(|_| found.verdict == noisefloor_stats::Verdict::Plateaus)
                        .map(|bias| told(bias, Source::Replicates, None)),
                });
            }
        }
    }
    out
}
