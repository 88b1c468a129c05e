//! The guide image, its variance, and the width of the range weights.

use noisefloor_frame::{Flash, Frame, Image, Variance};
use noisefloor_kernels::flash_filter::PatchWeights;
use noisefloor_kernels::mirror;
use rayon::prelude::*;

use crate::flash::{self, percentile};
use crate::{GuideKind, Params};

/// What range weights are computed from.
#[derive(Debug, Clone)]
pub(crate) struct Guide {
    /// F.
    pub image: Image,
    /// 1/(2σ_r²) per pixel.
    pub inv_two_sigma_r2: Vec<f32>,
    /// Intensity I, if the flash came in parts.
    pub intensity: Option<f64>,
    /// Least and largest σ_r.
    pub sigma_r: (f64, f64),
}

impl Guide {
    /// `None` if the parameters ask for none, or if the frame lacks the buffers (its needs say so before).
    pub fn new(frame: &Frame, params: &Params, patch: &PatchWeights) -> Option<Self> {
        match params.guide {
            GuideKind::None => None,
            GuideKind::Color => {
                let variance = frame.color.variance.as_ref()?.mean_variance();
                Some(Self::with_variance(frame.color.mean.clone(), variance, None, params, patch))
            }
            GuideKind::Flash => match frame.flash.as_ref()? {
                Flash::Ready(flash) => {
                    let variance = flash.variance.as_ref()?.mean_variance();
                    Some(Self::with_variance(flash.mean.clone(), variance, None, params, patch))
                }
                Flash::Parts { base, light, covariance } => {
                    let base_variance = base.variance.as_ref().map(Variance::mean_variance)?;
                    let light_variance = light.variance.as_ref().map(Variance::mean_variance)?;
                    let clip = params.luminance_clip_percentile;
                    let intensity = params.intensity_scale
                        * flash::intensity(&frame.color.mean, &base.mean, &light.mean, clip);
                    let image = flash::sum(&base.mean, &light.mean, intensity);
                    let variance =
                        flash::variance(base_variance, light_variance, covariance.as_ref(), intensity);
                    Some(Self::with_variance(image, &variance, Some(intensity), params, patch))
                }
            },
        }
    }

    /// σ_r²(p) = κ²·mean over patch and channels of the guide's variance, at least (floor·bright level)².
    fn with_variance(
        image: Image,
        variance: &Image,
        intensity: Option<f64>,
        params: &Params,
        patch: &PatchWeights,
    ) -> Self {
        let magnitudes = |p: usize| {
            image.planes().map(|plane| plane[p].abs()).fold(0.0f32, |a, b| if b > a { b } else { a })
        };
        let bright = percentile((0..image.pixels()).map(magnitudes), params.luminance_clip_percentile);
        let floor = (params.guide_floor * bright).powi(2);
        let mut range = (f64::INFINITY, 0.0f64);
        let inv_two_sigma_r2 = patch_mean(variance, patch)
            .into_iter()
            .map(|mean| {
                let sigma2 = (params.kappa * params.kappa * mean).max(floor);
                range = (range.0.min(sigma2), range.1.max(sigma2));
                // A width of zero gives the largest finite value: only equal patches count then.
                (0.5 / sigma2).min(f64::from(f32::MAX)) as f32
            })
            .collect();
        Self { image, inv_two_sigma_r2, intensity, sigma_r: (range.0.sqrt(), range.1.sqrt()) }
    }
}

/// Mean over the channels, averaged with the patch weights; taps outside the image read the mirrored pixel.
fn patch_mean(image: &Image, patch: &PatchWeights) -> Vec<f64> {
    let (width, height) = (image.width(), image.height());
    let [r, g, b] = [0, 1, 2].map(|c| image.plane(c));
    let radius = patch.radius() as isize;
    let taps: Vec<f64> = (-radius..=radius).map(|i| patch.tap(i.unsigned_abs())).collect();
    let across: Vec<Vec<f64>> = (0..height)
        .into_par_iter()
        .map(|y| {
            // `max` also turns a NaN of an input that was not sanitised into 0.
            let value = |p: usize| (f64::from(r[p]) + f64::from(g[p]) + f64::from(b[p])).max(0.0) / 3.0;
            let padded: Vec<f64> =
                (-radius..width as isize + radius).map(|x| value(y * width + mirror(x, width))).collect();
            padded.windows(taps.len()).map(|part| part.iter().zip(&taps).map(|(v, t)| v * t).sum()).collect()
        })
        .collect();
    let down = (0..height as isize).into_par_iter().flat_map_iter(|y| {
        let mut sum = vec![0.0; width];
        for (j, tap) in (-radius..=radius).zip(&taps) {
            let row = &across[mirror(y + j, height)];
            sum.iter_mut().zip(row).for_each(|(sum, v)| *sum += tap * v);
        }
        sum
    });
    down.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn range_width_is_kappa_times_the_standard_error_where_the_variance_is_constant() {
        let patch = PatchWeights::gaussian(2, 1.25).unwrap();
        let variance = Image::from_fn(9, 5, 3, |c, _, _| [0.01, 0.02, 0.03][c]);
        let params = Params::default();
        let guide = Guide::with_variance(Image::filled(9, 5, 3, 1.0), &variance, None, &params, &patch);
        for inv in guide.inv_two_sigma_r2 {
            assert!((inv - 1.0 / (2.0 * 4.0 * 0.02)).abs() < 1e-4, "{inv}");
        }
        assert!((guide.sigma_r.0 - 0.08f64.sqrt()).abs() < 1e-6 && guide.sigma_r.1 < 0.2829);
    }

    #[test]
    fn noise_free_guide_falls_back_to_the_floor_and_a_black_one_to_exact_equality() {
        let patch = PatchWeights::gaussian(2, 1.25).unwrap();
        let params = Params::default();
        let none = Image::new(4, 4, 3);
        let guide = Guide::with_variance(Image::filled(4, 4, 3, 2.0), &none, None, &params, &patch);
        let expected = 0.5 / (1e-4f64 * 2.0).powi(2);
        assert!((f64::from(guide.inv_two_sigma_r2[0]) / expected - 1.0).abs() < 1e-6);
        let black = Guide::with_variance(none.clone(), &none, None, &params, &patch);
        assert_eq!(black.inv_two_sigma_r2, [f32::MAX; 16]);
    }

    #[test]
    fn patch_mean_mirrors_at_the_border_without_repeating_the_edge() {
        let patch = PatchWeights::uniform(1).unwrap();
        let image = Image::from_fn(3, 1, 3, |_, x, _| [3.0, 6.0, 12.0][x]);
        let mean = patch_mean(&image, &patch);
        for (got, expected) in mean.iter().zip([5.0, 7.0, 8.0]) {
            assert!((got - expected).abs() < 1e-12, "{mean:?}");
        }
    }
}
