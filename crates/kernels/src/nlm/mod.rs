//! Joint non-local means with known variances: the filter that rousselle2013rdfc builds everything from (Eq. 1 to Eq. 4;
//! `flt` of its Sec. 7), and without features that of its predecessor for colour alone.
//!
//! For pixel p and its neighbours q in the window, clipped to the image, with guide g of variance v (C channels),
//! features f_j of variance v_j and spread s_j:
//!
//! ```text
//! Sec. 4         Δ²_c(p,q) = ((g_c(p) − g_c(q))² − κ·(v_c(p) + min(v_c(p), v_c(q)))) / (ε + k²·(v_c(p) + v_c(q))),  at most 1e4
//! Sec. 4         d²(p,q)   = mean over channels and the (2f+1)² taps n of Δ²_c(p+n, q+n)
//! Sec. 4, Eq. 2  w_c(p,q)  = exp(−max(0, d²))
//! Sec. 5         Φ²_j(p,q) = mean over channels of ((f_j(p) − f_j(q))² − (v_j(p) + min(v_j(p), v_j(q)))) / (k_f²·D_j(p)),  D = max(τ, s)
//! Sec. 5, Eq. 3  w_f(p,q)  = exp(−max(0, Φ²_1, Φ²_2, …))
//! Sec. 6, Eq. 4  w(p,q)    = min(w_c, w_f) = exp(−max(0, d², Φ²_1, Φ²_2, …))
//! Sec. 3, Eq. 1  F(p)      = Σ_q w(p,q)·u(q) / Σ_q w(p,q)
//! ```
//!
//! Ours: κ, which is 1 in the text; the limit of Δ²; the 0 in w_f, without which weights exceed 1; the mean over the channels of
//! a feature, as in the authors' program. Both denominators have a second form, see [`GuideDenominator`] and [`Denominator`].
//! w(p,p) = 1, so the sum is at least 1. Taps outside the image read the mirrored pixel (index −i reads i). Any number of planes u is filtered with the same weights; one sweep over the
//! window serves several [`Pass`]es, which differ in patch and τ and share the rest. Frames beside the target widen
//! the window in time.
//!
//! That is the printed filter, with the window clipped. [`WeightRules`] switches on what the authors' programs do beside it: smoothed
//! weights, weights that opposite neighbours share, mirrored windows, patches without taps beyond the image. They run in a second
//! form, map by map, at two to five times the cost.
//!
//! With a [`Perturbation`] a pass also gives the derivative of the filtered guide by the guide's own value at p, as a
//! finite difference: what Stein's unbiased risk estimate needs (Sec. 6, below Eq. 5).

mod hot;
mod layout;
pub(crate) mod maps;
pub mod naive;
mod output;
mod params;
mod rules;
mod tiled;

pub use params::{
    Center, Channel, Denominator, Feature, FeatureChannel, Filtered, GuideDenominator, MAX_EPSILON,
    MAX_FEATURE_CHANNELS, MAX_FLOOR, MAX_GUIDE_CHANNELS, MAX_K, MAX_PASSES, MAX_PATCH_RADIUS, MAX_PIXELS,
    MAX_VALUE, MAX_VARIANCE, MAX_WINDOW_RADIUS, MIN_EPSILON, MIN_FLOOR, MIN_K, NlmInputs, NlmParams, Pass,
    Perturbation, Planes, Rule,
};

pub use rules::{Border, PAIR_LIMIT, Pairs, Smoothing, Taps, WeightRules};

use crate::engine::{InstructionSet, TILE};
use crate::{KernelError, check};

/// Filters with the fastest instruction set of this machine: for each pass all targets.
///
/// # Errors
/// As [`NlmParams::check`].
///
/// ```
/// use noisefloor_kernels::nlm::{Channel, NlmInputs, NlmParams, Pass, Planes, filter};
///
/// // A step of height 10 and noise of variance 1: the values on each side are averaged among themselves.
/// let noisy = [0.5, -0.5, 0.5, 10.5, 9.5, 10.5];
/// let guide = vec![Channel { value: &noisy, variance: &[1.0; 6] }];
/// let frame = Planes { guide, features: vec![], targets: vec![&noisy] };
/// let inputs = NlmInputs { frame, neighbors: vec![], perturbation: None };
/// let pass = Pass { patch: Some(0), floor: 1e-3, derivative: false };
///
/// let filtered = &filter(&NlmParams::new(6, 1, 5, 0.45), &[pass], &inputs)?[0];
/// assert!(filtered.planes[0][..3].iter().all(|v| (v - 0.5 / 3.0).abs() < 1e-6));
/// assert!(filtered.weight_sum.iter().all(|w| (w - 3.0).abs() < 1e-6));
/// # Ok::<(), noisefloor_kernels::KernelError>(())
/// ```
pub fn filter(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
) -> Result<Vec<Filtered>, KernelError> {
    filter_at(params, passes, inputs, InstructionSet::in_use())
}

/// Filters with a given instruction set. Every level gives the same bits.
///
/// # Errors
/// As [`NlmParams::check`], and [`KernelError::LevelUnavailable`].
pub fn filter_at(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
    level: InstructionSet,
) -> Result<Vec<Filtered>, KernelError> {
    params.check(passes, inputs)?;
    check::available(level)?;
    Ok(in_tiles(params, passes, inputs, level, None))
}

/// Runs checked passes in the form that their rules ask for, in tiles of its own size or another.
pub(crate) fn in_tiles(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
    level: InstructionSet,
    tile: Option<(usize, usize)>,
) -> Vec<Filtered> {
    if params.rules == WeightRules::default() {
        tiled::filter(params, passes, inputs, level, tile.unwrap_or(tile_of(inputs)))
    } else {
        maps::filter(params, passes, inputs, level, tile.unwrap_or(maps::TILE))
    }
}

/// Size of tiles of the fused form: taller ones compute fewer distances of patches that lie across their borders, as long as
/// the planes of what they read at neighbours stay in the second cache.
fn tile_of(inputs: &NlmInputs<'_>) -> (usize, usize) {
    let (width, height) = TILE;
    (width, if inputs.frame.features.is_empty() { 2 * height } else { height })
}
