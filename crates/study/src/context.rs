//! What an analysis must know beside the records; kept in the study's folder.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_frame::{Finding, Integrator, Sampling};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::check::CheckRecord;
use crate::look::{Counts, Look};
use crate::summary::{Environment, MethodSummary};
use crate::{Flicker, Key, Maps};

/// Path relative to the study's folder, and the hash of the file there.
pub type Files = BTreeMap<String, String>;

/// The run that made the records.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Context {
    /// Command line.
    pub command: String,
    /// Machine and program.
    pub environment: Environment,
    /// Rows in study order.
    pub methods: Vec<RowContext>,
    /// Levels and replicates of every scene, also of those that never began: a folder's frames can be listed only where
    /// the folder is.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub plan: Vec<PlannedScene>,
    /// Each kept in a file of its own, from the moment that its cells begin; all together here in a recorded study.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<SceneContext>,
    /// What the instrument found of itself, apart from scenes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub self_check: Vec<CheckRecord>,
    /// What was measured over the frames of sequences, in a recorded study: it takes images.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub flicker: Vec<Flicker>,
    /// When the study was analysed with how many replicates, the first time first. Kept in a file of its own beside a run;
    /// here in a recorded study.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub looks: Vec<Look>,
}

impl Context {
    /// Replicates that the study asks for.
    #[must_use]
    pub fn planned(&self) -> Counts {
        self.plan.iter().map(|scene| (scene.id.clone(), scene.replicates.clone())).collect()
    }
}

/// Frames that a run means to denoise on a scene.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlannedScene {
    /// Scene id.
    pub id: String,
    /// Level to replicates.
    pub replicates: BTreeMap<u32, u32>,
}

/// A row as it was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowContext {
    /// What the report says of it.
    pub summary: MethodSummary,
    /// Whether its card claims that it converges.
    pub consistent: bool,
}

/// A scene as it was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneContext {
    /// Scene id.
    pub id: String,
    /// Title.
    pub title: String,
    /// What it models or where it came from.
    pub about: String,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Kind of sampling of the noisy frames.
    pub sampling: Sampling,
    /// What fixes the frames, for people: name to value.
    pub settings: BTreeMap<String, String>,
    /// Level to replicates.
    pub replicates: BTreeMap<u32, u32>,
    /// Which photon maps lit the frames, if any did; earlier programs said it in the settings alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maps: Option<Maps>,
    /// Pixel classes in the order of the class image's indices, with their pixel counts.
    pub classes: Vec<(String, u64)>,
    /// The reference.
    pub reference: ReferenceContext,
    /// Hash of what the measuring that made floor, bias and classes gives on fixed inputs; empty if unknown.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub measuring: String,
    /// The scene's kept files and their hashes.
    #[serde(default, skip_serializing_if = "Files::is_empty")]
    pub files: Files,
    /// Those of them that are not what was written; known to who has looked.
    #[serde(skip)]
    pub damaged: BTreeSet<String>,
    /// What was found about the scene's files or reference, apart from single frames.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
    /// What was measured over all replicates of each level.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<LevelContext>,
}

/// What was measured over all replicates of a level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LevelContext {
    /// Samples per pixel.
    pub spp: u32,
    /// Hash of all that determines it: frames, reference, outputs, the measuring.
    pub key: Key,
    /// By the question's id.
    pub answers: BTreeMap<String, Value>,
    /// Pictures: label of the row, then name, to the path relative to the study's folder.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub maps: BTreeMap<String, BTreeMap<String, String>>,
}

impl SceneContext {
    /// Whether the frames were lit by photon maps that their reference does not share. Earlier programs said it in the
    /// settings alone.
    #[must_use]
    pub fn fresh_maps(&self) -> bool {
        let says = |name: &str, start: &str| self.settings.get(name).is_some_and(|v| v.starts_with(start));
        let told =
            || says("light", Integrator::PhotonMapping.name()) && says("photon maps", Maps::Fresh.name());
        self.maps.map_or_else(told, |maps| maps == Maps::Fresh)
    }
}

/// A reference as it was used.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReferenceContext {
    /// Hash of all that determines it; tells whether the kept files are still the right ones.
    pub key: Key,
    /// Samples per pixel; 0 if exact or unknown.
    pub spp: u64,
    /// Independent parts.
    pub parts: u32,
    /// How its samples are placed, or `exact`.
    pub sampling: String,
    /// Whether it is the exact truth.
    pub exact: bool,
    /// How its noise is taken out, in words.
    pub correction: String,
    /// Metric id to the standard error that it contributes.
    pub floor: BTreeMap<String, f64>,
}
