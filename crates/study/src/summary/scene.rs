//! Scenes and their references.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// A scene of the study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneSummary {
    /// Id within the study.
    pub id: String,
    /// Title.
    pub title: String,
    /// What it models or where it came from.
    pub about: String,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Replicates per spp level, by spp.
    pub replicates: BTreeMap<u32, u32>,
    /// Random seeds, path depth, filter and whatever else fixes the frames; name to value.
    pub settings: BTreeMap<String, String>,
    /// The reference.
    pub reference: ReferenceSummary,
    /// Pixels per class.
    pub classes: BTreeMap<String, u64>,
    /// Image of the reference, relative to the study's folder; empty in a recorded study, which has no images.
    pub reference_image: String,
    /// Seconds to render one frame, by spp: median over replicates, and threads used.
    pub render_seconds: BTreeMap<u32, f64>,
    /// Images of the noisy and denoised frames of replicate 0: row label to spp to path.
    pub images: BTreeMap<String, BTreeMap<u32, String>>,
    /// Diagnostic images of replicate 0: row label to spp to name to path.
    pub diagnostics: BTreeMap<String, BTreeMap<u32, BTreeMap<String, String>>>,
}

/// What stands for the truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReferenceSummary {
    /// Samples per pixel; 0 for exact truth, and where it is unknown.
    pub spp: u64,
    /// Whether it is the exact truth.
    #[serde(default)]
    pub exact: bool,
    /// Independent parts (0: unknown or exact).
    pub parts: u32,
    /// Sampling, or `exact`.
    pub sampling: String,
    /// How its noise is taken out of squared errors, in words.
    pub correction: String,
    /// Samples over the largest level of the study.
    pub ratio_to_top: f64,
    /// Whether the ratio is at least 16, as the coverage correction assumes.
    pub long_enough: bool,
    /// Metric id to the floor: the standard error that the reference itself contributes.
    pub floor: BTreeMap<String, f64>,
    /// Metric id to the largest bias by the reference's noise that was estimated and taken out of a value on this scene,
    /// relative to that value (relative metrics).
    pub bias: BTreeMap<String, f64>,
}

impl ReferenceSummary {
    /// Whether it is the exact truth, also in summaries of programs that told it by the sampling only.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.exact || self.sampling == "exact"
    }

    /// `exact truth`, `reference of 4096 samples per pixel`, or that their number is unknown.
    #[must_use]
    pub fn name(&self) -> String {
        match self.spp {
            _ if self.is_exact() => "exact truth".into(),
            0 => "reference of an unknown number of samples per pixel".into(),
            spp => format!("reference of {spp} samples per pixel"),
        }
    }
}
