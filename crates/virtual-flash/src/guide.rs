//! The guide image F (Sec. 3.1) and the width σ_r of the range weights (Eq. 1) that its noise asks for (Sec. 4).

use std::borrow::Cow;

use noisefloor_frame::{Flash, Frame, Image, Variance};
use noisefloor_kernels::flash_filter::PatchWeights;
use noisefloor_kernels::mirror;
use noisefloor_toolbox::percentile;
use rayon::prelude::*;

use crate::flash::{self, CHUNK, Light, per_pixel};
use crate::volume::patch_in_time;
use crate::{GuideKind, Params};

/// What range weights are computed from.
#[derive(Debug, Clone)]
pub(crate) struct Guide {
    /// F.
    pub image: Image,
    /// σ_r² that each pixel's own noise asks for, greater than 0; a pair of pixels takes the smaller of its two.
    pub sigma_r2: Vec<f32>,
    /// Intensity I, if the flash came in parts.
    pub intensity: Option<f64>,
    /// Least and largest σ_r of single pixels.
    pub sigma_r: (f64, f64),
}

impl Guide {
    /// One for each frame of a volume. None if the parameters ask for none, or if a frame lacks the buffers (its needs say so
    /// before).
    pub fn of_frames(frames: &[&Frame], params: &Params, patch: &PatchWeights) -> Vec<Self> {
        let (found, kappa): (Option<Vec<Found<'_>>>, f64) = match params.guide {
            GuideKind::None => return Vec::new(),
            GuideKind::Color => {
                (frames.iter().map(|frame| Found::color(frame)).collect(), params.color_kappa)
            }
            GuideKind::Flash => (Found::flashes(frames, params), params.kappa),
        };
        let Some(found) = found else { return Vec::new() };
        let (widths, mut images, mut variances) = (Widths { kappa, params, patch }, Vec::new(), Vec::new());
        for found in found {
            images.push((found.image, found.intensity));
            variances.push(found.variance);
        }
        let guide = |(at, (image, intensity)): (usize, (Image, Option<f64>))| {
            widths.guide(image, &mean_in_time(&variances, at, patch), intensity)
        };
        images.into_iter().enumerate().map(guide).collect()
    }
}

/// A guide image as a frame has it.
struct Found<'a> {
    image: Image,
    variance: Cow<'a, Image>,
    /// Intensity I, if the flash came in parts.
    intensity: Option<f64>,
}

impl<'a> Found<'a> {
    fn color(frame: &'a Frame) -> Option<Self> {
        let variance = frame.color.variance.as_ref()?.mean_variance();
        let image = frame.color.mean.clone();
        Some(Self { image, variance: Cow::Borrowed(variance), intensity: None })
    }

    /// Flash images, those that came in parts of one intensity.
    fn flashes(frames: &[&'a Frame], params: &Params) -> Option<Vec<Self>> {
        let light = |frame: &&Frame| -> Option<Light> {
            let Flash::Parts { base, light, .. } = frame.flash.as_ref()? else { return None };
            let clip = params.luminance_clip_percentile;
            Some(flash::light_of(&frame.color.mean, &base.mean, &light.mean, clip))
        };
        let intensity = params.intensity_scale * flash::intensity(frames.iter().filter_map(light));
        frames.iter().map(|frame| Self::flash(frame, intensity)).collect()
    }

    fn flash(frame: &'a Frame, intensity: f64) -> Option<Self> {
        match frame.flash.as_ref()? {
            Flash::Ready(flash) => {
                let variance = Cow::Borrowed(flash.variance.as_ref()?.mean_variance());
                Some(Self { image: flash.mean.clone(), variance, intensity: None })
            }
            Flash::Parts { base, light, covariance } => {
                let base_variance = base.variance.as_ref().map(Variance::mean_variance)?;
                let light_variance = light.variance.as_ref().map(Variance::mean_variance)?;
                let image = flash::sum(&base.mean, &light.mean, intensity);
                let variance = flash::variance(base_variance, light_variance, covariance.as_ref(), intensity);
                Some(Self { image, variance: Cow::Owned(variance), intensity: Some(intensity) })
            }
        }
    }
}

/// Mean of variances over the frames of the patches of frame `at`.
fn mean_in_time<'v>(variances: &'v [Cow<'_, Image>], at: usize, patch: &PatchWeights) -> Cow<'v, Image> {
    let shares = patch_in_time(variances, at, patch);
    if let [(_, only)] = shares[..] {
        return Cow::Borrowed(only);
    }
    let mut mean = Image::new(variances[at].width(), variances[at].height(), variances[at].channels());
    for (share, variance) in shares {
        mean.data_mut().par_chunks_mut(CHUNK).zip(variance.data().par_chunks(CHUNK)).for_each(
            |(mean, variance)| {
                for (mean, &variance) in mean.iter_mut().zip(variance) {
                    *mean += share as f32 * variance;
                }
            },
        );
    }
    Cow::Owned(mean)
}

/// How a guide's variance becomes widths.
struct Widths<'a> {
    kappa: f64,
    params: &'a Params,
    patch: &'a PatchWeights,
}

impl Widths<'_> {
    /// σ_r²(p) = κ²·mean over patch and channels of the guide's variance, which is a mean over the patch's frames already, at least (floor·bright level)². Sec. 4 says that σ_r is
    /// proportional to the standard error of F; the rest is ours.
    fn guide(&self, image: Image, variance: &Image, intensity: Option<f64>) -> Guide {
        let magnitudes = per_pixel(&image, |values| {
            values.into_iter().map(f32::abs).fold(0.0, |a, b| if b > a { b } else { a })
        });
        let bright = percentile(magnitudes, self.params.luminance_clip_percentile);
        let floor = (self.params.guide_floor * bright).powi(2);
        let mut sigma_r2 = vec![0.0; image.pixels()];
        let range = patch_mean(variance, self.patch, &mut sigma_r2, |mean| {
            (self.kappa * self.kappa * mean).max(floor)
        });
        Guide { image, sigma_r2, intensity, sigma_r: (range.0.sqrt(), range.1.sqrt()) }
    }
}

