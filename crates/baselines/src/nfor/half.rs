//! What two halves say together.

use noisefloor_frame::Image;

use super::kernel::MOST_SQUARE;

/// (A + B)/2.
pub(super) fn mean(a: &Image, b: &Image) -> Image {
    a.zip_map(b, |a, b| (0.5 * (f64::from(a) + f64::from(b))) as f32)
}

/// (B − A)²/4: of the variance of their mean.
pub(super) fn variance(a: &Image, b: &Image) -> Image {
    a.zip_map(b, |a, b| {
        let difference = f64::from(b) - f64::from(a);
        (0.25 * difference * difference).min(f64::from(MOST_SQUARE)) as f32
    })
}
