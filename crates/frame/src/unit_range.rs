//! Features at unit range, so that one threshold fits all of them.

use crate::{Estimate, FeatureId, Image, Variance};

/// Share of pixels whose depth, or whose positive caustic density, is below what counts as 1.
const COMMON: f64 = 0.99;
/// Largest variance of the mean of a value between 0 and 1.
const MOST_VARIANCE: f32 = 0.25;

/// What counts as 1 of a feature without a natural limit: depth, position and others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Far {
    /// The largest magnitude of the image, as printed in rousselle2013rdfc, Sec. 5: one far pixel flattens all others.
    Largest,
    /// The 99th percentile of the magnitudes; what is beyond is cut there.
    Common,
}

/// What brings a feature to unit range. Made from the mean of one frame, it may be applied to others, whose values then
/// are in the same unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitRange {
    rule: Rule,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Rule {
    /// value·factor + offset, its magnitude cut at `most`.
    Affine { factor: f64, offset: f64, most: f64 },
    /// Each pixel by its own largest channel, where that is above 1: reflectances are at most 1, and a lamp that states
    /// more must not make all textures look alike.
    PerPixel,
}

impl UnitRange {
    /// For the feature `id` with this mean. Albedo, BRDF: each pixel by the larger of 1 and its largest channel.
    /// Normals: (n + 1)/2. Visibility: by the larger of 1 and the largest value. Caustics: by the 99th percentile of the
    /// positive densities, not cut. All others as `far` says; an image of zeros stays what it is.
    ///
    /// ```
    /// use noisefloor_frame::{Estimate, Far, FeatureId, Image, UnitRange};
    ///
    /// // A texture of 0.2 and 0.4 beside a lamp that states 40.
    /// let albedo = Estimate::from_mean(Image::from_fn(3, 1, 3, |_, x, _| [0.2, 0.4, 40.0][x]));
    /// let unit = UnitRange::of(&FeatureId::Albedo, &albedo.mean, Far::Common).apply(&albedo);
    /// assert_eq!(unit.mean.plane(0), [0.2, 0.4, 1.0]);
    /// ```
    #[must_use]
    pub fn of(id: &FeatureId, mean: &Image, far: Far) -> Self {
        let rule = match id {
            FeatureId::Albedo | FeatureId::Brdf => Rule::PerPixel,
            // Averages of unit vectors.
            FeatureId::Normal if largest(mean) <= 1.001 => {
                Rule::Affine { factor: 0.5, offset: 0.5, most: f64::INFINITY }
            }
            FeatureId::Visibility => over(largest(mean).max(1.0), f64::INFINITY),
            // A density has peaks without limit: what is bright but common counts as 1.
            FeatureId::Caustics => over(common(mean.data().iter().copied()), f64::INFINITY),
            _ => match far {
                Far::Largest => over(largest(mean), f64::INFINITY),
                Far::Common => over(common(mean.data().iter().map(|v| v.abs())), 1.0),
            },
        };
        Self { rule }
    }

    /// The feature in the new unit: mean, halves and variance. Values that are not finite stay so.
    #[must_use]
    pub fn apply(&self, feature: &Estimate) -> Estimate {
        match self.rule {
            Rule::Affine { factor, offset, most } => {
                let value = |image: &Image| {
                    // A clamp leaves a NaN what it is.
                    image.map(|v| (f64::from(v) * factor + offset).clamp(-most, most) as f32)
                };
                let bounded = if most <= 1.0 { MOST_VARIANCE } else { f32::MAX };
                let square = |image: &Image| {
                    image.map(|v| (f64::from(v) * factor * factor).min(f64::from(bounded)) as f32)
                };
                mapped(feature, value, square)
            }
            Rule::PerPixel => {
                let over: Vec<f64> = (0..feature.mean.pixels())
                    .map(|p| feature.mean.planes().fold(1.0f64, |most, plane| most.max(plane[p].into())))
                    .collect();
                mapped(feature, |image| divided(image, &over, 1), |image| divided(image, &over, 2))
            }
        }
    }
}

fn mapped(feature: &Estimate, value: impl Fn(&Image) -> Image, square: impl Fn(&Image) -> Image) -> Estimate {
    Estimate {
        mean: value(&feature.mean),
        variance: feature.variance.as_ref().map(|v| Variance::of_mean(square(v.mean_variance()))),
        halves: feature.halves.as_ref().map(|halves| halves.each_ref().map(value)),
    }
}

/// Every pixel over its own divisor, `times` times; divisors are at least 1.
fn divided(image: &Image, over: &[f64], times: i32) -> Image {
    let mut out = image.clone();
    for plane in out.planes_mut() {
        for (value, over) in plane.iter_mut().zip(over) {
            *value = (f64::from(*value) / over.powi(times)) as f32;
        }
    }
    out
}

