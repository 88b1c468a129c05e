//! Rows of a study, ready to run.

use std::collections::BTreeSet;

use noisefloor_denoiser::{Method, MethodCard, Registry};
use noisefloor_study::context::RowContext;
use noisefloor_study::summary::MethodSummary;
use noisefloor_study::{Key, Place, RowFrames, SceneSpec, Study, StudyError};
use serde_json::{Map, Value};

use crate::error::HarnessError;
use crate::fingerprint::Fingerprints;

/// A row ready to run.
pub(crate) struct Row {
    pub(crate) label: String,
    /// Unique folder name made from the label.
    pub(crate) slug: String,
    pub(crate) method: Method,
    pub(crate) card: MethodCard,
    /// Hash of what the method gives on fixed frames.
    pub(crate) fingerprint: Key,
    pub(crate) frames: RowFrames,
}

impl Row {
    /// What the analysis must know of it.
    pub(crate) fn describe(&self) -> RowContext {
        let card = &self.card;
        RowContext {
            summary: MethodSummary {
                label: self.label.clone(),
                method: self.method.id.clone(),
                name: card.name.clone(),
                citation: card.citation.key.to_string(),
                reference: card.citation.text.to_string(),
                params: self.method.params.clone(),
                notes: card.notes.clone(),
                frames: self.frames.clone(),
                estimates_error: card.claims.estimates_error,
            },
            consistent: card.claims.consistent,
        }
    }

    /// Whether it is meant by a name given to run again.
    pub(crate) fn is_named(&self, names: &[String]) -> bool {
        names.iter().any(|name| *name == self.label || *name == self.method.id)
    }
}

/// The rows as they run on a scene, or with the study's own parameters.
pub(crate) fn rows(
    study: &Study,
    registry: &Registry,
    scene: Option<&SceneSpec>,
    fingerprints: &mut Fingerprints,
) -> Result<Vec<Row>, HarnessError> {
    let mut unused: BTreeSet<&String> = scene.iter().flat_map(|scene| scene.set.keys()).collect();
    let mut slugs = BTreeSet::new();
    let mut rows = Vec::new();
    for row in &study.methods {
        let build = |set: &Map<String, Value>| {
            registry.build(&row.id, set).map_err(|source| HarnessError::Method {
                place: Place::of_study(&study.name, row.line),
                label: row.label.clone(),
                source: Box::new(source),
            })
        };
        let mut method = build(&row.set)?;
        let mut set = row.set.clone();
        for (name, value) in scene.iter().flat_map(|scene| &scene.set) {
            if method.params.get(name).is_some() {
                unused.remove(name);
                set.entry(name.clone()).or_insert_with(|| value.clone());
            }
        }
        if set != row.set {
            method = build(&set)?;
        }
        if matches!(row.frames, RowFrames::Adaptive(_)) && method.denoiser.adaptive().is_none() {
            return Err(StudyError::Field {
                place: Place::of_study(&study.name, row.line),
                field: format!("row `{}`: adaptive", row.label),
                value: format!("`{}`", row.id),
                allowed: "a method that can say where samples are needed".into(),
            }
            .into());
        }
        let first = slug(&row.label);
        let mut slug = first.clone();
        for number in 1.. {
            if slugs.insert(slug.clone()) {
                break;
            }
            // One more of that name, then numbers: names stay short however many are equal.
            slug = if number == 1 { format!("{first}_") } else { format!("{first}_{number}") };
        }
        let card = method.denoiser.card();
        let fingerprint = fingerprints.of(&method);
        let (label, frames) = (row.label.clone(), row.frames.clone());
        rows.push(Row { label, slug, method, card, fingerprint, frames });
    }
    if let (Some(name), Some(scene)) = (unused.into_iter().next(), scene) {
        return Err(StudyError::Field {
            place: Place::of_study(&study.name, None),
            field: format!("scene `{}`: set", scene.id),
            value: format!("`{name}`"),
            allowed: "parameters that the method of some row has".into(),
        }
        .into());
    }
    Ok(rows)
}

/// A folder name: letters and digits of the label, everything else one dash.
fn slug(label: &str) -> String {
    let mut out = String::new();
    for c in label.chars() {
        if c.is_ascii_alphanumeric() || c == '.' || c == '=' {
            out.push(c.to_ascii_lowercase());
        } else if !out.ends_with('-') {
            out.push('-');
        }
    }
    let trimmed = out.trim_matches(['-', '.']);
    if trimmed.is_empty() { "row".into() } else { trimmed.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::slug;

    #[test]
    fn slugs_are_folder_names() {
        assert_eq!(slug("guarded(virtual-flash) steps=1"), "guarded-virtual-flash-steps=1");
        assert_eq!(slug("../../etc"), "etc");
        assert_eq!(slug("κ"), "row");
    }
}
