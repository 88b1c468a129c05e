//! Welch, The generalization of "Student's" problem when several different population variances are involved, Biometrika
//! 34(1/2), 1947; degrees of freedom by Satterthwaite, Biometrics Bulletin 2(6), 1946.

use super::mean::SampleMean;
use crate::Level;
use crate::student::t_tail;

/// Whether means at this distance are told apart; both have at least 2 samples.
pub(super) fn tells_apart(distance: f64, a: &SampleMean, b: &SampleMean, level: Level) -> bool {
    let (v_a, v_b) = (a.variance.max(0.0), b.variance.max(0.0));
    let variance = v_a + v_b;
    if variance == 0.0 {
        return distance > 0.0;
    }
    // (v_a + v_b)²/(v_a²/(n_a − 1) + v_b²/(n_b − 1)); the shares add up to 1, so that the denominator is positive.
    let (share_a, share_b) = (v_a / variance, v_b / variance);
    let denominator = share_a * share_a / (f64::from(a.n) - 1.0) + share_b * share_b / (f64::from(b.n) - 1.0);
    t_tail(distance / variance.sqrt(), 1.0 / denominator) < level.upper_tail()
}
