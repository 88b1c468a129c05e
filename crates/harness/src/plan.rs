//! Cells: scene × spp × replicate × row, in the order in which they run.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_denoiser::{Method, MethodCard, Need, Registry};
use noisefloor_render::{Keep, Quantity};
use serde_json::{Map, Value, json};

use crate::cache::{Key, key_of};
use crate::error::{HarnessError, Place};
use crate::fingerprint::{Fingerprints, measuring, measuring_of};
use crate::record::RECORD_SCHEMA;
use crate::source::{FrameSpec, Scene};
use crate::study::{RowFrames, SceneSpec, Study};

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
        let mut fingerprints = Fingerprints::default();
        let rows = rows(study, registry, None, &mut fingerprints)?;
        let recorded = recorded(rows.iter().map(|row| &row.card));
        let mut scenes = Vec::new();
        for spec in &study.scenes {
            let mut scene = Scene::open(study, spec, size, &recorded)?;
            scene.rows = self::rows(study, registry, Some(spec), &mut fingerprints)?;
            known_features(study, &scene)?;
            scene.open_beside(study, spec, size, &recorded)?;
            scenes.push(scene);
        }
        same_sizes(study, &scenes)?;
        Ok(Self { scenes, rows })
    }

    /// Content hash of all that determines the numbers of a cell. Methods and metrics are in it by what they give, so that
    /// neither a program that is built again nor one that gives other numbers is taken for the other.
    pub(crate) fn cell_key(&self, study: &Study, scene: &Scene, frame: &FrameSpec, row: &Row) -> Key {
        let mut all = json!({
            "record": RECORD_SCHEMA,
            // What a record says it is of, even where two cells have equal frames.
            "cell": json!([scene.id, frame.spp, frame.replicate]),
            "measuring": measuring(),
            "frame": frame.key,
            "reference": scene.reference_key,
            "method": row.method.id,
            "fingerprint": row.fingerprint,
            "params": row.method.params,
            "label": row.label,
            "coverage": study.coverage,
            "timing": study.timing,
            "diagnostics": wants_diagnostics(study, frame).then(|| json!([study.probe])),
            "within": scene.single(),
        });
        let beside: Vec<Key> = scene.beside(frame, row).map(|(_, frame)| frame.key).collect();
        // Cells without neighbouring frames keep the keys that they had when there were none.
        if !beside.is_empty() {
            all["beside"] = json!(beside);
        }
        // Nor does a metric change the keys of studies that do not list it, unless it is always measured.
        let asked: BTreeMap<&str, Key> = crate::metric::asked(&study.metrics)
            .iter()
            .map(|metric| (metric.id, measuring_of(metric)))
            .collect();
        if !asked.is_empty() {
            all["metrics"] = json!(asked);
        }
        key_of(&all)
    }
}

/// Diagnostics are kept for one replicate at the levels that the viewer shows.
pub(crate) fn wants_diagnostics(study: &Study, frame: &FrameSpec) -> bool {
    frame.replicate == 0 && (study.viewer_spp.is_empty() || study.viewer_spp.contains(&frame.spp))
}

/// Features that rows name must mean something: a misspelt one would run without and say nothing.
fn known_features(study: &Study, scene: &Scene) -> Result<(), HarnessError> {
    for (row, line) in scene.rows.iter().zip(study.methods.iter().map(|row| row.line)) {
        let there = scene.extra_features.iter().map(String::as_str);
        if let Some((name, nearest)) = row.card.unknown_feature(there) {
            return Err(HarnessError::Field {
                place: Place { file: format!("study `{}`", study.name), line },
                field: format!("row `{}`: feature on scene `{}`", row.label, scene.id),
                value: format!("`{name}`"),
                allowed: format!(
                    "features with a fixed meaning or in the scene's files; nearest: {}",
                    nearest.join(", ")
                ),
            });
        }
    }
    Ok(())
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

/// The rows as they run on a scene, or with the study's own parameters.
fn rows(
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
                place: Place { file: format!("study `{}`", study.name), line: row.line },
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
            return Err(HarnessError::Field {
                place: Place { file: format!("study `{}`", study.name), line: row.line },
                field: format!("row `{}`: adaptive", row.label),
                value: format!("`{}`", row.id),
                allowed: "a method that can say where samples are needed".into(),
            });
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
        return Err(HarnessError::Field {
            place: Place { file: format!("study `{}`", study.name), line: None },
            field: format!("scene `{}`: set", scene.id),
            value: format!("`{name}`"),
            allowed: "parameters that the method of some row has".into(),
        });
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
pub(crate) fn recorded<'a>(cards: impl Iterator<Item = &'a MethodCard>) -> BTreeMap<Quantity, Keep> {
    let mut out = BTreeMap::new();
    let mut add = |quantity: Option<Quantity>, variance: bool, halves: bool| {
        if let Some(quantity) = quantity {
            let keep = out.entry(quantity).or_insert(Keep::MEAN);
            keep.variance |= variance;
            keep.halves |= halves;
        }
    };
    for need in cards.flat_map(|card| card.needs.iter().chain(&card.uses)) {
        match need {
            Need::Feature(id) => add(Quantity::from_name(id.name()), false, false),
            Need::FeatureVariance(id) => add(Quantity::from_name(id.name()), true, false),
            Need::FeatureHalves(id) => add(Quantity::from_name(id.name()), false, true),
            Need::Flash => add(Some(Quantity::Flash), false, false),
            Need::FlashVariance => add(Some(Quantity::Flash), true, false),
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
