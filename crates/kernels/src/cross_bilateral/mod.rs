//! Bank of cross-bilateral filters (T.-M. Li, Y.-T. Wu, Y.-Y. Chuang, *SURE-based Optimization for Adaptive Sampling and
//! Reconstruction*, ACM Transactions on Graphics 31(6), 2012; li2012sbf): means over a window, weighted by distance in the
//! image and by guides, for several window sizes at once.
//!
//! ```text
//! D(p,q)   = Σ_k (f_k(p) − f_k(q))² / max(S_k(p) + S_k(q), floor) / (2σ_k²)
//! w_i(p,q) = exp(−|p − q|²/(2σ_i²) − D(p,q))
//! W_i(p)   = Σ_q w_i(p,q)
//! out_i(p) = Σ_q w_i(p,q)·x(q) / W_i(p)
//! ```
//!
//! f_k are guide channels, S_k their variances as they are handed in, σ_k their bandwidths. Each filter i has a spatial σ_i and a
//! radius of its own; q runs over the square window of that radius, clipped to the image. Any number of planes x, of either
//! sign, are averaged with the same weights, and W_i comes out beside them. Weights below 1.2e-38, where the exponent is
//! beyond 87, are 0.
//!
//! A pixel has weight 1 for itself, so W_i ≥ 1 and the division is safe. What is averaged enters linearly: a common power of two
//! scales the result without rounding, and a constant plane comes back to what sums in `f32` keep.
//!
//! D belongs to a pair of pixels, whatever the filter: the fast form computes exp(−D) once, over the largest window, and each filter
//! multiplies it by its own factors from a table.

mod distances;
mod layout;
pub mod naive;
mod params;
mod rows;
mod sums;
mod tile;

use crate::engine::for_each_tile;
use crate::{InstructionSet, KernelError};
use layout::{Layout, TILE, Work};

pub use params::{
    BilateralGuide, BilateralParams, MAX_AVERAGED, MAX_FILTERS, MAX_GUIDES, MAX_MAGNITUDE, MAX_PIXELS,
    MAX_RADIUS, MAX_VALUE, MAX_VARIANCE, Spatial,
};

/// What one filter of a bank gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Filtered<R = f32> {
    /// The averaged planes, in the order of the inputs and in their units.
    pub planes: Vec<Vec<R>>,
    /// W, at least 1.
    pub weights: Vec<R>,
}

/// Filters every plane with every filter of `bank`, with the fastest instruction set of this machine. One [`Filtered`] for each
/// filter; what it holds does not depend on the others.
///
/// # Errors
/// As [`BilateralParams::check`].
///
/// ```
/// use noisefloor_kernels::cross_bilateral::{BilateralGuide, BilateralParams, Spatial, filter};
///
/// // Noise on both sides of an edge that the guide shows.
/// let edge: Vec<f32> = (0..16).map(|x| if x < 8 { 0.0 } else { 1.0 }).collect();
/// let noisy: Vec<f32> = edge.iter().enumerate().map(|(x, v)| v + if x % 2 == 0 { 0.1 } else { -0.1 }).collect();
/// let guide = BilateralGuide { value: &edge, variance: &[0.0; 16], sigma: 0.25 };
/// let params = BilateralParams { width: 16, height: 1, floor: 0.01 };
/// let bank = [Spatial::new(0.0), Spatial::new(4.0)];
/// let out = filter(&params, &[guide], &[&noisy], &bank)?;
/// assert_eq!(out[0].planes[0], noisy);
/// assert!((out[1].planes[0][7] - 0.0).abs() < 0.02 && (out[1].planes[0][8] - 1.0).abs() < 0.02);
/// # Ok::<(), noisefloor_kernels::KernelError>(())
/// ```
pub fn filter(
    params: &BilateralParams,
    guides: &[BilateralGuide<'_>],
    planes: &[&[f32]],
    bank: &[Spatial],
) -> Result<Vec<Filtered>, KernelError> {
    filter_at(params, guides, planes, bank, InstructionSet::in_use())
}

/// [`filter`] with a given instruction set. Every level gives the same bits; one that the processor does not have runs in
/// plain Rust.
///
/// # Errors
/// As [`BilateralParams::check`].
pub fn filter_at(
    params: &BilateralParams,
    guides: &[BilateralGuide<'_>],
    planes: &[&[f32]],
    bank: &[Spatial],
    level: InstructionSet,
) -> Result<Vec<Filtered>, KernelError> {
    params.check(guides, planes, bank)?;
    let layout = Layout::new(params, guides.len(), planes.len(), bank);
    let pixels = params.width * params.height;
    let mut out: Vec<Filtered> = bank
        .iter()
        .map(|spatial| {
            // A window of one pixel averages nothing.
            if layout.reach(spatial) == 0 {
                let planes = planes.iter().map(|plane| plane.to_vec()).collect();
                return Filtered { planes, weights: vec![1.0; pixels] };
            }
            Filtered { planes: vec![vec![0.0; pixels]; planes.len()], weights: vec![0.0; pixels] }
        })
        .collect();
    let filtered = out.iter_mut().zip(bank).filter(|(_, spatial)| layout.reach(spatial) > 0);
    for_each_tile(
        params.width,
        TILE,
        filtered.flat_map(|(of, _)| of.planes.iter_mut().chain([&mut of.weights]).map(Vec::as_mut_slice)),
        || Work::new(&layout),
        |work, tile, out| {
            level.run(tile::Filter { params, guides, planes, layout: &layout, work, tile, out });
        },
    );
    Ok(out)
}
