//! The flash image F = F0 + I·S from its parts.

use noisefloor_frame::{Image, luminance};

/// Value at `percent` of the sorted finite values (nearest rank); 0 if there is none.
pub(crate) fn percentile(values: impl Iterator<Item = f32>, percent: f64) -> f64 {
    let mut values: Vec<f32> = values.filter(|v| v.is_finite()).collect();
    if values.is_empty() {
        return 0.0;
    }
    let rank = (percent / 100.0 * values.len() as f64).ceil() as usize;
    let index = rank.clamp(1, values.len()) - 1;
    f64::from(*values.select_nth_unstable_by(index, f32::total_cmp).1)
}

fn luminances(image: &Image) -> impl Iterator<Item = f32> + '_ {
    (0..image.pixels()).map(|p| luminance([0, 1, 2].map(|c| image.plane(c)[p])))
}

/// I = max(0, Σ (L(N) − L(F0)) / Σ L(S)): the flash light makes up for the light that F0 lacks (Sec. 3.1).
///
/// L(N) and L(F0) are both clipped at the given percentile of L(N), so that neither a firefly nor a visible lamp, which both
/// images show, sets the intensity. Pixels with a non-finite value are left out. Without any light in S the intensity is 0.
pub(crate) fn intensity(color: &Image, base: &Image, light: &Image, clip_percentile: f64) -> f64 {
    let clip = percentile(luminances(color), clip_percentile);
    let (mut missing, mut flash) = (0.0, 0.0);
    for ((n, f0), s) in luminances(color).zip(luminances(base)).zip(luminances(light)) {
        if n.is_finite() && f0.is_finite() && s.is_finite() {
            missing += f64::from(n).min(clip) - f64::from(f0).min(clip);
            flash += f64::from(s);
        }
    }
    if flash > 0.0 && missing > 0.0 { missing / flash } else { 0.0 }
}

/// F = F0 + I·S.
pub(crate) fn sum(base: &Image, light: &Image, intensity: f64) -> Image {
    base.zip_map(light, |f0, s| (f64::from(f0) + intensity * f64::from(s)) as f32)
}

/// var(F) = var(F0) + 2I·cov + I²·var(S), at least 0. An unknown covariance counts as 0.
pub(crate) fn variance(base: &Image, light: &Image, covariance: Option<&Image>, intensity: f64) -> Image {
    let mut out = base.clone();
    for (i, value) in out.data_mut().iter_mut().enumerate() {
        let shared = covariance.map_or(0.0, |image| f64::from(image.data()[i]));
        let light = f64::from(light.data()[i]);
        *value = (f64::from(*value) + intensity * (2.0 * shared + intensity * light)).max(0.0) as f32;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentile_is_the_nearest_rank_of_the_finite_values() {
        let values = || [3.0, f32::NAN, 1.0, 2.0, f32::INFINITY, 4.0].into_iter();
        for (percent, expected) in [(0.1, 1.0), (25.0, 1.0), (25.1, 2.0), (99.9, 4.0), (100.0, 4.0)] {
            assert_eq!(percentile(values(), percent), expected, "{percent} %");
        }
        assert_eq!(percentile([f32::NAN].into_iter(), 50.0), 0.0);
    }

    #[test]
    fn intensity_makes_up_for_the_light_that_is_missing() {
        let image = |v: f32| Image::filled(8, 4, 3, v);
        assert!((intensity(&image(1.0), &image(0.4), &image(0.2), 99.9) - 3.0).abs() < 1e-6);
        assert_eq!(intensity(&image(0.4), &image(1.0), &image(0.2), 99.9), 0.0, "never negative");
        assert_eq!(intensity(&image(1.0), &image(0.4), &image(0.0), 99.9), 0.0, "no light to scale");
    }

    #[test]
    fn neither_a_firefly_nor_a_visible_lamp_sets_the_intensity() {
        let spot = |background: f32, bright: f32| {
            Image::from_fn(100, 100, 3, |_, x, y| if (x, y) == (7, 9) { bright } else { background })
        };
        let quiet = intensity(&spot(1.0, 1.0), &spot(0.4, 0.4), &spot(0.2, 0.2), 99.9);
        let firefly = intensity(&spot(1.0, 1e6), &spot(0.4, 0.4), &spot(0.2, 0.2), 99.9);
        let lamp = intensity(&spot(1.0, 1e6), &spot(0.4, 1e6), &spot(0.2, 0.2), 99.9);
        assert!((firefly / quiet - 1.0).abs() < 1e-4 && (lamp / quiet - 1.0).abs() < 1e-3);
    }

    #[test]
    fn variance_of_the_sum_has_its_cross_term_and_is_never_negative() {
        let image = |v: f32| Image::filled(1, 1, 3, v);
        let var =
            |cov: Option<f32>| variance(&image(1.0), &image(0.25), cov.map(image).as_ref(), 2.0).get(0, 0, 0);
        assert_eq!((var(None), var(Some(0.5)), var(Some(-0.375)), var(Some(-1.0))), (2.0, 4.0, 0.5, 0.0));
        assert_eq!(sum(&image(1.0), &image(0.25), 2.0).get(1, 0, 0), 1.5);
    }
}
