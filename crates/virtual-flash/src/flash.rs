//! The flash image F = F0 + I·S from its parts (Sec. 3.1): F0, the light of the original sources over the paths that are kept,
//! and S, shading by a point light at the eye without a visibility test. Which paths are kept is the renderer's part.

use noisefloor_frame::{Image, luminance};
use noisefloor_toolbox::percentile;
use rayon::prelude::*;

/// Values or pixels that one thread handles at a time; ours.
pub(crate) const CHUNK: usize = 1 << 14;

/// One value for each pixel from its three channels.
pub(crate) fn per_pixel(image: &Image, value: impl Fn([f32; 3]) -> f32 + Sync) -> Vec<f32> {
    let [r, g, b] = [0, 1, 2].map(|c| image.plane(c).par_chunks(CHUNK));
    let mut out = vec![0.0; image.pixels()];
    out.par_chunks_mut(CHUNK).zip(r).zip(g).zip(b).for_each(|(((out, r), g), b)| {
        for (((out, &r), &g), &b) in out.iter_mut().zip(r).zip(g).zip(b) {
            *out = value([r, g, b]);
        }
    });
    out
}

/// Light of a frame, summed over its pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Light {
    /// Σ (L(N) − L(F0)).
    pub missing: f64,
    /// Σ L(S).
    pub flash: f64,
}

/// I = max(0, Σ (L(N) − L(F0)) / Σ L(S)): the flash light makes up for the light that F0 lacks (Sec. 3.1, which says so in words;
/// the formula is ours).
///
/// One for all frames of a volume: with one for each the same surface would differ from frame to frame. Without any light in S
/// the intensity is 0.
pub(crate) fn intensity(frames: impl IntoIterator<Item = Light>) -> f64 {
    let (missing, flash) =
        frames.into_iter().fold((0.0, 0.0), |sum, light| (sum.0 + light.missing, sum.1 + light.flash));
    if flash > 0.0 && missing > 0.0 { missing / flash } else { 0.0 }
}

/// The sums that the intensity comes from.
///
/// L(N) and L(F0) are both clipped at the given percentile of L(N), so that neither a firefly nor a visible lamp, which both
/// images show, sets the intensity. Pixels with a non-finite value are left out.
pub(crate) fn light_of(color: &Image, base: &Image, light: &Image, clip_percentile: f64) -> Light {
    let [n, f0, s] = [color, base, light].map(|image| per_pixel(image, luminance));
    let clip = percentile(n.clone(), clip_percentile);
    // Parts of fixed size, added in order: the same sum for any number of threads.
    let parts: Vec<(f64, f64)> = (n.par_chunks(CHUNK), f0.par_chunks(CHUNK), s.par_chunks(CHUNK))
        .into_par_iter()
        .map(|(n, f0, s)| {
            let (mut missing, mut flash) = (0.0, 0.0);
            for ((&n, &f0), &s) in n.iter().zip(f0).zip(s) {
                if n.is_finite() && f0.is_finite() && s.is_finite() {
                    missing += f64::from(n).min(clip) - f64::from(f0).min(clip);
                    flash += f64::from(s);
                }
            }
            (missing, flash)
        })
        .collect();
    let (missing, flash) = parts.into_iter().fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
    Light { missing, flash }
}

/// F = F0 + I·S: the two parts of Sec. 3.1.
pub(crate) fn sum(base: &Image, light: &Image, intensity: f64) -> Image {
    let mut out = base.clone();
    out.data_mut().par_chunks_mut(CHUNK).zip(light.data().par_chunks(CHUNK)).for_each(|(out, light)| {
        for (out, &s) in out.iter_mut().zip(light) {
            *out = (f64::from(*out) + intensity * f64::from(s)) as f32;
        }
    });
    out
}

/// var(F) = var(F0) + 2I·cov + I²·var(S), at least 0. An unknown covariance counts as 0. Ours: Sec. 4 asks for the noise of F.
pub(crate) fn variance(base: &Image, light: &Image, covariance: Option<&Image>, intensity: f64) -> Image {
    let mut out = base.clone();
    let sum = |base: f32, shared: f32, light: f32| {
        let (base, shared, light) = (f64::from(base), f64::from(shared), f64::from(light));
        (base + intensity * (2.0 * shared + intensity * light)).max(0.0) as f32
    };
    out.data_mut().par_chunks_mut(CHUNK).zip(light.data().par_chunks(CHUNK)).enumerate().for_each(
        |(chunk, (out, light))| match covariance.map(|image| &image.data()[chunk * CHUNK..]) {
            None => out.iter_mut().zip(light).for_each(|(out, &light)| *out = sum(*out, 0.0, light)),
            Some(shared) => {
                for ((out, &light), &shared) in out.iter_mut().zip(light).zip(shared) {
                    *out = sum(*out, shared, light);
                }
            }
        },
    );
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn intensity(color: &Image, base: &Image, light: &Image, clip_percentile: f64) -> f64 {
        super::intensity([light_of(color, base, light, clip_percentile)])
    }

    #[test]
    fn frames_of_a_volume_share_one_intensity() {
        let light = |missing, flash| Light { missing, flash };
        assert_eq!(super::intensity([light(6.0, 2.0), light(2.0, 2.0)]), 2.0);
        // A frame that lacks nothing lowers that of the others.
        assert_eq!(super::intensity([light(6.0, 2.0), light(-2.0, 2.0)]), 1.0);
        assert_eq!(super::intensity([light(1.0, 0.0), light(1.0, 0.0)]), 0.0);
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
