//! Limits, and how columns lie.

/// Values that are worked on together.
pub(crate) const LANES: usize = 16;
/// [`LANES`] values of one column.
pub(crate) type Lanes = [f32; LANES];
/// Most feature channels.
pub const MAX_FEATURES: usize = 7;
/// Columns of X: 1, x, y and features; those that are not there are 0.
pub const COLUMNS: usize = 3 + MAX_FEATURES;
/// Largest window radius in pixels.
pub const MAX_RADIUS: usize = 32;
/// Most bandwidths.
pub const MAX_BANDWIDTHS: usize = 8;
/// Largest patch radius in pixels.
pub const MAX_PATCH_RADIUS: usize = 3;
