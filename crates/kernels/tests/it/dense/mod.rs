mod bits;
mod oracle;
mod properties;

use noisefloor_kernels::regression::dense::*;

use crate::random::Random;

/// Planes of one call that own their values.
#[derive(Clone, Debug)]
struct Case {
    fit: Fit,
    guide: Vec<[Vec<f32>; 2]>,
    features: Vec<Vec<f32>>,
    image: [Vec<f32>; 3],
}

impl Case {
    /// Differences are of the size of the noise, but for a step in the middle; one in two hundred variances is zero, so that
    /// patches without such pairs remain.
    fn random(width: usize, height: usize, features: usize) -> Self {
        let mut u = Random((width * 1000 + height * 10 + features) as u64);
        let n = width * height;
        let variance = |u: &mut Random| if u.uniform() < 0.005 { 0.0 } else { 0.002 + 0.004 * u.uniform() };
        let mut p = 0;
        let mut value = |u: &mut Random| {
            let side = if 2 * (p % width) < width { 0.2 } else { 0.35 };
            p += 1;
            side + 0.3 * u.uniform()
        };
        let weighting = Weighting { width, height, window: 9, patch: 3, k: 0.5, scale: 2.0, epsilon: 1e-7 };
        Self {
            fit: Fit { weighting, join: Join::Minimum, solver: Solver::Dropped, positions: true },
            guide: (0..3).map(|_| [u.plane(n, &mut value), u.plane(n, variance)]).collect(),
            features: (0..features).map(|_| u.plane(n, Random::uniform)).collect(),
            image: [0, 1, 2].map(|_| u.plane(n, Random::uniform)),
        }
    }

    fn guide(&self) -> Vec<Channel<'_>> {
        self.guide.iter().map(|[value, variance]| Channel { value, variance }).collect()
    }

    fn planes(&self) -> Planes<'_> {
        let features = self.features.iter().map(Vec::as_slice).collect();
        Planes { guide: self.guide(), features, image: self.image.each_ref().map(Vec::as_slice) }
    }

    /// Every channel of the guide filters the first two colours.
    fn alone(&self) -> Vec<Alone<'_>> {
        let alone = |guide| Alone { guide, targets: self.image[..2].iter().map(Vec::as_slice).collect() };
        self.guide().into_iter().map(alone).collect()
    }

    fn regress(&self) -> [Vec<f32>; 3] {
        regress(&self.fit, &self.planes()).unwrap_or_else(|e| panic!("{e}"))
    }

    fn oracle(&self) -> [Vec<f64>; 3] {
        naive::regress(&self.fit, &self.planes()).unwrap_or_else(|e| panic!("{e}"))
    }
}

/// Largest deviation.
fn far(a: &[f32], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .map(|(a, b)| (f64::from(*a) - b).abs())
        .fold(0.0, |worst, d| if d.is_nan() { f64::INFINITY } else { worst.max(d) })
}

fn farthest(a: &[Vec<f32>; 3], b: &[Vec<f64>; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| far(a, b)).fold(0.0, f64::max)
}