/// By `one`, unless that is so small that its reciprocal would blow up nothing but rounding.
fn over(one: f32, most: f64) -> Rule {
    let (factor, most) = if one > 1e-30 { (1.0 / f64::from(one), most) } else { (1.0, f64::INFINITY) };
    Rule::Affine { factor, offset: 0.0, most }
}

/// Largest finite magnitude; 0 for an image of zeros.
fn largest(image: &Image) -> f32 {
    image.data().iter().map(|v| v.abs()).filter(|v| v.is_finite()).fold(0.0, f32::max)
}

/// 99th percentile of the positive finite values; 1 without any.
fn common(values: impl Iterator<Item = f32>) -> f32 {
    let mut positive: Vec<f32> = values.filter(|v| *v > 0.0 && v.is_finite()).collect();
    if positive.is_empty() {
        return 1.0;
    }
    // Below the length, as the share is below 1.
    let index = (COMMON * positive.len() as f64) as usize;
    *positive.select_nth_unstable_by(index, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(values: &[f32], channels: usize) -> Estimate {
        let mean = Image::from_vec(values.len() / channels, 1, channels, values.to_vec()).unwrap();
        let variance = Some(Variance::of_mean(mean.map(|v| 0.01 * v * v)));
        let halves = Some([mean.map(|v| 0.9 * v), mean.map(|v| 1.1 * v)]);
        Estimate { mean, variance, halves }
    }

    fn unit(id: FeatureId, far: Far, feature: &Estimate) -> Estimate {
        UnitRange::of(&id, &feature.mean, far).apply(feature)
    }

    #[test]
    fn a_lamp_does_not_flatten_textures() {
        // Two pixels, three channels: the second states up to 17.
        let albedo = estimate(&[0.2, 17.0, 0.4, 1.7, 0.1, 3.4], 3);
        for id in [FeatureId::Albedo, FeatureId::Brdf] {
            let unit = unit(id, Far::Common, &albedo);
            let expected = [0.2, 1.0, 0.4, 0.1, 0.1, 0.2];
            for ((got, expected), read) in unit.mean.data().iter().zip(expected).zip(albedo.mean.data()) {
                assert!((got - expected).abs() < 1e-6, "{read}");
            }
            // Halves and variance belong to the mean as before: a tenth off, a hundredth of the square.
            let variance = unit.variance.unwrap().into_mean_variance();
            let halves = unit.halves.unwrap();
            for (i, mean) in unit.mean.data().iter().enumerate() {
                assert!((variance.data()[i] / (0.01 * mean * mean) - 1.0).abs() < 1e-5);
                assert!((halves[0].data()[i] / (0.9 * mean) - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn one_far_pixel_flattens_depth_only_as_printed() {
        let mut values: Vec<f32> = (1..=1000).map(|i| 0.01 * i as f32).collect();
        values[999] = 1e6;
        let depth = estimate(&values, 1);
        let printed = unit(FeatureId::Depth, Far::Largest, &depth);
        assert!((printed.mean.data()[500] - 5.01e-6).abs() < 1e-9);
        let common = unit(FeatureId::Depth, Far::Common, &depth);
        assert!((common.mean.data()[500] - 5.01 / 9.91).abs() < 1e-6);
        assert_eq!((common.mean.data()[999], common.halves.unwrap()[1].data()[999]), (1.0, 1.0));
        assert_eq!(common.variance.unwrap().into_mean_variance().data()[999], MOST_VARIANCE);
    }

    #[test]
    fn zeros_and_values_that_are_not_finite_make_no_unit() {
        for far in [Far::Largest, Far::Common] {
            let black = estimate(&[0.0; 5], 1);
            assert_eq!(unit(FeatureId::Depth, far, &black), black);
            let sky = estimate(&[1.0, 2.0, f32::INFINITY, f32::NAN], 1);
            let unit = unit(FeatureId::Depth, far, &sky).mean;
            assert_eq!(unit.data()[..2], [0.5, 1.0]);
            assert!(unit.data()[3].is_nan());
        }
        let none = estimate(&[f32::NAN; 3], 1);
        assert!(unit(FeatureId::Depth, Far::Common, &none).mean.data().iter().all(|v| v.is_nan()));
    }

    #[test]
    fn normals_and_visibility_keep_their_own_range() {
        let normal = Estimate::from_mean(Image::from_fn(2, 1, 3, |_, x, _| [-1.0, 1.0][x]));
        assert_eq!(unit(FeatureId::Normal, Far::Common, &normal).mean.plane(0), [0.0, 1.0]);
        let visibility = Estimate::from_mean(Image::from_fn(2, 1, 1, |_, x, _| [0.25, 0.5][x]));
        assert_eq!(unit(FeatureId::Visibility, Far::Common, &visibility).mean.data(), [0.25, 0.5]);
    }
}
