//! Coverage of intervals and violations of bounds.

use serde::{Deserialize, Serialize};

use super::Interval;

/// Coverage of the intervals of the input mean.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CoverageSummary {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Nominal 1−α.
    pub confidence: f64,
    /// Pixel class or `all`.
    pub class: String,
    /// Fraction of pixel-channels covered, allowing for the reference's noise; pixels without variance count as
    /// covered if constant.
    pub covered: Interval,
    /// The same without the allowance.
    pub covered_uncorrected: Interval,
    /// Fraction of those with s > 0 that are covered, allowing for the reference's noise; none if there are none.
    #[serde(default)]
    pub varying: Option<Interval>,
    /// Fraction covered of those that are not constant: missed events count as misses.
    #[serde(default)]
    pub lit: Option<Interval>,
    /// Of those with s > 0: fraction with the truth above the interval, and below it; absent in records that do not tell
    /// the sides apart.
    #[serde(default)]
    pub sides: Option<[f64; 2]>,
    /// Fraction without variance whose value is right.
    pub constant: f64,
    /// Fraction without variance whose value is wrong: missed events.
    pub missed: f64,
    /// Why the number must be read with care, if so.
    pub mark: Option<String>,
}

/// Violations of an error bound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoundSummary {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Row label.
    pub label: String,
    /// Claim name.
    pub claim: String,
    /// Whether a proof covers this procedure.
    pub proven: bool,
    /// α: the rate that must not be exceeded.
    pub alpha: f64,
    /// Pixel class or `all`.
    pub class: String,
    /// Rate of violations over pixel-channels, allowing for the reference's noise.
    pub violations: Interval,
    /// The same without the allowance.
    pub violations_uncorrected: f64,
    /// Part of the rate that comes from pixels without variance.
    pub missed: f64,
    /// Mean of |D−μ| over the bound: how loose it is.
    pub mean_ratio: Option<f64>,
    /// Why the number must be read with care, if so.
    pub mark: Option<String>,
}
