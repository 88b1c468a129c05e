use noisefloor_stats::{Region, convergence};

use crate::claims::{Claim, push};
use crate::records::Index;
use crate::records::series;
use crate::records::{LEVEL, told};
use noisefloor_study::RowFrames;
use noisefloor_study::summary::{ClaimId, Scale, SlopeSummary, Source, Summary};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.slopes = slopes(index);
    let claimed: Vec<SlopeSummary> = summary.slopes.iter().filter(|s| is_claim(index, s)).cloned().collect();
    claimed.iter().for_each(|slope| claim(slope, summary));
}

/// Plain Monte Carlo falls as 1/n by theory, and so does what a consistent method makes of it, once its bias is small: only
/// the input's slope is a claim, in the metric of the study.
fn is_claim(index: &Index<'_>, slope: &SlopeSummary) -> bool {
    let of_input = index.baseline().is_some_and(|row| row.summary.label == slope.label);
    of_input && slope.metric == index.study.primary_metric
}

fn claim(slope: &SlopeSummary, summary: &mut Summary) {
    let Some(order) = noisefloor_study::metric::order(&slope.metric) else { return };
    let region = Region::slope(order);
    let claim = Claim {
        id: ClaimId {
            question: "convergence".into(),
            what: format!("slope of {}", slope.metric),
            scene: slope.scene.clone(),
            spp: None,
            label: slope.label.clone(),
        },
        sentence: format!(
            "the error falls as plain Monte Carlo's does, slope {} to {}",
            minus(region.low),
            minus(region.high)
        ),
        effect: slope.slope.clone(),
        uncorrected: None,
        scale: Scale::Number,
        region: Some(region),
        common: slope.reference_se,
        trials: None,
        replicates_per_value: 1,
    };
    push(summary, claim);
}

/// With a true minus sign.
fn minus(value: f64) -> String {
    format!("{value}").replace('-', "−")
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
                    reference_se: slope.common,
                    slope: told(slope.interval, Source::Replicates, None),
                    verdict: found.verdict,
                    sentence: found.sentence,
                    bias: found
                        .bias
                        .filter(|_| found.verdict == noisefloor_stats::Trend::Plateaus)
                        .map(|bias| told(bias, Source::Replicates, None)),
                });
            }
        }
    }
    out
}
