//! Frames with known truth and normal noise, for the tests of methods.

use std::f32::consts::SQRT_2;
use std::f64::consts::TAU;

use noisefloor_frame::{Estimate, FeatureId, Frame, Image, Samples, Sampling, Variance};
use noisefloor_stats::random;

/// Standard normal numbers, both of each pair of Box and Muller (1958). The same for a seed on every machine, from version
/// to version: results that tests record hang on them.
#[derive(Debug, Clone)]
pub struct Normals {
    uniforms: random::Normals,
    spare: Option<f64>,
}

impl Normals {
    /// The sequence of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { uniforms: random::Normals::new(seed), spare: None }
    }

    /// A number of mean 0 and variance 1.
    #[expect(clippy::should_implement_trait)] // it never ends
    pub fn next(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        // Uniform numbers are 1 - 2⁻⁵³ at most: no logarithm of 0.
        let (u, v) = (1.0 - self.uniforms.uniform(), self.uniforms.uniform());
        let (r, angle) = ((-2.0 * u.ln()).sqrt(), TAU * v);
        self.spare = Some(r * angle.sin());
        r * angle.cos()
    }
}

/// Halves of normal noise around `truth`; their mean has the standard deviation `sd` and says so.
#[must_use]
pub fn estimate(truth: &Image, sd: f32, normals: &mut Normals) -> Estimate {
    let mut half = || truth.map(|v| v + sd * SQRT_2 * normals.next() as f32);
    let halves = [half(), half()];
    Estimate {
        mean: halves[0].zip_map(&halves[1], |a, b| 0.5 * (a + b)),
        variance: Some(Variance::of_mean(truth.map(|_| sd * sd))),
        halves: Some(halves),
    }
}

/// A smooth ramp of three channels in [0.2, 0.8].
#[must_use]
pub fn ramp(width: usize, height: usize) -> Image {
    Image::from_fn(width, height, 3, |c, x, y| {
        0.2 + 0.5 * x as f32 / width as f32 + 0.05 * (y as f32 / height as f32) + 0.02 * c as f32
    })
}

/// A dark and a bright side, 0.2 and 0.6, with a chequered texture of 0.1 in squares of 4 pixels.
#[must_use]
pub fn step(width: usize, height: usize) -> Image {
    Image::from_fn(width, height, 3, |c, x, y| {
        let side = if 2 * x < width { 0.2 } else { 0.6 };
        side + 0.1 * ((x / 4 + y / 4 + c) % 2) as f32
    })
}

/// Independent samples of `truth`, 16 a pixel, whose mean has the standard deviation `sd`, with features: the truth itself as
/// albedo, a flat normal, a slanted depth.
#[must_use]
pub fn frame(truth: &Image, sd: f32, seed: u64) -> Frame {
    let mut normals = Normals::new(seed);
    let mut frame = of_color(estimate(truth, sd, &mut normals));
    let (w, h) = (truth.width(), truth.height());
    let mut add = |id, truth: &Image, sd| frame.features.insert(id, estimate(truth, sd, &mut normals));
    add(FeatureId::Albedo, truth, 0.01);
    add(FeatureId::Normal, &Image::from_fn(w, h, 3, |c, _, _| f32::from(c == 2)), 0.0);
    add(FeatureId::Depth, &Image::from_fn(w, h, 1, |_, x, _| 5.0 + 0.01 * x as f32), 0.001);
    frame
}

/// A frame of `truth` without any noise, which says so, and without features.
#[must_use]
pub fn exact(truth: &Image) -> Frame {
    let variance = Some(Variance::of_mean(truth.map(|_| 0.0)));
    of_color(Estimate { mean: truth.clone(), variance, halves: Some([truth.clone(), truth.clone()]) })
}

fn of_color(color: Estimate) -> Frame {
    Frame::from_color(color, Samples::uniform(16), Sampling::Independent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_of_mean_0_and_variance_1_and_those_of_a_pair_have_nothing_to_do_with_each_other() {
        let mut normals = Normals::new(1);
        let pairs: Vec<[f64; 2]> = (0..50_000).map(|_| [normals.next(), normals.next()]).collect();
        let n = pairs.len() as f64;
        let mean = |of: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(of).sum::<f64>() / n;
        // 4 standard errors: those of z, of z² (variance 2) and of the product of two (variance 1).
        for k in 0..2 {
            assert!(mean(&|pair| pair[k]).abs() < 4.0 / n.sqrt());
            assert!((mean(&|pair| pair[k] * pair[k]) - 1.0).abs() < 4.0 * (2.0 / n).sqrt());
        }
        assert!(mean(&|pair| pair[0] * pair[1]).abs() < 4.0 / n.sqrt());
    }

    #[test]
    fn an_estimate_is_as_noisy_as_it_says() {
        let truth = Image::filled(100, 100, 1, 2.0);
        let estimate = estimate(&truth, 0.3, &mut Normals::new(2));
        assert!(estimate.variance.unwrap().mean_variance().data().iter().all(|v| *v == 0.3 * 0.3));
        let halves = estimate.halves.unwrap();
        for (image, variance) in [(&estimate.mean, 0.09), (&halves[0], 0.18), (&halves[1], 0.18)] {
            let square = image.data().iter().map(|v| f64::from(v - 2.0).powi(2)).sum::<f64>() / 1e4;
            // 4 standard errors of the mean of 10⁴ squares.
            assert!((square / variance - 1.0).abs() < 4.0 * (2.0f64 / 1e4).sqrt(), "{square}");
        }
    }
}
