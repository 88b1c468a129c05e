//! The virtual-flash filter of moon2013flash: a mean over homogeneous pixels, weighted by distance in the image and
//! by likeness of the flash image.
//!
//! For each pixel p, with x̄ the source, F the guide, Ω_p the window clipped to the image:
//!
//! ```text
//! H(p)   = { q ∈ Ω_p : |x̄_q − x̄_p| ≤ τ_p + 4·eps·max(|x̄_p|, |x̄_q|) }          τ_p = t·s_p/√n_p
//! d²     = Σ_j G(j) · ⅓ Σ_c (F_c(p+j) − F_c(q+j))²                              Σ_j G(j) = 1
//! w(p,q) = exp(−|p−q|²/(2σ_s²)) · exp(−d²/(2σ_r²(p)))
//! D_p    = x̄_p + Σ_{q∈H(p)} w(p,q)·(x̄_q − x̄_p) / Σ_{q∈H(p)} w(p,q)
//! ```
//!
//! p is always in H(p) with weight 1. Patch taps outside the image read the mirrored pixel (index −i reads i).
//! Whatever the input, |D_c(p) − x̄_c(p)| ≤ τ_c(p) up to rounding, in every pixel and in every channel that is
//! tested: all three for [`Membership::Joint`] and [`Membership::PerChannel`], luminance alone for
//! [`Membership::Luminance`].

mod diagnostics;
mod error;
mod hot;
mod layout;
mod members;
pub mod naive;
mod params;
#[cfg(test)]
mod tests;
mod tiled;

pub use diagnostics::{HomogeneousWindow, homogeneous_counts, homogeneous_window};
pub use error::FlashFilterError;
pub use members::{half_width, luminance};
pub use params::{
    FlashInputs, FlashParams, Guide, MAX_PATCH_RADIUS, MAX_PIXELS, MAX_SOURCE, MAX_WINDOW_RADIUS, Membership,
    PatchWeights,
};

use crate::Level;

/// Filters with the fastest instruction set of this machine. Returns three planes of width·height values.
///
/// # Errors
/// As [`FlashParams::check`].
///
/// ```
/// use noisefloor_kernels::flash_filter::{FlashInputs, FlashParams, Membership, PatchWeights, filter};
///
/// // Without a test and without a guide this is a Gaussian blur, clipped at the border.
/// let params = FlashParams {
///     width: 3,
///     height: 1,
///     window_radius: 1,
///     spatial_sigma: f32::INFINITY,
///     patch: PatchWeights::gaussian(2, 1.25)?,
/// };
/// let plane = [0.0, 3.0, 6.0];
/// let inputs = FlashInputs { source: [&plane; 3], membership: Membership::Off, guide: None };
/// assert_eq!(filter(&params, &inputs)?[0], [1.5, 3.0, 4.5]);
///
/// // A half-width of 1 keeps such unequal neighbours out.
/// let membership = Membership::Joint([&[1.0; 3]; 3]);
/// assert_eq!(filter(&params, &FlashInputs { membership, ..inputs })?[0], plane);
/// # Ok::<(), noisefloor_kernels::flash_filter::FlashFilterError>(())
/// ```
pub fn filter(params: &FlashParams, inputs: &FlashInputs<'_>) -> Result<[Vec<f32>; 3], FlashFilterError> {
    params.check(inputs)?;
    let mut out = [(); 3].map(|()| vec![0.0; params.width * params.height]);
    let [r, g, b] = &mut out;
    tiled::filter(params, inputs, Level::best(), tiled::TILE, [r, g, b]);
    Ok(out)
}

/// Filters into three planes with a given instruction set. Every level gives the same bits.
///
/// # Errors
/// As [`FlashParams::check`] for parameters, inputs and outputs, and [`FlashFilterError::LevelUnavailable`].
pub fn filter_into(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    level: Level,
    out: [&mut [f32]; 3],
) -> Result<(), FlashFilterError> {
    params.check(inputs)?;
    if !level.is_available() {
        return Err(FlashFilterError::LevelUnavailable { level });
    }
    let expected = params.width * params.height;
    for (plane, values) in ["output 0", "output 1", "output 2"].into_iter().zip(&out) {
        if values.len() != expected {
            return Err(FlashFilterError::PlaneLength { plane, expected, actual: values.len() });
        }
    }
    tiled::filter(params, inputs, level, tiled::TILE, out);
    Ok(())
}
