//! Image-level blocks that denoisers share: each in one place, in safe code, in double precision where sums are long.
//!
//! | block | where it comes from |
//! |---|---|
//! | [`box_mean`] | means over clipped boxes without a running sum that a bright pixel could spoil |
//! | [`half_variance`], [`smoothed_half_variance`], [`scaled_sample_variance`], [`mean_of_halves`] | two-buffer variances (rousselle2013rdfc, Sec. 4 and 5) |
//! | [`squared_slope`] | gradients that differences of features are measured against (rousselle2013rdfc, Sec. 5) |
//! | [`percentile`] | nearest-rank percentiles of finite values |
//! | [`find_bad`] | pixels that a method must refuse |
//!
//! Bringing features to unit range is `UnitRange` of the crate that has frames.

mod box_mean;
mod check;
mod halves;
mod percentile;
mod slope;

pub use box_mean::box_mean;
pub use check::{Bad, find_bad};
pub use halves::{
    Shares, half_variance, mean_of_halves, scaled_sample_variance, shares, smoothed_half_variance,
};
pub use percentile::percentile;
pub use slope::{SlopeRule, squared_slope};
