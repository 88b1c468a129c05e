//! Methods' estimates of their own error beside the measured one.

use serde::{Deserialize, Serialize};

use super::Interval;

/// A method's estimate of its own squared error beside the measured one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimateSummary {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Row label.
    pub label: String,
    /// Name of the image that estimate and measured error are about, where that is an intermediate one of the method and
    /// not its output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<String>,
    /// Pixel class or `all`.
    pub class: String,
    /// Mean estimated squared error; may be negative.
    pub estimated: Interval,
    /// Mean measured squared error, the reference's noise taken out.
    pub measured: Interval,
    /// Estimated over measured (geometric mean over replicates), or estimated − measured where `is_ratio` is false.
    pub effect: Interval,
    /// Whether `effect` is a ratio: all means of all replicates are positive.
    pub is_ratio: bool,
    /// What the reference contributes to the standard error of the effect; of a ratio on its logarithm.
    #[serde(default)]
    pub common: f64,
    /// Means over ten bins of pixel-channels by rank of the estimate, lowest first; only for class `all`.
    pub deciles: Vec<EstimateBin>,
    /// Pixel-channels whose estimate is not finite, over all replicates.
    pub non_finite: u64,
}

/// One bin of pixel-channels by rank of the estimate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimateBin {
    /// Mean estimated squared error.
    pub estimated: Interval,
    /// Mean measured squared error.
    pub measured: Interval,
}
