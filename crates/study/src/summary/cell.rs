//! Rows, their averages per scene and level, and those that did not run.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Interval, Status};
use crate::study::RowFrames;

/// A row of the study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MethodSummary {
    /// Label, unique.
    pub label: String,
    /// Method id.
    pub method: String,
    /// Name for people.
    pub name: String,
    /// Citation key.
    pub citation: String,
    /// Source in full.
    pub reference: String,
    /// All parameters.
    pub params: Value,
    /// Notes of the card.
    pub notes: Vec<String>,
    /// Which frames it got.
    #[serde(default)]
    pub frames: RowFrames,
    /// Whether its card claims an estimate of its own error.
    #[serde(default)]
    pub estimates_error: bool,
}

/// Averages over the replicates of one scene × spp × row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CellSummary {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Row label.
    pub label: String,
    /// Metric id to mean over replicates.
    pub metrics: BTreeMap<String, Interval>,
    /// Metric id to ratio to `mc` (geometric mean over paired replicates); below 1 is better for errors.
    pub ratio_to_mc: BTreeMap<String, Interval>,
    /// Metric id to the bias by the reference's noise that was estimated and taken out of the mean, in its unit; what is
    /// left of it is smaller. Metrics without any are absent.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub reference_bias: BTreeMap<String, f64>,
    /// Pixel class to metric id to mean over replicates.
    pub classes: BTreeMap<String, BTreeMap<String, Interval>>,
    /// Pixel class to metric id to ratio to `mc`.
    pub class_ratio_to_mc: BTreeMap<String, BTreeMap<String, Interval>>,
    /// Median seconds of denoising.
    pub denoise_seconds: Option<f64>,
    /// Smallest and largest timed run.
    pub denoise_seconds_range: Option<[f64; 2]>,
    /// Median seconds of rendering the input.
    pub render_seconds: Option<f64>,
    /// How many times more samples plain Monte Carlo needs for the same error: metric id to multiplier, for squared
    /// errors and their roots; none for a row that is left out of the ranking.
    pub equal_error: BTreeMap<String, Interval>,
    /// Whether the multiplier reaches beyond the rendered levels.
    pub equal_error_extrapolated: BTreeMap<String, bool>,
    /// Peak memory in bytes, largest over replicates.
    pub peak_memory_bytes: Option<u64>,
    /// Worst enclosure ratio over replicates and claims, if the method claims one; at most 1 if it held.
    pub enclosure_worst_ratio: Option<f64>,
    /// Named numbers of the method, mean over replicates.
    pub figures: BTreeMap<String, f64>,
    /// Replicates behind these numbers: those that all ranked rows of the level have; all of its own for a row that is
    /// left out of the ranking.
    pub replicates: u32,
    /// Replicates that the study asks for; 0 where that is not known.
    #[serde(default)]
    pub planned_replicates: u32,
    /// Pixels that the metrics are over, the fewest of a replicate; 0 where that is not known.
    #[serde(default)]
    pub pixels: u64,
    /// Pixels of the whole image; 0 where that is not known.
    #[serde(default)]
    pub pixels_of: u64,
    /// Why the row takes no part in the ranking and is never called best: it did not run on all frames that other rows
    /// ran on, or gave values that are not finite.
    #[serde(default)]
    pub left_out: Option<String>,
    /// Input pixels that were not finite, over all replicates.
    pub invalid_input_pixels: u64,
    /// Output values that were not finite, over all replicates.
    pub non_finite_output: u64,
}

/// A row that did not run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Skipped {
    /// Scene id.
    pub scene: String,
    /// Sample counts concerned.
    pub spp: Vec<u32>,
    /// Row label.
    pub label: String,
    /// Whether it was skipped or failed.
    pub status: Status,
    /// Why.
    pub reason: String,
}
