//! What numbers of a scene may be at most.

/// The most radiance (or irradiance of a sun) that a light may have: beyond it, squares that statistics are made of
/// leave the range of `f32`.
pub const MOST_RADIANCE: f32 = 1e15;
