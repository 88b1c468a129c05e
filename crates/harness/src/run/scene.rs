//! All cells of one scene.

use std::collections::BTreeSet;

use noisefloor_frame::{Finding, FindingKind};
use noisefloor_questions::Measure;
use noisefloor_study::context::SceneContext;
use noisefloor_study::record::{NonFinite, Outcome};
use noisefloor_study::{Key, metric};

use crate::error::HarnessError;
use crate::observer::Stage;
use crate::run::cell::OnFrame;
use crate::run::inputs::Inputs;
use crate::run::levels;
use crate::run::prepare::{damaged_files, kept_context, truth};
use crate::run::runner::Runner;
use crate::store::Records;

/// Runs what is not finished, and describes the scene for the analysis.
pub(super) fn run(
    runner: &Runner<'_>,
    records: &mut Records,
    kept: &BTreeSet<Key>,
) -> Result<SceneContext, HarnessError> {
    let scene = runner.scene();
    let work = runner.plan.work(runner.place, kept);
    let (earlier, hashes) = levels::earlier(runner.layout, scene);
    if work.is_empty()
        && let Some(mut context) = kept_context(runner.layout, scene)
    {
        levels::settle(runner, records, None, earlier, &mut context)?;
        return Ok(context);
    }
    for file in damaged_files(runner.layout, scene) {
        let text = format!("{file} is not what was written or is gone; it is written again");
        runner.request.observer.warning(&text);
    }
    let (truth, mut context) = truth(scene, runner.layout, runner.access())?;
    context.files.extend(hashes);
    let asked = metric::asked(&runner.request.study.metrics);
    let measurer = truth.measurer(scene)?.with(&asked);
    let mut inputs = Inputs::open(scene, runner.layout, &truth.reference, &mut context);
    for (spec, cells) in work {
        runner.request.observer.stage(&Stage::Frame {
            scene: scene.id.clone(),
            spp: spec.spp,
            replicate: spec.replicate,
        });
        let steering = cells.first().map(|cell| runner.plan.row(cell));
        let made = scene.frame(spec, steering, runner.access());
        let made = made.and_then(|checked| Ok((checked, runner.beside(&cells)?)));
        let (checked, beside) = match made {
            // A frame that contradicts itself, or a method that does not know where it needs samples, ends its
            // own cells, not the study.
            Err(error @ (HarnessError::Density { .. } | HarnessError::Unsound { .. })) => {
                let refused = refused(&error);
                for cell in cells {
                    let mut record = runner.blank(cell, scene.sampling);
                    record.outcome = Outcome::Failed { reason: error.to_string() };
                    record.findings.extend(refused.clone());
                    records.append(record.clone())?;
                    runner.request.observer.cell(&record, &record.outcome);
                }
                continue;
            }
            made => made?,
        };
        let (frame, hygiene, findings) = (&checked.frame, &checked.hygiene, checked.findings());
        let non_finite = NonFinite {
            input_pixels: hygiene.invalid_pixels,
            negative_variances: hygiene.negative_variances,
            output_values: 0,
        };
        let without = hygiene.without_statistics();
        let mut findings = findings;
        // One fault, told once: half buffers show it best.
        let told = findings.iter().any(|found| found.kind == FindingKind::VarianceAgainstHalves);
        let pairs = inputs.frame(spec, frame, &without, &mut context)?;
        findings
            .extend(pairs.into_iter().filter(|f| !told || f.kind != FindingKind::VarianceAgainstReference));
        let measure = Measure::new(frame, &truth.reference, &truth.classes, &without, scene.single())
            .with_intervals(runner.request.laboratory.intervals);
        let here = OnFrame {
            runner,
            measurer: &measurer,
            measure,
            reference: &truth.reference,
            spec,
            frame,
            hygiene,
            findings,
            beside,
        };
        for cell in cells {
            if runner.request.observer.cancelled() {
                return Err(HarnessError::Cancelled);
            }
            let record = here.run(cell, non_finite)?;
            records.append(record.clone())?;
            runner.request.observer.cell(&record, &record.outcome);
        }
    }
    let prepared = Some((&truth.reference, &truth.classes));
    levels::settle(runner, records, prepared, earlier, &mut context)?;
    Ok(context)
}

/// A frame that could not be used is a finding about the inputs, in the same words as the failure of its cells.
fn refused(error: &HarnessError) -> Option<Finding> {
    let HarnessError::Unsound { frame, source } = error else { return None };
    Some(Finding::new(FindingKind::RefusedFrame, frame, source.to_string()))
}
