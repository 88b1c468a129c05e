//! e^−x in operations that every instruction set rounds alike.

use crate::engine::{EXP2, LEAST_EXPONENT, ROUND};

/// e^(−max(0, d)) to 3e-7 relative; 1 exactly for d ≤ 0; 0 where it is below the range of normal numbers, and for NaN.
#[inline(always)]
pub(crate) fn exponential(distance: f32) -> f32 {
    let x = distance * -std::f32::consts::LOG2_E;
    // Not `min`, which would drop a NaN.
    let x = if x > 0.0 { 0.0 } else { x };
    let n = x + ROUND;
    let f = x - (n - ROUND);
    let mut y = EXP2[0];
    y = y * f + EXP2[1];
    y = y * f + EXP2[2];
    y = y * f + EXP2[3];
    y = y * f + EXP2[4];
    y = y * f + EXP2[5];
    let value = f32::from_bits(y.to_bits().wrapping_add(n.to_bits() << 23));
    if x >= LEAST_EXPONENT { value } else { 0.0 }
}

/// Replaces distances by their weights.
#[inline(always)]
pub(super) fn exponentials(distances: &mut [f32]) {
    for distance in distances {
        *distance = exponential(*distance);
    }
}
