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

/// Bias and variance over the pixel-channels of an image or a class. Short names and few digits: a recording has many.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Split {
    /// Mean of √w(D̄ − r), signed; of classes not kept.
    #[serde(rename = "b", default, skip_serializing_if = "Option::is_none")]
    pub(super) bias: Option<Known>,
    /// Mean of w·B²; nothing where the reference's noise is unknown.
    #[serde(rename = "b2")]
    pub(super) squared_bias: Option<Known>,
    /// Mean of w·V.
    #[serde(rename = "v")]
    pub(super) variance: Known,
}

/// A number, its standard error over replicates if there are enough, and what the reference adds to that.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Known(pub(super) f64, pub(super) Option<f64>, pub(super) f64);

impl Known {
    fn of(estimated: &Estimated) -> Self {
        // Errors know no more than their first digits; recordings carry them all.
        let error = estimated.replicate_error.map(|error| rounded(error, 3));
        Self(rounded(estimated.value, 6), error, rounded(estimated.reference.standard_error, 3))
    }
}

impl Split {
    pub(super) fn of(total: &BiasVarianceTotal) -> Self {
        Self {
            bias: Some(Known::of(&total.bias)),
            squared_bias: total.squared_bias.as_ref().map(Known::of),
            variance: Known::of(&total.variance),
        }
    }
}

/// To so many significant digits, at least 1.
fn rounded(v: f64, digits: usize) -> f64 {
    format!("{v:.*e}", digits - 1).parse().unwrap_or(v)
}
