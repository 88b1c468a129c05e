//! Limits on one side. Of a level they read 1−α alone: the limit at 95 % of a two-sided level of 95 % leaves 5 % beyond it.

use super::by_t::{ByT, STUDENT};
use super::critical::Tails;

/// From x̄ − t(α)·s/√n on: exact for independent normal samples. Samples skewed to the right lie above it more often than
/// 1−α.
pub(super) static LOWER_T: ByT = ByT {
    id: "lower-t",
    name: "lower limit by t",
    source: STUDENT,
    tails: |level| Tails { below: Some(level.alpha()), above: None },
    limit: true,
};

/// Up to x̄ + t(α)·s/√n: exact for independent normal samples. Samples skewed to the right lie below it less often than 1−α.
pub(super) static UPPER_T: ByT = ByT {
    id: "upper-t",
    name: "upper limit by t",
    source: STUDENT,
    tails: |level| Tails { below: None, above: Some(level.alpha()) },
    limit: true,
};
