use noisefloor_frame::Image;

/// The sRGB transfer curve (IEC 61966-2-1) of a linear value in [0, 1].
#[must_use]
pub fn srgb_curve(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The tone map of PSNR and SSIM: sRGB curve of clamp(x, 0, 1), exposure 1; NaN becomes 0.
#[must_use]
pub(crate) fn tone(x: f32) -> f64 {
    srgb_curve(if x.is_nan() { 0.0 } else { f64::from(x.clamp(0.0, 1.0)) })
}

/// An image as PSNR and SSIM see it, times 2^`exposure` before the clamp; values in [0, 1].
#[must_use]
pub fn tone_map(image: &Image, exposure: f32) -> Image {
    let factor = exposure.exp2();
    image.map(|x| tone(x * factor) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_has_its_known_points() {
        assert_eq!(srgb_curve(0.0), 0.0);
        assert!((srgb_curve(1.0) - 1.0).abs() < 1e-12);
        // Mid grey 0.5 encodes to 187.5 of 255; the two branches meet to 1e-7.
        assert!((srgb_curve(0.5) - 0.735_356_983).abs() < 1e-8);
        assert!((srgb_curve(0.003_130_8) - srgb_curve(0.003_130_800_001)).abs() < 1e-7);
    }

    #[test]
    fn anything_outside_the_unit_interval_is_clamped() {
        let image = Image::from_vec(5, 1, 1, vec![-1.0, f32::NAN, 2.0, f32::INFINITY, 0.25]).unwrap();
        let mapped = tone_map(&image, 2.0);
        assert_eq!(mapped.data(), [0.0, 0.0, 1.0, 1.0, 1.0]);
    }
}
