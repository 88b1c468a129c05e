use noisefloor_frame::{Finding, FindingKind, sorted_findings};
use noisefloor_study::summary::Summary;

use super::{builds, looked, progress, warnings};
use crate::records::Index;

/// How far the study got, what was found about its inputs, and what a reader must see first.
pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.progress = progress::progress(index.study, index.context, index.all);
    summary.findings = findings(index, summary);
    // What questions before this one had to tell comes after what is more serious.
    let told = std::mem::take(&mut summary.warnings);
    summary.warnings = warnings::warnings(index, summary);
    summary.warnings.extend(looked::warning(index.context, index.all));
    summary.warnings.extend(told);
    summary.warnings.extend(builds::warning(index.all));
}

/// What was found about scenes, frames and outputs, once each.
fn findings(index: &Index<'_>, summary: &Summary) -> Vec<Finding> {
    let of_scenes = index.scenes().iter().flat_map(|scene| &scene.findings);
    let of_inputs = of_scenes.chain(index.all.iter().flat_map(|record| &record.findings)).cloned();
    let outputs = summary.cells.iter().filter(|cell| cell.non_finite_output > 0).map(|cell| {
        let subject = format!("{} on {} at {} spp", cell.label, cell.scene, cell.spp);
        let text = format!(
            "{} output values are not finite; their pixels are left out of the metrics",
            cell.non_finite_output
        );
        Finding::new(FindingKind::NonFiniteOutput, subject, text).with_value(cell.non_finite_output as f64)
    });
    sorted_findings(of_inputs.chain(outputs))
}
