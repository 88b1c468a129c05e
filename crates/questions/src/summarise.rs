//! Records to summary: every question's findings, and what the study was.

use noisefloor_study::context::Context;
use noisefloor_study::record::Record;
use noisefloor_study::summary::{Environment, SUMMARY_SCHEMA, StudyInfo, Summary, Warning, WarningKind};
use noisefloor_study::{Study, metric};

use crate::claims;
use crate::flicker::{Images, Sequences, flicker};
use crate::list::QUESTIONS;
use crate::records::{Index, scenes};

/// Where the images of a study are.
pub enum Kept<'a> {
    /// In its folder.
    Images(&'a dyn Images),
    /// Nowhere: it is a recorded one.
    Recorded,
}

impl std::fmt::Debug for Kept<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Images(_) => "Images",
            Self::Recorded => "Recorded",
        })
    }
}

/// Analyses the finished cells of a study, however many there are; `date` is that of the analysis.
#[must_use]
pub fn summarise(
    study: &Study,
    context: &Context,
    records: &[Record],
    kept: &Kept<'_>,
    date: String,
) -> Summary {
    let (sequences, recorded) = match kept {
        Kept::Images(images) => (flicker(study, context, records, *images), false),
        Kept::Recorded => (recorded_sequences(study, context), true),
    };
    let index = Index::new((study, context), records, &sequences.measured, recorded);
    let mut summary = Summary {
        schema: SUMMARY_SCHEMA,
        study: info(study, context, &index),
        environment: Environment { date, ..context.environment.clone() },
        scenes: scenes(&index),
        methods: context.methods.iter().map(|row| row.summary.clone()).collect(),
        recorded,
        warnings: sequences.problems,
        ..Summary::default()
    };
    QUESTIONS.iter().for_each(|question| (question.analyse)(&index, &mut summary));
    claims::settle(&mut summary);
    summary
}

/// What a recording keeps of its sequences; what it does not is told, because measuring takes images.
fn recorded_sequences(study: &Study, context: &Context) -> Sequences {
    let measured = context.flicker.clone();
    let absent = |name: &&str| !measured.iter().any(|flicker| flicker.sequence == *name);
    let names: Vec<&str> = study.sequences().into_iter().map(|(name, _)| name).collect();
    let problem = |name: &str| {
        let text = "flicker is left out: it takes images, and this recording was made without";
        Warning::about(WarningKind::NotMeasured, format!("sequence {name}"), text)
    };
    let problems = names.into_iter().filter(absent).map(problem).collect();
    Sequences { measured, problems }
}

fn info(study: &Study, context: &Context, index: &Index<'_>) -> StudyInfo {
    StudyInfo {
        name: study.name.clone(),
        title: study.title.clone(),
        question: study.question.clone(),
        analysis: study.analysis.clone(),
        command: context.command.clone(),
        primary_metric: study.primary_metric.clone(),
        metrics: study.metrics.iter().filter_map(|id| metric::info(id)).collect(),
        spp: index.levels(),
        viewer_spp: study.viewer_spp.clone(),
        figures: study.figures.clone(),
        reproduces: study.reproduces.clone(),
    }
}
