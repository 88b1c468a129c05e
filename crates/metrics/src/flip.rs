//! HDR-FLIP (P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range
//! Images", Eurographics 2021 Short Papers): the largest LDR-FLIP of each pixel over a range of exposures.

use flip_rs::{HdrOptions, RgbImage, hdr_flip};

use crate::MetricError;
use crate::pixels::Pixels;

/// The exposures are those at which the reference's brightest pixel and its median reach 85 % of the display: below this
/// luminance everywhere there are none.
const DARKEST: f32 = 1e-6;

/// HDR-FLIP of every pixel. What does not take part shows no difference: both images are the reference there, or black
/// where that is not finite.
pub(crate) fn hdr_flip_map(pixels: &Pixels<'_>) -> Result<Option<Vec<f64>>, MetricError> {
    let failed =
        |error: flip_rs::FlipError| MetricError::Failed { id: "hdr_flip", reason: error.to_string() };
    let (width, height, n) = (pixels.test.width(), pixels.test.height(), pixels.test.pixels());
    // Interleaved, as the crate wants it; max(x, 0) is 0 for NaN.
    let mut both = [&pixels.reference, &pixels.test].map(|image| {
        let at = |i: usize| image.data()[i % 3 * n + i / 3];
        (0..3 * n).map(|i| if at(i).is_finite() { at(i).max(0.0) } else { 0.0 }).collect::<Vec<f32>>()
    });
    let [reference, test] = &mut both;
    for p in (0..n).filter(|&p| !pixels.valid[p]) {
        test[3 * p..3 * p + 3].copy_from_slice(&reference[3 * p..3 * p + 3]);
    }
    let brightest = |rgb: &[f32]| rgb.chunks_exact(3).any(|c| c.iter().any(|&value| value > DARKEST));
    if !brightest(reference) {
        return Ok(None);
    }
    let [reference, test] = both.map(|rgb| RgbImage::new(width, height, rgb).map_err(failed));
    let mut options = HdrOptions::default();
    options.return_exposure_map = false;
    let flip = hdr_flip(&reference?, &test?, options).map_err(failed)?;
    Ok(Some(flip.error_map.pixels().iter().map(|&v| f64::from(v)).collect()))
}
