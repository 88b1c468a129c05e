//! What a study must obey beyond its grammar.

mod compare;
mod frames;
mod intervals;
mod limits;
mod sequence;
mod statistics;

use std::collections::BTreeSet;

use noisefloor_frame::{Reference, Sampling};

use crate::error::StudyError;
use crate::metric;
use crate::study::limits::{LONGEST_LOW_DISCREPANCY, MOST_PER_PART, MOST_REPLICATES};
use crate::study::lines::{Lines, quoted};
use crate::study::model::{FIGURES, SceneSource, SceneSpec, Study};
use compare::check_comparisons;
use frames::check_frames;
use intervals::check_intervals;
use limits::{bad_replicates, check_limits};
use sequence::check_sequences;
use statistics::check_statistics;

impl Study {
    /// Refuses values without meaning; `file` is named in messages.
    ///
    /// # Errors
    /// [`StudyError::Field`].
    pub fn check(&self, file: &str) -> Result<(), StudyError> {
        check(self, &Lines { file: file.to_owned(), ..Lines::default() })
    }
}

/// Refuses values without meaning.
pub(super) fn check(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    let wrong = |field: &str, line: Option<usize>, value: String, allowed: &str| {
        Err(StudyError::Field {
            place: lines.place(line),
            field: field.into(),
            value,
            allowed: allowed.into(),
        })
    };
    let key = |name: &str| lines.of_key(name);
    let named = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    if study.name.is_empty() || !study.name.chars().all(named) || study.name.starts_with('.') {
        return wrong("name", key("name"), quoted(&study.name), "letters, digits, `-`, `_` and `.`");
    }
    // Folders know their own levels.
    let needed = |s: &SceneSpec| s.spp.is_none() && !matches!(s.source, SceneSource::Folder(_));
    if let Some(problem) = levels_problem(&study.spp)
        && (study.scenes.iter().any(needed) || !study.spp.is_empty())
    {
        return wrong("spp", key("spp"), format!("{:?}", study.spp), problem);
    }
    if let Some(bad) = bad_replicates(&study.replicates) {
        return wrong("replicates", key("replicates"), bad.to_string(), &format!("1 to {MOST_REPLICATES}"));
    }
    for (name, size) in [("width", study.width), ("height", study.height)] {
        if !(1..=16_384).contains(&size) {
            return wrong(name, key(name), size.to_string(), "1 to 16384");
        }
    }
    if !(1..=1024).contains(&study.depth) {
        return wrong("depth", key("depth"), study.depth.to_string(), "1 to 1024");
    }
    check_limits(study, lines)?;
    check_statistics(study, lines)?;
    check_intervals(study, lines)?;
    // Truth that is exact or comes with its frames is not rendered: nobody is asked how, and the default may be anything.
    let rendered = |s: &SceneSpec| matches!(s.source, SceneSource::Builtin(_) | SceneSource::Gltf(_));
    if study.scenes.iter().any(rendered) || lines.of_table("reference").is_some() {
        check_reference(study, lines)?;
    }
    if let Some(bad) = study.coverage.iter().find(|c| !(**c > 0.0 && **c < 1.0)) {
        return wrong("coverage", key("coverage"), bad.to_string(), "probabilities strictly between 0 and 1");
    }
    if let Some(bad) = study.probe.iter().flatten().find(|v| !(0.0..=1.0).contains(*v)) {
        return wrong("probe", key("probe"), bad.to_string(), "fractions of the image's size, 0 to 1");
    }
    let known = metric::known();
    for id in &study.metrics {
        if !known.contains(id) {
            return wrong("metrics", key("metrics"), quoted(id), &known.join(", "));
        }
    }
    if !study.metrics.contains(&study.primary_metric) || !metric::ranks(&study.primary_metric) {
        let ranking: Vec<&str> =
            study.metrics.iter().map(String::as_str).filter(|id| metric::ranks(id)).collect();
        let listed = match ranking.as_slice() {
            [] => "a metric that ranks rows, which `metrics` has none of".to_owned(),
            some => some.join(", "),
        };
        return wrong("primary_metric", key("primary_metric"), quoted(&study.primary_metric), &listed);
    }
    if let Some(bad) = study.figures.iter().find(|f| !FIGURES.contains(&f.as_str())) {
        return wrong("figures", key("figures"), quoted(bad), &FIGURES.join(", "));
    }
    check_scenes(study, lines)?;
    check_sequences(study, lines)?;
    check_rows(study, lines)?;
    check_frames(study, lines)?;
    check_comparisons(study, lines)
}

