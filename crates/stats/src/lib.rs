//! Intervals, coverage, bounds, slopes and comparisons: numbers in, numbers out.
//!
//! No images, no files, no randomness. A confidence [`Level`] says whether it is two-sided or upper, and an
//! [`Interval`]'s level travels with it.

mod level;
mod student;

pub use level::{Level, LevelError, Sides};
pub use student::{TTable, normal_quantile, t_quantile};
