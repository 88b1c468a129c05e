//! What is kept of a level.

use serde::{Deserialize, Serialize};

/// Points i/50 at which distribution functions are told, i from 1.
pub(super) const POINTS: usize = 50;

/// Transforms of a level; one entry per replicate but for `ecdf`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) replicates: Vec<u32>,
    /// How many transforms.
    pub(super) values: Vec<u64>,
    /// Largest |F̂(z) − z| at the points.
    pub(super) deviation: Vec<f64>,
    /// Of the values: s = 0 and the mean is right; drawn uniformly.
    pub(super) constant: Vec<u64>,
    /// Of the values: s = 0 and the truth lies above the mean; u is 1.
    pub(super) missed_above: Vec<u64>,
    /// Of the values: s = 0 and the truth lies below the mean; u is 0.
    pub(super) missed_below: Vec<u64>,
    /// Chosen pixels without a transform.
    pub(super) left_out: Vec<u64>,
    /// F̂ at the points, mean over replicates.
    pub(super) ecdf: Vec<f64>,
}
