//! A number with its uncertainty.

use serde::{Deserialize, Serialize};

/// Where the uncertainty of an [`Interval`] comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Source {
    /// Student t over replicates, the reference's own noise added.
    Replicates,
    /// Bootstrap over 32×32 blocks of one image: says nothing about other random seeds.
    WithinImage,
    /// No uncertainty could be estimated.
    None,
}

/// A number with its uncertainty.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Point estimate.
    pub value: f64,
    /// Standard error, in the unit of the value.
    pub standard_error: Option<f64>,
    /// Lower end.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
    /// Two-sided confidence of low and high.
    pub confidence: f64,
    /// Replicates (or blocks) behind it.
    pub n: u32,
    /// Origin of the uncertainty.
    pub source: Source,
    /// The estimate is not above the reference's floor (or not positive): print "< this" and plot an arrow.
    pub below: Option<f64>,
}
