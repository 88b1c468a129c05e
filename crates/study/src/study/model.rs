//! What a study says.

use noisefloor_frame::{FeatureHit, PixelFilter, Sampling};
use noisefloor_stats::Family;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::path::PathBuf;

use crate::study::compare::PaperComparison;
use crate::study::frames::RowFrames;
use crate::study::shot::Shot;

/// Kinds of plots that a study can choose from.
pub const FIGURES: [&str; 8] =
    ["convergence", "speed", "coverage", "intervals", "bounds", "estimates", "bias", "pit"];

/// What a study asks, on which scenes, at how many samples, of which methods. A file, not code.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// Name such as `vfi-fig09`: letters, digits, `-`, `_` and `.`.
    pub name: String,
    /// Title for people.
    pub title: String,
    /// What it asks.
    pub question: String,
    /// What the source work reports and what we see; paragraphs.
    pub analysis: Vec<String>,
    /// Figure or table that it reproduces.
    pub reproduces: Option<String>,
    /// Samples per pixel, ascending; folders of frames have their own.
    pub spp: Vec<u32>,
    /// Independent replicates per level.
    pub replicates: Replicates,
    /// Columns of rendered scenes, and of synthetic ones that do not state theirs.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Largest number of path edges from the eye to a light.
    pub depth: u32,
    /// Film filter.
    pub filter: PixelFilter,
    /// Where along a path features are taken.
    #[serde(default)]
    pub feature_hit: FeatureHit,
    /// Families of intervals that are measured and judged beside Student's t, by their ids.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub intervals: Vec<String>,
    /// Whether tests of membership are measured.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub membership: bool,
    /// Optional statistics of the colour that rendered and drawn frames get, by their names, each once: see
    /// [`noisefloor_frame::Statistic`]. Frames of folders have their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub statistics: Vec<String>,
    /// Random seed of the noisy frames; references have their own.
    pub seed: u64,
    /// Sampling of the noisy frames.
    pub sampling: Sampling,
    /// How references are rendered.
    pub reference: ReferenceSpec,
    /// Scenes in display order.
    pub scenes: Vec<SceneSpec>,
    /// Rows in display order.
    pub methods: Vec<MethodRow>,
    /// Metric ids in display order.
    pub metrics: Vec<String>,
    /// Metric shown first.
    pub primary_metric: String,
    /// Two-sided confidences of the coverage table.
    pub coverage: Vec<f64>,
    /// Timed runs.
    pub timing: Timing,
    /// Which pairs of rows are compared.
    pub comparison: Family,
    /// Levels that the image viewer shows and diagnostics are kept for; all if empty.
    pub viewer_spp: Vec<u32>,
    /// Pixel `(x, y)` that diagnostics probe, as fractions of the image; the middle if absent.
    pub probe: Option<[f64; 2]>,
    /// Which of [`FIGURES`] the report draws; all if empty. Tables are always there.
    pub figures: Vec<String>,
    /// What the source work reports about rows of this study.
    #[serde(default)]
    pub compare: Vec<PaperComparison>,
}

/// Replicates per level.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Replicates {
    /// Replicates unless a limit below is exceeded.
    pub default: u32,
    /// `[spp, replicates]` pairs: above that many samples per pixel, so many replicates; the largest limit that is
    /// exceeded wins.
    #[serde(default)]
    pub above: Vec<(u32, u32)>,
}

impl Replicates {
    /// The same number at every level.
    #[must_use]
    pub fn uniform(count: u32) -> Self {
        Self { default: count, above: Vec::new() }
    }

    /// Replicates at `spp`.
    #[must_use]
    pub fn at(&self, spp: u32) -> u32 {
        let exceeded = self.above.iter().filter(|(limit, _)| spp > *limit);
        exceeded.max_by_key(|(limit, _)| *limit).map_or(self.default, |(_, count)| *count)
    }
}

/// How references are rendered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceSpec {
    /// Samples per pixel of all parts together, a multiple of `parts`.
    pub spp: u32,
    /// Independently randomised parts, at least 8.
    pub parts: u32,
    /// Sampling inside each part.
    pub sampling: Sampling,
}

/// One scene of a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneSpec {
    /// Id within the study.
    pub id: String,
    /// Where its frames come from.
    pub source: SceneSource,
    /// Levels of this scene alone.
    pub spp: Option<Vec<u32>>,
    /// Replicates of this scene alone.
    pub replicates: Option<Replicates>,
    /// Which moment of it is shown, and how its light is carried; for rendered scenes.
    #[serde(default)]
    pub shot: Shot,
    /// Parameters that rows take here instead of their own defaults, where a row's method has them and the row does
    /// not set them.
    #[serde(default)]
    pub set: Map<String, Value>,
    /// Samples per pixel of frames that get as much time as another row with its denoising, see
    /// [`RowFrames::EqualTime`].
    #[serde(default)]
    pub equal_time_spp: Option<u32>,
    /// Name of the sequence that it is a frame of, in the order of [`Shot::frame`]; flicker is measured over it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sequence: Option<String>,
}

/// Where frames come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneSource {
    /// The built-in scene of this id, rendered here.
    Builtin(String),
    /// A glTF file, rendered here.
    Gltf(PathBuf),
    /// Drawn from a known mean image and sample law.
    Synthetic(noisefloor_synthetic::SyntheticScene),
    /// A folder of frames that another program rendered, with a reference.
    Folder(PathBuf),
}

/// One row: a method with some of its parameters set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MethodRow {
    /// Method id such as `virtual-flash` or `guarded(virtual-flash)`.
    pub id: String,
    /// Label, unique in the study.
    pub label: String,
    /// Overrides of the method's defaults.
    pub set: Map<String, Value>,
    /// Which frames it gets.
    #[serde(default)]
    pub frames: RowFrames,
    /// Line in the study file, for messages.
    #[serde(skip)]
    pub line: Option<usize>,
}

impl MethodRow {
    /// A row with all defaults, labelled with its id.
    #[must_use]
    pub fn new(id: impl Into<String>) -> Self {
        let id = id.into();
        Self { label: id.clone(), id, set: Map::new(), frames: RowFrames::Uniform, line: None }
    }

    /// Overrides one parameter.
    #[must_use]
    pub fn set(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.set.insert(name.into(), value.into());
        self
    }

    /// Gives it another label.
    #[must_use]
    pub fn label(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }
}

/// How denoising is timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Timing {
    /// Runs before the clock starts.
    pub warmup: u32,
    /// Timed runs, whose median counts.
    pub runs: u32,
}

impl Default for Timing {
    fn default() -> Self {
        Self { warmup: 1, runs: 5 }
    }
}

impl Study {
    /// Levels of a scene.
    #[must_use]
    pub fn levels<'a>(&'a self, scene: &'a SceneSpec) -> &'a [u32] {
        scene.spp.as_deref().unwrap_or(&self.spp)
    }

    /// Replicates of a scene at a level.
    #[must_use]
    pub fn replicates(&self, scene: &SceneSpec, spp: u32) -> u32 {
        scene.replicates.as_ref().unwrap_or(&self.replicates).at(spp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_limit_that_is_exceeded_decides_the_replicates() {
        let replicates = Replicates { default: 8, above: vec![(256, 4), (1024, 2)] };
        let at: Vec<u32> = [4, 256, 257, 1024, 4096].map(|spp| replicates.at(spp)).to_vec();
        assert_eq!(at, [8, 8, 4, 4, 2]);
    }
}
