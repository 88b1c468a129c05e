//! Probability integral transform: at which of its own quantiles a t-interval has the truth.

use thiserror::Error;

use crate::observed::rounding;
use crate::random::Normals;
use crate::{Observed, ShapeError, Truth, ecdf, t_two_sided_p};

/// u of chosen pixel-channels, and what they are made of.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pit {
    /// u in [0, 1] in the order of the choice, without what was left out.
    pub values: Vec<f64>,
    /// Of those: with s = 0 and x̄ = μ up to rounding; u is drawn uniformly.
    pub constant: u64,
    /// Of those: with s = 0 and x̄ < μ; u is 1.
    pub missed_above: u64,
    /// Of those: with s = 0 and x̄ > μ; u is 0.
    pub missed_below: u64,
    /// Left out: fewer than 2 samples, not taking part, or not finite.
    pub left_out: u64,
}

impl Pit {
    /// Largest |F̂(z) − z| at the `points` equally spaced z of a band; `None` without values or points.
    #[must_use]
    pub fn largest_deviation(&self, points: usize) -> Option<f64> {
        let f = ecdf(&self.values, points);
        f.iter().enumerate().map(|(i, f)| (f - (i + 1) as f64 / points as f64).abs()).reduce(f64::max)
    }
}

/// What no transform is made of.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PitError {
    /// An index of the choice that is no pixel-channel.
    #[error("index {got} is chosen of {len} pixel-channels")]
    Index {
        /// The index.
        got: usize,
        /// Pixel-channels.
        len: usize,
    },
    /// Slices that do not belong together.
    #[error(transparent)]
    Shape(#[from] ShapeError),
}

/// u = F_{n−1}((μ−x̄)/(s/√n)) of the planar indices `chosen`, F_{n−1} the distribution function of Student's t.
///
/// For normal samples u is uniform. It is near 1 where the truth is far above the interval, as with light that most samples
/// missed. Where s = 0, x̄ = μ up to rounding says nothing and u is drawn from the random numbers of `seed` and the index;
/// else u is 1 or 0.
///
/// The truth must be exact, or known from at least 256 times the samples: its variance is not used, and widens the spread
/// of μ−x̄ by up to 1/512. Choose one channel of pixels that are far apart: channels of a pixel and neighbours under a
/// filter depend on each other, and a band for so many independent values would reject every frame.
///
/// # Errors
/// [`PitError`] if an index is out of range or slices do not belong together.
pub fn pit(observed: &Observed<'_>, truth: &Truth<'_>, chosen: &[usize], seed: u64) -> Result<Pit, PitError> {
    observed.check()?;
    truth.check(observed.mean.len())?;
    let mut out = Pit::default();
    for &i in chosen {
        let Some(&mean) = observed.mean.get(i) else {
            return Err(PitError::Index { got: i, len: observed.mean.len() });
        };
        let pixel = i % observed.pixels; // above 0, or there were no index
        let n = observed.count_at(pixel);
        let (mean, mu) = (f64::from(mean), f64::from(truth.mean[i]));
        let variance = f64::from(observed.variance[i]).max(0.0);
        if n < 2
            || !observed.takes_part(pixel)
            || !(mean.is_finite() && mu.is_finite() && variance.is_finite())
        {
            out.left_out += 1;
            continue;
        }
        let above = mu - mean;
        out.values.push(if variance > 0.0 {
            let tail = 0.5 * t_two_sided_p(above / variance.sqrt(), u64::from(n) - 1);
            if above > 0.0 { 1.0 - tail } else { tail }
        } else if above.abs() <= rounding(mean, mu) {
            out.constant += 1;
            drawn(seed, i)
        } else if above > 0.0 {
            out.missed_above += 1;
            1.0
        } else {
            out.missed_below += 1;
            0.0
        });
    }
    Ok(out)
}

