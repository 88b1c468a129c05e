use serde::Serialize;

use crate::plan::levels::Level;

/// What a study will cost and tell.
#[derive(Debug, Serialize)]
pub(super) struct Plans {
    pub(super) study: String,
    /// Error whose ratios are compared.
    pub(super) metric: String,
    /// Pairs of rows in a cell, which Holm's rule adjusts together.
    pub(super) pairs: u32,
    /// 1 − α of all pairs of a cell together.
    pub(super) confidence: f64,
    /// The ratio that is to be told.
    pub(super) ratio: f64,
    /// The share of studies beside half of them.
    pub(super) power: f64,
    /// Where the spread over replicates is from; absent if it is the range that is usual.
    pub(super) spread_from: Option<String>,
    /// In what that is not what is planned.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spread_note: Option<String>,
    pub(super) levels: Vec<Level>,
    pub(super) cells: u64,
    pub(super) finished_cells: u64,
    /// Camera samples still to be rendered.
    pub(super) samples: u64,
    /// Samples per second of this machine on a small scene; absent if nothing is to be rendered.
    pub(super) samples_per_second: Option<f64>,
    pub(super) threads: usize,
    /// Least and most minutes of rendering and of denoising.
    pub(super) render_minutes: [f64; 2],
    pub(super) denoise_minutes: [f64; 2],
}