fn check_reference(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    let reference = &study.reference;
    let wrong = |field: &str, value: u32, allowed: String| {
        Err(StudyError::Field {
            place: lines.place(lines.of_table("reference")),
            field: format!("reference.{field}"),
            value: value.to_string(),
            allowed,
        })
    };
    let least = Reference::LEAST_PARTS as u32;
    if !(least..=4096).contains(&reference.parts) {
        return wrong("parts", reference.parts, format!("{least} to 4096 independent parts"));
    }
    if reference.spp == 0 || !reference.spp.is_multiple_of(reference.parts) {
        return wrong("spp", reference.spp, format!("a positive multiple of {} parts", reference.parts));
    }
    let per_part = reference.spp / reference.parts;
    if per_part > MOST_PER_PART {
        return wrong("spp", reference.spp, format!("at most {MOST_PER_PART} per part"));
    }
    let longest = LONGEST_LOW_DISCREPANCY;
    if reference.sampling == Sampling::LowDiscrepancy && per_part > longest {
        return wrong("spp", reference.spp, format!("at most {longest} per low-discrepancy part"));
    }
    Ok(())
}

fn check_scenes(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    let mut seen = BTreeSet::new();
    let wrong = |index: usize, field: &str, value: String, allowed: &str| {
        Err(StudyError::Field {
            place: lines.place(lines.scenes.get(index).copied()),
            field: format!("scene[{index}].{field}"),
            value,
            allowed: allowed.into(),
        })
    };
    for (index, scene) in study.scenes.iter().enumerate() {
        let named = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        if scene.id.is_empty() || !scene.id.chars().all(named) || scene.id.starts_with('.') {
            return wrong(index, "id", quoted(&scene.id), "letters, digits, `-`, `_` and `.`");
        }
        if !seen.insert(&scene.id) {
            return wrong(index, "id", quoted(&scene.id), "ids that differ from each other");
        }
        if let Some(spp) = &scene.spp
            && let Some(problem) = levels_problem(spp)
        {
            return wrong(index, "spp", format!("{spp:?}"), problem);
        }
        if let SceneSource::Folder(path) = &scene.source
            && !path.is_dir()
        {
            return wrong(index, "folder", quoted(&path.display().to_string()), "a folder that exists");
        }
        if let SceneSource::Gltf(path) = &scene.source
            && !path.is_file()
        {
            return wrong(index, "file", quoted(&path.display().to_string()), "a glTF file that exists");
        }
        if !(-360.0..=360.0).contains(&scene.shot.orbit_degrees) {
            return wrong(
                index,
                "orbit_degrees",
                scene.shot.orbit_degrees.to_string(),
                "within ±360 per frame",
            );
        }
    }
    if study.scenes.is_empty() {
        return wrong(0, "id", "absent".into(), "at least one `[[scene]]`");
    }
    Ok(())
}

fn check_rows(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    let mut seen = BTreeSet::new();
    for (index, row) in study.methods.iter().enumerate() {
        let wrong = |field: &str, value: String, allowed: &str| {
            Err(StudyError::Field {
                place: lines.place(row.line),
                field: format!("method[{index}].{field}"),
                value,
                allowed: allowed.into(),
            })
        };
        if row.label.trim().is_empty() {
            return wrong("label", quoted(&row.label), "some text");
        }
        if !seen.insert(&row.label) {
            return wrong("label", quoted(&row.label), "labels that differ from each other (set `label`)");
        }
    }
    if study.methods.is_empty() {
        return Err(StudyError::Field {
            place: lines.place(None),
            field: "method".into(),
            value: "absent".into(),
            allowed: "at least one `[[method]]`".into(),
        });
    }
    Ok(())
}

fn levels_problem(levels: &[u32]) -> Option<&'static str> {
    if levels.is_empty() {
        return Some("at least one number of samples per pixel");
    }
    if levels.iter().any(|n| !(1..=1 << 20).contains(n)) {
        return Some("numbers from 1 to 1048576");
    }
    (!levels.is_sorted_by(|a, b| a < b)).then_some("ascending numbers without repetition")
}
