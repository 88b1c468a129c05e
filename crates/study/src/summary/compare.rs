//! Rows beside each other, beside the source work, and over the levels.

use noisefloor_stats::{Family, Trend};
use serde::{Deserialize, Serialize};

use super::{Agreement, Interval};

/// Convergence of one row on one scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SlopeSummary {
    /// Scene id.
    pub scene: String,
    /// Row label.
    pub label: String,
    /// Metric id.
    pub metric: String,
    /// Slope of log error against log spp, fitted per replicate; −1 for plain Monte Carlo's MSE, −½ for RMSE.
    pub slope: Interval,
    /// Part of its standard error that the reference contributes.
    #[serde(default)]
    pub reference_se: f64,
    /// Whether the error vanishes.
    pub verdict: Trend,
    /// The verdict in a sentence, with the bias where it plateaus.
    pub sentence: String,
    /// Error floor b of error(n) = b + c/n where the verdict is `plateaus`.
    pub bias: Option<Interval>,
}

/// All pairs of rows at one scene × spp × metric, Holm-corrected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Metric id.
    pub metric: String,
    /// Labels from best to worst.
    pub ranking: Vec<String>,
    /// Labels that the replicates cannot tell from the best (always contains the best).
    pub best_group: Vec<String>,
    /// Which pairs are compared.
    pub family: Family,
    /// Pairs compared, with the Holm-adjusted p-value.
    pub pairs: Vec<PairResult>,
}

/// One comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairResult {
    /// First label.
    pub a: String,
    /// Second label.
    pub b: String,
    /// Error of a over error of b (or difference a−b where `is_ratio` is false).
    pub effect: Interval,
    /// Whether `effect` is a ratio.
    pub is_ratio: bool,
    /// Holm-adjusted p-value.
    pub p_adjusted: f64,
    /// Whether they can be told apart at 95 %.
    pub distinguishable: bool,
}

/// A ratio of two rows' errors beside the one that the source work reports.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PaperResult {
    /// What is compared, for people.
    pub what: String,
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Label of the row whose error is above the fraction line.
    pub row: String,
    /// Label of the row whose error is below it.
    pub over: String,
    /// Metric id.
    pub metric: String,
    /// Our ratio: geometric mean over paired replicates; absent where `reason` says why.
    pub ours: Option<Interval>,
    /// The source's ratio, from and to; equal for one number.
    pub paper: [f64; 2],
    /// Where the source says it.
    pub source: String,
    /// What that says.
    pub verdict: Agreement,
    /// Why there is no ratio, or no verdict.
    #[serde(default)]
    pub reason: Option<String>,
}
