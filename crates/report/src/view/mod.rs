//! The page's contents as plain texts, in the order of the template.

mod claims;
mod equal_time;
mod estimates;
mod flicker;
mod headline;
mod paper;
mod slopes;
mod table;
mod words;

use noisefloor_harness::summary::{Environment, MetricInfo, Summary};
use serde::Serialize;

use crate::format;
use crate::index::Index;
pub(crate) use claims::{BoundRow, BoundsView, CoverageView, EnclosureView, bounds, coverage};
pub(crate) use equal_time::{EqualTimeRow, equal_time};
pub(crate) use estimates::{EstimateRow, EstimatesView, estimates};
pub(crate) use flicker::{FlickerView, flicker};
pub(crate) use headline::{Answer, Board, SceneCard, answers};
pub(crate) use paper::{PaperRow, paper};
pub(crate) use slopes::SlopeTable;
pub(crate) use table::SceneTable;

/// Everything but plots and images.
#[derive(Debug, Serialize)]
pub(crate) struct Page {
    pub title: String,
    pub study: String,
    pub question: String,
    pub reproduces: Option<String>,
    pub analysis: Vec<String>,
    pub command: String,
    pub environment: Vec<(String, String)>,
    pub date: String,
    pub version: String,
    /// What is missing of an unfinished study.
    pub unfinished: Option<Unfinished>,
    /// What was found about the inputs, before everything that follows from it.
    pub findings: Vec<String>,
    pub warnings: Vec<String>,
    /// Where the pictures are, if they are not here.
    pub recorded: Option<String>,
    pub answers: Vec<Answer>,
    pub board: Board,
    pub cards: Vec<SceneCard>,
    pub paper: Vec<PaperRow>,
    pub metric: String,
    pub uncertainty: String,
    pub has_equal: bool,
    pub levels: Vec<Level>,
    pub tables: Vec<SceneTable>,
    pub failures: Vec<Failure>,
    pub coverage: Vec<CoverageView>,
    pub bounds: Vec<BoundsView>,
    pub enclosures: Option<EnclosureView>,
    pub estimates: Vec<EstimatesView>,
    pub equal_time: Vec<EqualTimeRow>,
    pub flicker: Vec<FlickerView>,
    pub slopes: Vec<SlopeTable>,
    pub methods: Vec<MethodView>,
    /// With which values are good, in words.
    pub metrics: Vec<(MetricInfo, String)>,
    pub scenes: Vec<SceneView>,
}

/// How far a study got that did not come to its end.
#[derive(Debug, Serialize)]
pub(crate) struct Unfinished {
    pub finished: u64,
    pub planned: u64,
    pub missing: Vec<String>,
}

/// A samples-per-pixel level that the tables can show.
#[derive(Debug, Serialize)]
pub(crate) struct Level {
    pub spp: u32,
    pub chosen: bool,
}

/// A row that did not run somewhere.
#[derive(Debug, Serialize)]
pub(crate) struct Failure {
    pub scene: String,
    pub label: String,
    pub spp: String,
    pub status: String,
    pub reason: String,
}

/// A row of the study, explained.
#[derive(Debug, Serialize)]
pub(crate) struct MethodView {
    pub label: String,
    pub swatch: usize,
    pub method: String,
    pub name: String,
    pub citation: String,
    pub reference: String,
    pub params: Vec<(String, String)>,
    pub notes: Vec<String>,
}

/// A scene, explained.
#[derive(Debug, Serialize)]
pub(crate) struct SceneView {
    pub title: String,
    pub id: String,
    pub about: String,
    pub facts: Vec<(String, String)>,
    pub reference: Vec<(String, String)>,
}

/// Makes all texts of the page.
pub(crate) fn page(index: &Index<'_>) -> Page {
    let summary = index.summary;
    let study = &summary.study;
    let chosen = index.default_spp();
    Page {
        title: study.title.clone(),
        study: study.name.clone(),
        question: study.question.clone(),
        reproduces: study.reproduces.clone(),
        analysis: study.analysis.clone(),
        command: study.command.clone(),
        environment: environment(&summary.environment),
        date: summary.environment.date.clone(),
        version: summary.environment.version.clone(),
        unfinished: unfinished(summary),
        findings: merged(&summary.findings.iter().map(ToString::to_string).collect::<Vec<_>>()),
        warnings: warnings(summary),
        recorded: summary.recorded.then(|| {
            format!(
                "Made from a recorded study, which keeps numbers and no images: the command {} makes them.",
                study.command
            )
        }),
        answers: headline::answers(index),
        board: headline::board(index),
        cards: headline::cards(index),
        paper: paper::paper(index),
        metric: index.metric_name(&study.primary_metric),
        uncertainty: words::uncertainty(summary),
        has_equal: index.metric(&study.primary_metric).is_some_and(|m| m.order.is_some()),
        levels: study.spp.iter().map(|&spp| Level { spp, chosen: Some(spp) == chosen }).collect(),
        tables: summary.scenes.iter().map(|s| table::scene(index, s)).collect(),
        failures: failures(index),
        coverage: summary.scenes.iter().filter_map(|s| claims::coverage(index, s)).collect(),
        bounds: summary.scenes.iter().filter_map(|s| claims::bounds(index, s)).collect(),
        enclosures: claims::enclosures(index),
        estimates: summary.scenes.iter().filter_map(|s| estimates::estimates(index, s)).collect(),
        equal_time: equal_time::equal_time(index.summary),
        flicker: flicker::flicker(index),
        slopes: slopes::tables(index),
        methods: methods(index),
        metrics: study.metrics.iter().map(|metric| (metric.clone(), better(metric))).collect(),
        scenes: scenes(summary),
    }
}

