//! Rows that get as much time as another.

use serde::{Deserialize, Serialize};

/// A row that gets as much time as another takes with its denoising.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EqualTime {
    /// Scene id.
    pub scene: String,
    /// Level of the other row.
    pub spp: u32,
    /// Label of the row.
    pub label: String,
    /// Label of the other row.
    pub with: String,
    /// Samples per pixel that its frames had, as the study says.
    pub used: u32,
    /// Samples per pixel that the medians of this run imply: the level, and the other row's denoising time over the
    /// time of a sample per pixel. Of an adaptive row all its time, since placing samples is part of it.
    pub implied: Option<f64>,
    /// Median seconds of the other row's denoising.
    pub denoise_seconds: f64,
    /// Median seconds of one sample in every pixel, rendered plainly.
    pub seconds_per_sample: Option<f64>,
}
