//! Cells: scene × spp × replicate × row, in the order in which they run.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_denoiser::{Method, MethodCard, Need, Registry};
use noisefloor_render::{Keep, Quantity};
use serde_json::json;

use crate::cache::{Key, key_of};
use crate::error::{HarnessError, Place};
use crate::record::RECORD_SCHEMA;
use crate::source::{FrameSpec, Scene};
use crate::study::Study;

/// A row ready to run.
pub(crate) struct Row {
    pub(crate) label: String,
    /// Unique folder name made from the label.
    pub(crate) slug: String,
    pub(crate) method: Method,
    pub(crate) card: MethodCard,
}

/// Everything that will be done, before anything is done.
pub(crate) struct Plan {
    pub(crate) scenes: Vec<Scene>,
    pub(crate) rows: Vec<Row>,
}

impl Plan {
    /// Looks up every name, so that a mistake is told before any work.
    pub(crate) fn new(
        study: &Study,
        registry: &Registry,
        size: Option<(usize, usize)>,
    ) -> Result<Self, HarnessError> {
        let rows = rows(study, registry)?;
        let recorded = recorded(&rows);
        let scenes = study.scenes.iter().map(|spec| Scene::open(study, spec, size, &recorded));
        let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
        same_sizes(study, &scenes)?;
        Ok(Self { scenes, rows })
    }

    /// Content hash of all that determines the numbers of a cell.
    pub(crate) fn cell_key(&self, study: &Study, scene: &Scene, frame: &FrameSpec, row: &Row) -> Key {
        key_of(&json!({
            "record": RECORD_SCHEMA,
            "build": crate::machine::build_id(),
            "frame": frame.key,
            "reference": scene.reference_key,
            "method": row.method.id,
            "params": row.method.params,
            "label": row.label,
            "coverage": study.coverage,
            "timing": study.timing,
            "diagnostics": wants_diagnostics(study, frame).then(|| json!([study.probe])),
            "within": scene.single(),
        }))
    }
}

/// Diagnostics are kept for one replicate at the levels that the viewer shows.
pub(crate) fn wants_diagnostics(study: &Study, frame: &FrameSpec) -> bool {
    frame.replicate == 0 && (study.viewer_spp.is_empty() || study.viewer_spp.contains(&frame.spp))
}

/// Frames of a sequence are compared pixel by pixel.
fn same_sizes(study: &Study, scenes: &[Scene]) -> Result<(), HarnessError> {
    for (name, frames) in study.sequences() {
        let of_sequence = scenes.iter().filter(|scene| frames.iter().any(|frame| frame.id == scene.id));
        let sizes: BTreeSet<(usize, usize)> = of_sequence.map(|s| (s.width, s.height)).collect();
        if sizes.len() > 1 {
            let told: Vec<String> = sizes.iter().map(|(w, h)| format!("{w}×{h}")).collect();
            return Err(HarnessError::Field {
                place: Place { file: format!("study `{}`", study.name), line: None },
                field: format!("sequence `{name}`: size"),
                value: told.join(" and "),
                allowed: "one size for all frames".into(),
            });
        }
    }
    Ok(())
}

fn rows(study: &Study, registry: &Registry) -> Result<Vec<Row>, HarnessError> {
    let mut slugs = BTreeSet::new();
    let mut rows = Vec::new();
    for row in &study.methods {
        let method = registry.build(&row.id, &row.set).map_err(|source| HarnessError::Method {
            place: Place { file: format!("study `{}`", study.name), line: row.line },
            label: row.label.clone(),
            source: Box::new(source),
        })?;
        let mut slug = slug(&row.label);
        while !slugs.insert(slug.clone()) {
            slug.push('_');
        }
        let card = method.denoiser.card();
        rows.push(Row { label: row.label.clone(), slug, method, card });
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

/// What a renderer should record so that every row has what it needs and may use.
fn recorded(rows: &[Row]) -> BTreeMap<Quantity, Keep> {
    let mut out = BTreeMap::new();
    let mut add = |quantity: Option<Quantity>, variance: bool| {
        if let Some(quantity) = quantity {
            let keep = out.entry(quantity).or_insert(Keep::MEAN);
            keep.variance |= variance;
        }
    };
    for need in rows.iter().flat_map(|row| row.card.needs.iter().chain(&row.card.uses)) {
        match need {
            Need::Feature(id) => add(Quantity::from_name(id.name()), false),
            Need::FeatureVariance(id) => add(Quantity::from_name(id.name()), true),
            Need::Flash => add(Some(Quantity::Flash), false),
            Need::FlashVariance => add(Some(Quantity::Flash), true),
            // The colour always comes with variance and halves; samples are the study's business.
            _ => {}
        }
    }
    out
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
