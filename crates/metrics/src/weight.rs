//! The weight of squared errors in relative metrics, and its derivatives.

use crate::constants::EPSILON;

/// 1/(max(r,0)²+ε).
pub(crate) fn weight(r: f64) -> f64 {
    1.0 / (r.max(0.0).powi(2) + EPSILON) // ε > 0
}

/// Its first derivative.
pub(crate) fn weight_slope(r: f64) -> f64 {
    -2.0 * r.max(0.0) * weight(r).powi(2)
}

/// Its second derivative; that from above at 0, where it jumps, counts as 0 there.
pub(crate) fn weight_curvature(r: f64) -> f64 {
    if r > 0.0 { (6.0 * r * r - 2.0 * EPSILON) * weight(r).powi(3) } else { 0.0 }
}