/// Writes `finish` of the mean over the channels, averaged with the patch weights; taps outside the image read the mirrored
/// pixel. Returns the least and the largest value. A value of 0 is written as the least positive normal number, with
/// which only equal patches have a weight.
fn patch_mean(
    image: &Image,
    patch: &PatchWeights,
    out: &mut [f32],
    finish: impl Fn(f64) -> f64 + Sync,
) -> (f64, f64) {
    let (width, height) = (image.width(), image.height());
    let [r, g, b] = [0, 1, 2].map(|c| image.plane(c));
    let radius = patch.radius() as isize;
    let taps: Vec<f64> = (-radius..=radius).map(|i| patch.tap(i.unsigned_abs())).collect();
    let mut across = vec![0.0f64; width * height];
    across.par_chunks_mut(width).enumerate().for_each_init(
        || vec![0.0f64; width + 2 * radius as usize],
        |padded, (y, row)| {
            // `max` also turns a NaN of an input that was not sanitised into 0.
            let value = |p: usize| (f64::from(r[p]) + f64::from(g[p]) + f64::from(b[p])).max(0.0) / 3.0;
            for (x, padded) in padded.iter_mut().enumerate() {
                *padded = value(y * width + mirror(x as isize - radius, width));
            }
            for (i, tap) in taps.iter().enumerate() {
                row.iter_mut().zip(&padded[i..]).for_each(|(sum, v)| *sum += tap * v);
            }
        },
    );
    let rows = out.par_chunks_mut(width).enumerate().map_init(
        || vec![0.0f64; width],
        |sum, (y, row)| {
            sum.fill(0.0);
            for (j, tap) in (-radius..=radius).zip(&taps) {
                let from = &across[mirror(y as isize + j, height) * width..][..width];
                sum.iter_mut().zip(from).for_each(|(sum, v)| *sum += tap * v);
            }
            let mut range = (f64::INFINITY, 0.0f64);
            for (value, &mean) in row.iter_mut().zip(sum.iter()) {
                let finished = finish(mean);
                range = (range.0.min(finished), range.1.max(finished));
                *value = (finished as f32).max(f32::MIN_POSITIVE);
            }
            range
        },
    );
    rows.reduce(|| (f64::INFINITY, 0.0), |a, b| (a.0.min(b.0), a.1.max(b.1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guide(image: Image, variance: &Image, params: &Params) -> Guide {
        let patch = PatchWeights::gaussian(2, 1.25).unwrap();
        Widths { kappa: params.kappa, params, patch: &patch }.guide(image, variance, None)
    }

    #[test]
    fn range_width_is_kappa_times_the_standard_error_where_the_variance_is_constant() {
        let variance = Image::from_fn(9, 5, 3, |c, _, _| [0.01, 0.02, 0.03][c]);
        let params = Params { kappa: 2.0, ..Params::default() };
        let guide = guide(Image::filled(9, 5, 3, 1.0), &variance, &params);
        for sigma_r2 in guide.sigma_r2 {
            assert!((sigma_r2 - 4.0 * 0.02).abs() < 1e-7, "{sigma_r2}");
        }
        assert!((guide.sigma_r.0 - 0.08f64.sqrt()).abs() < 1e-6 && guide.sigma_r.1 < 0.2829);
    }

    #[test]
    fn noise_free_guide_falls_back_to_the_floor_and_a_black_one_to_exact_equality() {
        let params = Params::default();
        let none = Image::new(4, 4, 3);
        let lit = guide(Image::filled(4, 4, 3, 2.0), &none, &params);
        let expected = (1e-4f64 * 2.0).powi(2);
        assert!((f64::from(lit.sigma_r2[0]) / expected - 1.0).abs() < 1e-6);
        let black = guide(none.clone(), &none, &params);
        assert_eq!(black.sigma_r2, [f32::MIN_POSITIVE; 16]);
    }

    #[test]
    fn patch_mean_mirrors_at_the_border_without_repeating_the_edge() {
        let patch = PatchWeights::uniform(1).unwrap();
        let image = Image::from_fn(3, 1, 3, |_, x, _| [3.0, 6.0, 12.0][x]);
        let mut mean = [0.0; 3];
        assert_eq!(patch_mean(&image, &patch, &mut mean, |v| v).1, f64::from(mean[2]));
        for (got, expected) in mean.iter().zip([5.0, 7.0, 8.0]) {
            assert!((got - expected).abs() < 1e-6, "{mean:?}");
        }
    }
}
