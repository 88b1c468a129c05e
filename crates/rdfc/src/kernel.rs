//! Images to the planes of the engine and back.
//!
//! The engine, [`noisefloor_kernels::nlm`], is `flt` of Sec. 7: the weighted mean over a window, Eq. 1, with weights from
//! patches of the colour, Eq. 2, weights from features, Eq. 3, and the smaller of the two, Eq. 4. Its naive twin has one
//! function for each.

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;
use noisefloor_kernels::KernelError;
use noisefloor_kernels::nlm::{Channel, Filtered, MAX_VALUE, NlmInputs, NlmParams, Pass, Planes, filter};

/// Channels of a guide.
pub(crate) fn channels<'a>(value: &'a Image, variance: &'a Image) -> Vec<Channel<'a>> {
    value.planes().zip(variance.planes()).map(|(value, variance)| Channel { value, variance }).collect()
}

/// Planes of both halves, A first.
pub(crate) fn half_planes(halves: &[Image; 2]) -> Vec<&[f32]> {
    halves.iter().flat_map(Image::planes).collect()
}

/// Filters `targets` with weights from a guide alone: Eq. 1 and Eq. 2, k_f = ∞.
pub(crate) fn filter_guided(
    method: &str,
    params: &NlmParams,
    patch: usize,
    guide: Vec<Channel<'_>>,
    targets: Vec<&[f32]>,
) -> Result<Filtered, DenoiseError> {
    let frame = Planes { guide, features: Vec::new(), targets };
    let inputs = NlmInputs { frame, neighbors: Vec::new(), perturbation: None };
    // τ has no say without features.
    let pass = Pass { patch: Some(patch), floor: 1.0, derivative: false };
    let mut filtered = filter(params, &[pass], &inputs).map_err(|e| kernel_error(method, &e))?;
    Ok(filtered.remove(0)) // one for each pass
}

/// An image from consecutive planes.
pub(crate) fn image(planes: &[Vec<f32>], width: usize, height: usize) -> Image {
    Image::from_vec(width, height, planes.len(), planes.concat())
        .expect("the engine gives one value per pixel and plane")
}

/// Both halves from filtered planes, A first.
pub(crate) fn halves(planes: &[Vec<f32>], width: usize, height: usize) -> [Image; 2] {
    let (a, b) = planes.split_at(planes.len() / 2);
    [image(a, width, height), image(b, width, height)]
}

/// Keeps values that only rounding can have pushed beyond it within the engine's range.
pub(crate) fn within_range(image: Image) -> Image {
    image.map(|v| v.clamp(-MAX_VALUE, MAX_VALUE))
}

/// The engine refuses what was checked before it ran; should it find more, its message is kept.
pub(crate) fn kernel_error(method: &str, error: &KernelError) -> DenoiseError {
    DenoiseError::of_kernel(method, error)
}
