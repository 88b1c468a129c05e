//! Records to summary: means over replicates, intervals, slopes, comparisons, and the sentences a reader must see
//! first.

mod bounds;
mod builds;
mod cells;
mod compare;
mod convergence;
mod coverage;
mod equal_time;
mod estimates;
mod flicker;
mod index;
mod number;
mod paper;
mod progress;
mod scenes;
mod series;
mod standing;
mod warnings;

pub(crate) use number::median;

use std::path::Path;

use noisefloor_frame::{Finding, FindingKind, sorted_findings};

use crate::context::Context;
use crate::flicker::Sequences;
use crate::machine;
use crate::record::Record;
use crate::study::Study;
use crate::summary::{Environment, SUMMARY_SCHEMA, StudyInfo, Summary};
use index::Index;

pub use warnings::violations;

/// Analyses the finished cells of a study, however many there are; their images are looked for in its folder, unless
/// it is a recorded one, which has none.
pub(crate) fn analyse(
    study: &Study,
    context: &Context,
    records: &[Record],
    root: &Path,
    recorded: bool,
) -> Summary {
    let sequences = match recorded {
        true => recorded_sequences(study, context),
        false => crate::flicker::measure(study, context, records, root),
    };
    let index = Index::new(study, context, records);
    let mut summary = Summary {
        schema: SUMMARY_SCHEMA,
        study: info(study, context, &index),
        environment: Environment { date: machine::now(), ..context.environment.clone() },
        scenes: scenes::scenes(&index, records, recorded),
        methods: context.methods.iter().map(|row| row.summary.clone()).collect(),
        cells: cells::cells(&index),
        skipped: index.skipped(),
        coverage: coverage::coverage(&index),
        bounds: bounds::bounds(&index),
        slopes: convergence::slopes(&index),
        comparisons: compare::comparisons(&index),
        paper: paper::paper(&index),
        estimates: estimates::estimates(&index),
        equal_time: equal_time::equal_time(&index),
        flicker: flicker::flicker(&index, &sequences.measured),
        progress: progress::progress(study, context, records),
        recorded,
        findings: Vec::new(),
        warnings: Vec::new(),
    };
    summary.findings = findings(context, records, &summary);
    summary.warnings = warnings::warnings(&index, &summary);
    summary.warnings.extend(sequences.problems);
    summary.warnings.extend(builds::warning(records));
    summary
}

/// What a recording keeps of its sequences; what it does not is told, because measuring takes images.
fn recorded_sequences(study: &Study, context: &Context) -> Sequences {
    let measured = context.flicker.clone();
    let absent = |name: &&str| !measured.iter().any(|flicker| flicker.sequence == *name);
    let names: Vec<&str> = study.sequences().into_iter().map(|(name, _)| name).collect();
    let problem = |name: &str| {
        format!("sequence {name}: flicker is left out: it takes images, and this recording was made without")
    };
    let problems = names.into_iter().filter(absent).map(problem).collect();
    Sequences { measured, problems }
}

/// What was found about scenes, frames and outputs, once each.
fn findings(context: &Context, records: &[Record], summary: &Summary) -> Vec<Finding> {
    let of_scenes = context.scenes.iter().flat_map(|scene| &scene.findings);
    let of_inputs = of_scenes.chain(records.iter().flat_map(|record| &record.findings)).cloned();
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

fn info(study: &Study, context: &Context, index: &Index<'_>) -> StudyInfo {
    StudyInfo {
        name: study.name.clone(),
        title: study.title.clone(),
        question: study.question.clone(),
        analysis: study.analysis.clone(),
        command: context.command.clone(),
        primary_metric: study.primary_metric.clone(),
        metrics: study.metrics.iter().filter_map(|id| crate::metric::info(id)).collect(),
        spp: index.levels(),
        viewer_spp: study.viewer_spp.clone(),
        figures: study.figures.clone(),
        reproduces: study.reproduces.clone(),
    }
}
