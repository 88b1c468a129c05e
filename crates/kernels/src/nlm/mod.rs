//! Joint non-local means with known variances: the filter that rousselle2013rdfc builds everything from (Sec. 4), and
//! without features that of its predecessor for colour alone.
//!
//! For pixel p and its neighbours q in the window, clipped to the image, with guide g of variance v (C channels), features f_j of
//! variance v_j and spread s_j:
//!
//! ```text
//! Δ²_c(p,q) = ((g_c(p) − g_c(q))² − κ·(v_c(p) + min(v_c(p), v_c(q)))) / (1e-10 + k²·(v_c(p) + v_c(q))),  at most 1e4
//! d²(p,q)   = mean over channels and the (2f+1)² taps n of Δ²_c(p+n, q+n)
//! Φ²_j(p,q) = mean over channels of ((f_j(p) − f_j(q))² − (v_j(p) + min(v_j(p), v_j(q)))) / (k_f²·D_j(p)),  D = max(τ, s)
//! w(p,q)    = exp(−max(0, d², Φ²_1, Φ²_2, …))
//! F(p)      = Σ_q w(p,q)·u(q) / Σ_q w(p,q)
//! ```
//!
//! exp(−max(a, b)) is the minimum of both weights. w(p,p) = 1, so the sum is at least 1. Taps outside the image read the mirrored
//! pixel (index −i reads i). Any number of planes u is filtered with the same weights; one sweep over the window serves
//! several [`Pass`]es, which differ in patch and τ and share the rest. Frames beside the target widen the window in time.
//!
//! With a [`Perturbation`] a pass also gives the derivative of the filtered guide by the guide's own value at p, as a
//! finite difference: what Stein's unbiased risk estimate needs.

mod error;
pub mod naive;
mod params;
#[cfg(test)]
mod tests;

pub use error::NlmError;
pub use params::{
    Center, Channel, Denominator, Feature, FeatureChannel, Filtered, MAX_FEATURE_CHANNELS, MAX_FLOOR,
    MAX_GUIDE_CHANNELS, MAX_K, MAX_PASSES, MAX_PATCH_RADIUS, MAX_PIXELS, MAX_VALUE, MAX_VARIANCE,
    MAX_WINDOW_RADIUS, MIN_FLOOR, MIN_K, NlmInputs, NlmParams, Pass, Perturbation, Planes, Rule,
};

/// Filters with the fastest instruction set of this machine.
///
/// # Errors
/// As [`NlmParams::check`].
pub fn filter(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
) -> Result<Vec<Filtered>, NlmError> {
    naive::filter_f32(params, passes, inputs)
}
