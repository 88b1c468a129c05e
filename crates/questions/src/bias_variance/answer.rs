//! What is kept of a level.

use noisefloor_stats::{BiasVarianceTotal, Estimated};
use serde::{Deserialize, Serialize};

/// All rows of a level.
pub(super) type Answer = Vec<RowAnswer>;

/// A row with at least two replicates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct RowAnswer {
    pub(super) label: String,
    pub(super) replicates: u32,
    /// Pixel-channels that are not finite in some replicate or in the reference.
    pub(super) left_out: u64,
    /// Over all pixels, without weight: parts of the MSE.
    pub(super) plain: Split,
    /// Over all pixels, with relMSE's weights.
    pub(super) relative: Split,
    /// Per class, with relMSE's weights.
    pub(super) classes: Vec<(String, Split)>,
}

/// Bias and variance over the pixel-channels of an image or a class.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Split {
    /// Mean of √w(D̄ − r), signed.
    pub(super) bias: Known,
    /// Mean of w·B²; nothing where the reference's noise is unknown.
    pub(super) squared_bias: Option<Known>,
    /// Mean of w·V.
    pub(super) variance: Known,
}

/// A number, its standard error over replicates if there are enough, and what the reference adds to that.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Known(pub(super) f64, pub(super) Option<f64>, pub(super) f64);

impl Known {
    fn of(estimated: &Estimated) -> Self {
        let error = estimated.replicate_error.map(rounded);
        Self(rounded(estimated.value), error, rounded(estimated.reference.standard_error))
    }
}

impl Split {
    pub(super) fn of(total: &BiasVarianceTotal) -> Self {
        Self {
            bias: Known::of(&total.bias),
            squared_bias: total.squared_bias.as_ref().map(Known::of),
            variance: Known::of(&total.variance),
        }
    }
}

/// To seven digits: the rest is noise, and recordings carry it.
fn rounded(v: f64) -> f64 {
    format!("{v:.6e}").parse().unwrap_or(v)
}
