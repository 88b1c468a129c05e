//! Records as questions see them: by scene, level and row, with the replicates that can be set beside each other, and
//! numbers over replicates with their uncertainty.

mod average;
mod index;
mod number;
mod scenes;
mod series;
mod standing;

pub(crate) use average::{metric, rate};
pub use index::Index;
pub use number::median;
pub(crate) use number::{LEVEL, bias, mean, told, value};
pub(crate) use scenes::{LONG_ENOUGH, reference_ratio, scenes, times};
pub(crate) use series::{by_replicate, error_ratio, reference_share, series};
