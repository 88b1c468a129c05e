use noisefloor_frame::{Finding, FindingKind};
use noisefloor_study::exhibit::{Banner, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::{Environment, Summary, Warning};

/// Load of a machine that counts as idle.
const IDLE: f64 = 0.5;

/// What a reader must know before everything else.
pub(super) fn banners(summary: &Summary) -> Vec<Banner> {
    [unfinished(summary), first(summary), recorded(summary)].into_iter().flatten().collect()
}

fn unfinished(summary: &Summary) -> Option<Banner> {
    let progress = summary.progress.as_ref().filter(|progress| !progress.complete())?;
    Some(Banner {
        title: format!("Unfinished: {} of {} cells", progress.finished, progress.planned),
        lead: "Every number below is of the cells that ended. Missing:".into(),
        lines: progress.missing.iter().map(ToString::to_string).collect(),
        tone: Tone::Bad,
        strong: 0,
    })
}

/// Findings about the inputs before the warnings that follow from them.
fn first(summary: &Summary) -> Option<Banner> {
    let mut lines = findings(&summary.findings);
    let strong = lines.len();
    let told = Warning::merged(&summary.warnings);
    lines.extend(told.into_iter().map(|(subjects, warning)| line(&subjects, &warning.text)));
    lines.extend(load(&summary.environment));
    (!lines.is_empty()).then(|| Banner {
        title: "Read this first".into(),
        lead: String::new(),
        lines,
        tone: Tone::Plain,
        strong,
    })
}

fn recorded(summary: &Summary) -> Option<Banner> {
    summary.recorded.then(|| Banner {
        title: "A recorded study".into(),
        lead: format!(
            "Made from a recorded study, which keeps numbers and no images: the command {} makes them.",
            summary.study.command
        ),
        lines: Vec::new(),
        tone: Tone::Plain,
        strong: 0,
    })
}

/// Findings, those that say the same of several subjects as one.
fn findings(findings: &[Finding]) -> Vec<String> {
    let mut groups: Vec<(Vec<&str>, FindingKind, &str)> = Vec::new();
    for finding in findings {
        let same = |(subjects, kind, text): &&mut (Vec<&str>, FindingKind, &str)| {
            !finding.subject.is_empty()
                && !subjects.is_empty()
                && (*kind, *text) == (finding.kind, &finding.text)
        };
        let subject = Some(finding.subject.as_str()).filter(|subject| !subject.is_empty());
        match groups.iter_mut().find(same) {
            Some((subjects, ..)) => subjects.extend(subject),
            None => groups.push((subject.into_iter().collect(), finding.kind, &finding.text)),
        }
    }
    groups.into_iter().map(|(subjects, _, text)| line(&subjects, text)).collect()
}

/// `a, b and c: what`.
fn line(subjects: &[&str], what: &str) -> String {
    if subjects.is_empty() { what.to_owned() } else { format!("{}: {what}", format::list(subjects)) }
}

fn load(environment: &Environment) -> Option<String> {
    let load = environment.load_at_start.filter(|load| *load > IDLE && environment.logical_cpus > 0)?;
    Some(format!(
        "The machine was not idle when the study began (load {} on {}): times may be too long.",
        format::significant(load, 2),
        format::plural(environment.logical_cpus as usize, "logical processor"),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_finding_about_three_scenes_is_one_line() {
        let about = |subject: &str, text: &str| Finding::new(FindingKind::Brightness, subject, text);
        let given = [about("a", "dark"), about("", "alone"), about("b", "dark"), about("b", "bright")];
        assert_eq!(findings(&given), ["a and b: dark", "alone", "b: bright"]);
        let other = Finding::new(FindingKind::SharedSeed, "c", "dark");
        assert_eq!(findings(&[given[0].clone(), other]).len(), 2, "another kind says another thing");
    }

    #[test]
    fn a_busy_machine_is_told_and_an_idle_one_is_not() {
        let of = |load| Environment { load_at_start: load, logical_cpus: 2, ..Environment::default() };
        assert!(load(&of(Some(1.7))).is_some_and(|told| told.contains("load 1.7 on 2 logical processors")));
        assert!(load(&of(Some(0.4))).is_none() && load(&of(None)).is_none());
    }
}
