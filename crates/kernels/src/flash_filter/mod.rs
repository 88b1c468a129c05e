//! The virtual-flash filter of moon2013flash (Sec. 3.2 and 3.3): a mean over homogeneous pixels, weighted by distance in the
//! image and by likeness of the flash image.
//!
//! For each pixel p, with x̄ the source, F the guide, Ω_p the window clipped to the image:
//!
//! ```text
//! Eq. 2            H(p)   = { q ∈ Ω_p : |x̄_q − x̄_p| ≤ τ_p + 4·eps·max(|x̄_p|, |x̄_q|) }          τ_p = t·s_p/√n_p
//! Sec. 3.2         d²     = Σ_j G(j) · ⅓ Σ_c (F_c(p+j) − F_c(q+j))²                              Σ_j G(j) = 1
//! ours             σ_r²   = min(σ_r²(p), σ_r²(q))
//! Eq. 1, g_s, g_r  w(p,q) = exp(−|p−q|²/(2σ_s²)) · exp(−d²/(2σ_r²))
//! Eq. 1            D_p    = x̄_p + Σ_{q∈H(p)} w(p,q)·(x̄_q − x̄_p) / Σ_{q∈H(p)} w(p,q)
//! ```
//!
//! Eq. 1 is printed as the weighted sum over k(p), the sum of the weights: the same, but for its rounding. Ours are the third
//! of the channels in d² and the allowance for rounding in H(p).
//!
//! p is always in H(p) with weight 1. Patch taps outside the image read the mirrored pixel (index −i reads i).
//! Whatever the input, |D_c(p) − x̄_c(p)| ≤ τ_c(p) (App. A, Eq. 6) up to rounding, in every pixel and in every channel that is
//! tested: all three for [`Membership::Joint`] and [`Membership::PerChannel`], luminance alone for
//! [`Membership::Luminance`].
//!
//! # Animations
//!
//! With frames beside the target the images are a volume and windows and patches are cubes in it (Sec. 4, denoising
//! animations): q is a pixel of any frame at most r frames away, and j goes over the taps of 2f+1 frames. What the section does not
//! say is ours:
//!
//! * The distance |p−q| has three dimensions, a frame counting as a pixel: so g_s falls along time as it does along rows.
//! * The half-width is that of p, whatever the frame of q; so the bound holds as before.
//! * The window is clipped to the frames that are there, as to the image. Of a patch those taps count whose frames are there
//!   for both pixels, and G is scaled to Σ_j G(j) = 1 over them.
//!
//! Nothing follows motion: a pixel is compared with what is in its place and around it in the other frames. The time taken is that of
//! one frame for each frame of the window, times three to four where patches are cubes of 5 frames.

mod diagnostics;
mod error;
mod hot;
mod layout;
mod members;
pub mod naive;
mod params;
pub(crate) mod tiled;
mod volume;

pub use diagnostics::{HomogeneousWindow, homogeneous_counts, homogeneous_window};
pub use error::FlashFilterError;
pub use members::{half_width, luminance};
pub use params::{
    Carried, Filtered, FlashInputs, FlashParams, Guide, MAX_NEIGHBORS, MAX_PATCH_RADIUS, MAX_PIXELS,
    MAX_SOURCE, MAX_WINDOW_RADIUS, Membership, Neighbor, PatchWeights,
};

use crate::engine::{InstructionSet, TILE};

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
/// let inputs = FlashInputs {
///     source: [&plane; 3],
///     membership: Membership::Off,
///     guide: None,
///     before: &[],
///     after: &[],
/// };
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
    tiled::filter(params, inputs, None, InstructionSet::in_use(), TILE, [r, g, b].map(Vec::as_mut_slice));
    Ok(out)
}

/// As [`filter`], and sums other planes along with the same sets and weights.
///
/// # Errors
/// As [`FlashParams::check`] and [`FlashParams::check_carried`].
///
/// ```
/// use noisefloor_kernels::flash_filter::{
///     Carried, FlashInputs, FlashParams, Membership, PatchWeights, filter_carrying,
/// };
///
/// // The mean of two values of variance 1 has variance 1/2, that of three 1/3.
/// let params = FlashParams {
///     width: 3,
///     height: 1,
///     window_radius: 1,
///     spatial_sigma: f32::INFINITY,
///     patch: PatchWeights::gaussian(2, 1.25)?,
/// };
/// let inputs = FlashInputs {
///     source: [&[0.0; 3]; 3],
///     membership: Membership::Off,
///     guide: None,
///     before: &[],
///     after: &[],
/// };
/// let filtered = filter_carrying(&params, &inputs, &Carried::Variances([&[1.0; 3]; 3]))?;
/// assert_eq!(filtered.carried[0], [0.5, 1.0 / 3.0, 0.5]);
/// # Ok::<(), noisefloor_kernels::flash_filter::FlashFilterError>(())
/// ```
pub fn filter_carrying(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    carried: &Carried<'_>,
) -> Result<Filtered, FlashFilterError> {
    params.check(inputs)?;
    params.check_carried(inputs, carried)?;
    let planes = || [(); 3].map(|()| vec![0.0; params.width * params.height]);
    let mut out = Filtered { image: planes(), carried: planes() };
    let all = out.image.iter_mut().chain(&mut out.carried).map(Vec::as_mut_slice);
    tiled::filter(params, inputs, Some(carried), InstructionSet::in_use(), TILE, all);
    Ok(out)
}

/// [`filter_carrying`] into planes, first the image's and then the carried ones, with a given instruction set. Every
/// level gives the same bits.
///
/// # Errors
/// As [`filter_carrying`] and [`filter_into`].
pub fn filter_carrying_into(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    carried: &Carried<'_>,
    level: InstructionSet,
    [image, sums]: [[&mut [f32]; 3]; 2],
) -> Result<(), FlashFilterError> {
    params.check(inputs)?;
    params.check_carried(inputs, carried)?;
    check_output(params, level, &image)?;
    check_output(params, level, &sums)?;
    tiled::filter(params, inputs, Some(carried), level, TILE, image.into_iter().chain(sums));
    Ok(())
}

/// Filters into three planes with a given instruction set. Every level gives the same bits.
///
/// # Errors
/// As [`FlashParams::check`] for parameters, inputs and outputs, and [`FlashFilterError::LevelUnavailable`].
pub fn filter_into(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    level: InstructionSet,
    out: [&mut [f32]; 3],
) -> Result<(), FlashFilterError> {
    params.check(inputs)?;
    check_output(params, level, &out)?;
    tiled::filter(params, inputs, None, level, TILE, out);
    Ok(())
}

pub(crate) fn check_output(
    params: &FlashParams,
    level: InstructionSet,
    out: &[&mut [f32]; 3],
) -> Result<(), FlashFilterError> {
    if !level.is_available() {
        return Err(FlashFilterError::LevelUnavailable { level });
    }
    let expected = params.width * params.height;
    for (plane, values) in ["output 0", "output 1", "output 2"].into_iter().zip(out) {
        if values.len() != expected {
            return Err(FlashFilterError::PlaneLength { plane, expected, actual: values.len() });
        }
    }
    Ok(())
}
