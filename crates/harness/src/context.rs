//! What an analysis must know beside the records; kept in the study's folder.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_frame::{Finding, Sampling};
use serde::{Deserialize, Serialize};

use crate::cache::Key;
use crate::flicker::Flicker;
use crate::store::Files;
use crate::summary::{Environment, MethodSummary};

/// The run that made the records.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Context {
    pub(crate) command: String,
    pub(crate) environment: Environment,
    pub(crate) methods: Vec<Row>,
    /// Levels and replicates of every scene, also of those that never began: a folder's frames can be listed only where
    /// the folder is.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) plan: Vec<PlannedScene>,
    /// Each kept in a file of its own, from the moment that its cells begin; all together here in a recorded study.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) scenes: Vec<SceneContext>,
    /// What was measured over the frames of sequences, in a recorded study: it takes images.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) flicker: Vec<Flicker>,
}

/// Frames that a run means to denoise on a scene.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PlannedScene {
    pub(crate) id: String,
    /// Level to replicates.
    pub(crate) replicates: BTreeMap<u32, u32>,
}

/// A row as it was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Row {
    pub(crate) summary: MethodSummary,
    /// Whether its card claims that it converges.
    pub(crate) consistent: bool,
}

/// A scene as it was run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SceneContext {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) about: String,
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) sampling: Sampling,
    pub(crate) settings: BTreeMap<String, String>,
    pub(crate) replicates: BTreeMap<u32, u32>,
    /// Pixel classes in the order of the class image's indices, with their pixel counts.
    pub(crate) classes: Vec<(String, u64)>,
    pub(crate) reference: ReferenceContext,
    /// Hash of what the measuring that made floor, bias and classes gives on fixed inputs; empty if unknown.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) measuring: String,
    /// The scene's kept files and their hashes.
    #[serde(default, skip_serializing_if = "Files::is_empty")]
    pub(crate) files: Files,
    /// Those of them that are not what was written; known to who has looked.
    #[serde(skip)]
    pub(crate) damaged: BTreeSet<String>,
    /// What was found about the scene's files or reference, apart from single frames.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) findings: Vec<Finding>,
}

/// A reference as it was used.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct ReferenceContext {
    /// Hash of all that determines it; tells whether the kept files are still the right ones.
    pub(crate) key: Key,
    pub(crate) spp: u64,
    pub(crate) parts: u32,
    pub(crate) sampling: String,
    pub(crate) exact: bool,
    pub(crate) correction: String,
    pub(crate) floor: BTreeMap<String, f64>,
}