/// A uniform number of the seed and the index alone.
fn drawn(seed: u64, index: usize) -> f64 {
    // Two rounds: the first spreads the seed, so that neighbouring seeds share no sequence.
    let spread = Normals::new(seed).uniform().to_bits();
    Normals::new(spread ^ (index as u64).wrapping_mul(0xD134_2543_DE82_EF95)).uniform()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EcdfBand, Level, SampleCounts, rate_standard_error, t_quantile};

    fn of(mean: &[f32], variance: &[f32], truth: &[f32], n: u32) -> Pit {
        let observed =
            Observed { mean, variance, counts: SampleCounts::Uniform(n), pixels: mean.len(), valid: None };
        let all: Vec<usize> = (0..mean.len()).collect();
        pit(&observed, &Truth { mean: truth, variance: None }, &all, 7).unwrap()
    }

    #[test]
    fn the_ends_of_an_interval_are_its_quantiles() {
        let t = t_quantile(Level::TWO_SIDED_95, 15);
        let found = of(&[0.0; 3], &[0.25; 3], &[(0.5 * t) as f32, (-0.5 * t) as f32, 0.0], 16);
        for (u, expected) in found.values.iter().zip([0.975, 0.025, 0.5]) {
            assert!((u - expected).abs() < 1e-7, "{u}");
        }
    }

    #[test]
    fn normal_samples_stay_inside_the_band_and_wrong_variances_do_not() {
        let band = EcdfBand::new(200, 50, 0.95).unwrap();
        let (draws, n) = (400, 4u32);
        let mut normals = Normals::new(1);
        let mut inside = [0u32; 3];
        for _ in 0..draws {
            let (mut mean, mut variance) = (Vec::new(), Vec::new());
            for _ in 0..200 {
                let samples: Vec<f64> = (0..n).map(|_| 2.0 + normals.next()).collect();
                let (m, v) = crate::interval::mean_and_variance(&samples).unwrap();
                mean.push(m as f32);
                variance.push((v / f64::from(n)) as f32);
            }
            for (found, factor) in inside.iter_mut().zip([1.0, 4.0, 0.5f32]) {
                let scaled: Vec<f32> = variance.iter().map(|v| v * factor).collect();
                let u = of(&mean, &scaled, &[2.0; 200], n);
                *found += u32::from(band.contains(&ecdf(&u.values, 50)));
            }
        }
        let [right, sample, half] = inside.map(|k| f64::from(k) / f64::from(draws));
        let mcse = rate_standard_error(band.probability, u64::from(draws as u32));
        assert!((right - band.probability).abs() < 4.0 * mcse, "{right}");
        assert!(sample < 0.1, "s for s/√n: {sample}");
        assert!(half < 0.7, "half the variance: {half}");
    }

    #[test]
    fn pixels_without_variance_are_drawn_or_at_an_end() {
        let found = of(&[1.0, 0.0, 2.0], &[0.0; 3], &[1.0, 1.0, 1.0], 4);
        assert_eq!((found.constant, found.missed_above, found.missed_below), (1, 1, 1));
        assert_eq!(found.values[1..], [1.0, 0.0]);
        let many = vec![1.0; 2000];
        let drawn = of(&many, &vec![0.0; 2000], &many, 4);
        assert_eq!(drawn, of(&many, &vec![0.0; 2000], &many, 4));
        // Below the 99.99 % quantile of Kolmogorov's statistic, 2.23/√2000.
        assert!(drawn.largest_deviation(100).unwrap() < 0.05, "{:?}", drawn.largest_deviation(100));
    }

    #[test]
    fn unknown_values_are_counted_and_wrong_indices_refused() {
        let found = of(&[f32::NAN, 1.0], &[1.0, f32::INFINITY], &[1.0; 2], 4);
        assert_eq!((found.left_out, found.largest_deviation(4)), (2, None));
        assert_eq!(of(&[1.0], &[1.0], &[1.0], 1).left_out, 1, "one sample has no variance");
        let observed = Observed {
            mean: &[1.0],
            variance: &[1.0],
            counts: SampleCounts::Uniform(4),
            pixels: 1,
            valid: None,
        };
        let truth = Truth { mean: &[1.0], variance: None };
        assert_eq!(pit(&observed, &truth, &[3], 0), Err(PitError::Index { got: 3, len: 1 }));
        let truth = Truth { mean: &[1.0; 2], variance: None };
        assert!(matches!(pit(&observed, &truth, &[0], 0), Err(PitError::Shape(_))));
    }
}