fn better(metric: &MetricInfo) -> String {
    match (metric.ideal, metric.lower_is_better) {
        (Some(ideal), _) => format!("closer to {ideal}"),
        (None, true) => "lower".into(),
        (None, false) => "higher".into(),
    }
}

/// The study's own warnings, and those that the numbers of the summary add.
fn warnings(summary: &Summary) -> Vec<String> {
    let mut warnings = merged(&summary.warnings);
    let environment = &summary.environment;
    let busy = environment.load_at_start.filter(|load| *load > 0.5 && environment.logical_cpus > 0);
    if let Some(load) = busy {
        warnings.push(format!(
            "The machine was not idle when the study began (load {} on {}): times may be too long.",
            format::significant(load, 2),
            format::plural(environment.logical_cpus as usize, "logical processor"),
        ));
    }
    warnings
}

fn unfinished(summary: &Summary) -> Option<Unfinished> {
    let progress = summary.progress.as_ref().filter(|progress| !progress.complete())?;
    Some(Unfinished {
        finished: progress.finished,
        planned: progress.planned,
        missing: progress.missing.iter().map(ToString::to_string).collect(),
    })
}

/// Warnings that say the same of several subjects (`subject: what`), as one.
fn merged(warnings: &[String]) -> Vec<String> {
    let mut groups: Vec<(Vec<&str>, &str)> = Vec::new();
    for warning in warnings {
        let (subject, what) = warning.split_once(": ").unwrap_or(("", warning));
        match groups.iter_mut().find(|(subjects, known)| *known == what && !subjects.contains(&"")) {
            Some((subjects, _)) if !subject.is_empty() => subjects.push(subject),
            _ => groups.push((vec![subject], what)),
        }
    }
    let line = |(subjects, what): (Vec<&str>, &str)| match subjects.as_slice() {
        [""] => what.to_owned(),
        _ => format!("{}: {what}", format::list(&subjects)),
    };
    groups.into_iter().map(line).collect()
}

fn environment(e: &Environment) -> Vec<(String, String)> {
    let mut facts = vec![
        ("Program", format!("noisefloor {}", e.version)),
        ("Build", e.profile.clone()),
        ("Processor", e.cpu.clone()),
        ("Logical processors", e.logical_cpus.to_string()),
        ("Threads used", e.threads.to_string()),
        ("Instruction set", e.simd.clone()),
        ("Platform", e.platform.clone()),
    ];
    if let Some(load) = e.load_at_start {
        facts.push(("Load at start", format::significant(load, 2)));
    }
    facts.push(("Date", e.date.clone()));
    pairs(facts)
}

/// Named values without the empty ones.
fn pairs(facts: Vec<(&str, String)>) -> Vec<(String, String)> {
    facts.into_iter().filter(|(_, v)| !v.is_empty()).map(|(k, v)| (k.to_owned(), v)).collect()
}

fn failures(index: &Index<'_>) -> Vec<Failure> {
    index
        .summary
        .skipped
        .iter()
        .map(|s| Failure {
            scene: index.scene_title(&s.scene),
            label: s.label.clone(),
            spp: words::levels(&s.spp),
            status: s.status.clone(),
            reason: s.reason.clone(),
        })
        .collect()
}

fn methods(index: &Index<'_>) -> Vec<MethodView> {
    let view = |(swatch, m): (usize, &noisefloor_harness::summary::MethodSummary)| MethodView {
        label: m.label.clone(),
        swatch,
        method: m.method.clone(),
        name: m.name.clone(),
        citation: m.citation.clone(),
        reference: m.reference.clone(),
        params: words::parameters(&m.params),
        notes: m.notes.clone(),
    };
    index.summary.methods.iter().enumerate().map(view).collect()
}

fn scenes(summary: &Summary) -> Vec<SceneView> {
    summary
        .scenes
        .iter()
        .map(|s| {
            let mut facts = vec![("Size".to_owned(), format!("{}×{} pixels", s.width, s.height))];
            facts.push(("Replicates".into(), words::replicates(&s.replicates)));
            facts.extend(s.settings.iter().map(|(k, v)| (k.clone(), v.clone())));
            if !s.classes.is_empty() {
                let all = f64::from(s.width) * f64::from(s.height);
                let share = |(class, n): (&String, &u64)| {
                    format!("{class} {}", format::percent(*n as f64 / all.max(1.0)))
                };
                let classes: Vec<String> = s.classes.iter().map(share).collect();
                facts.push(("Pixel classes".into(), classes.join(" · ")));
            }
            SceneView {
                title: s.title.clone(),
                id: s.id.clone(),
                about: s.about.clone(),
                facts,
                reference: words::reference(&s.reference),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::merged;

    #[test]
    fn the_same_warning_for_three_scenes_is_one() {
        let given = ["a: short", "alone", "b: short", "b: long", "c: short"].map(String::from);
        assert_eq!(merged(&given), ["a, b and c: short", "alone", "b: long"]);
    }
}
