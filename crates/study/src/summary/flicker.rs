//! Errors that change from frame to frame.

use serde::{Deserialize, Serialize};

use super::Interval;

/// How much a row's error changes over the frames of a sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlickerSummary {
    /// Name of the sequence.
    pub sequence: String,
    /// Scene ids by frame.
    pub scenes: Vec<String>,
    /// Samples per pixel.
    pub spp: u32,
    /// Row label.
    pub label: String,
    /// Unbiased variance over the frames of the error of each pixel and channel, mean over these, less the mean
    /// variance of the references; mean over replicates.
    pub variance: Interval,
    /// The same over that of the row `first` (geometric mean over paired replicates); absent for that row itself, and
    /// where a corrected variance is not positive.
    pub ratio_to_first: Option<Interval>,
    /// Label of the first row of the study that has numbers here.
    pub first: String,
    /// Squared error over the same frames, pixels and channels, less the mean variance of the references.
    pub squared_error: Interval,
    /// Mean variance of the references that was subtracted; absent if one of them states none, whose noise then counts.
    pub reference_variance: Option<f64>,
}
