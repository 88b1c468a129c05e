//! Chances of a false alarm.

/// Two-sided chance of a false alarm of one test of a sound input.
pub const ALPHA: f64 = 1e-6;

/// Two-sided chance of a false alarm of the one test of all frames of a scene together, of which a study has few.
pub const SCENE_ALPHA: f64 = 5e-5;

/// Two-sided p-value of a size in standard errors; 1 of what is no number.
pub(crate) fn p_value(z: f64, freedom: u64) -> f64 {
    if z.is_nan() { 1.0 } else { noisefloor_stats::t_two_sided_p(z, freedom.max(1)) }
}
