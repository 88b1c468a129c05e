//! What was measured over the frames of a sequence: it takes images, so its numbers are kept.

use serde::{Deserialize, Serialize};

/// One row at one level in one replicate of a sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Flicker {
    /// Name of the sequence.
    pub sequence: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Replicate, from 0.
    pub replicate: u32,
    /// Row label.
    pub label: String,
    /// The numbers.
    pub found: OverTime,
}

/// Numbers over the frames, means over pixels and channels.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OverTime {
    /// Unbiased variance of the error over the frames, less the references' variance.
    pub variance: Corrected,
    /// Squared error, less the references' variance.
    pub squared_error: Corrected,
    /// The references' variance, if all state it.
    pub reference_variance: Option<f64>,
    /// Covariance of what the references contribute to `variance` and to that of the output it was compared beside.
    pub covariance: Option<f64>,
}

/// A mean that the references' noise was taken out of.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Corrected {
    /// The mean.
    pub value: f64,
    /// Standard error that the references contribute, common to all replicates.
    pub reference_se: f64,
    /// The same for an output without any error of its own.
    pub floor: f64,
}
