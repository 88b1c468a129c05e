//! What was asked, by which metrics, on which machine.

use serde::{Deserialize, Serialize};

/// The study file's own words.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StudyInfo {
    /// Name such as `vfi-fig09`.
    pub name: String,
    /// Title for people.
    pub title: String,
    /// What it asks, in a sentence or two.
    pub question: String,
    /// What the source work reports, and what we see; paragraphs.
    pub analysis: Vec<String>,
    /// Command that made it.
    pub command: String,
    /// Metric shown first, such as `relmse`.
    pub primary_metric: String,
    /// Metrics in display order: id, and how to read it.
    pub metrics: Vec<MetricInfo>,
    /// Sample counts in ascending order.
    pub spp: Vec<u32>,
    /// Which spp levels the image viewer shows (all if empty).
    pub viewer_spp: Vec<u32>,
    /// Which of [`crate::FIGURES`] are drawn (all if empty).
    #[serde(default)]
    pub figures: Vec<String>,
    /// Figures this study reproduces, such as `moon2013flash Fig. 9`.
    pub reproduces: Option<String>,
}

/// How to read a metric.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetricInfo {
    /// Id such as `relmse`.
    pub id: String,
    /// Short name such as `rMSE`.
    pub name: String,
    /// Formula with epsilon and averaging order.
    pub formula: String,
    /// Whether smaller is better.
    pub lower_is_better: bool,
    /// The right value of a metric that is neither error nor score: it ranks no rows and enters no ratio.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ideal: Option<f64>,
    /// Unit, or empty.
    pub unit: String,
    /// Whether the reference's noise is taken out.
    pub reference_noise_removed: bool,
    /// 2 for squared errors, 1 for their roots; absent where plain Monte Carlo has no rate.
    #[serde(default)]
    pub order: Option<u32>,
}

/// Machine, program and load.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Environment {
    /// Program version.
    pub version: String,
    /// Processor model, where the platform tells.
    pub cpu: String,
    /// Logical processors.
    pub logical_cpus: u32,
    /// Threads used.
    pub threads: u32,
    /// Instruction set that the kernels chose, such as `avx512`.
    pub simd: String,
    /// Operating system and architecture.
    pub platform: String,
    /// One-minute load average when the study began, where the platform tells.
    pub load_at_start: Option<f64>,
    /// Build profile, `release` or `debug`.
    pub profile: String,
    /// Date and time of the analysis, UTC, ISO 8601.
    pub date: String,
}
