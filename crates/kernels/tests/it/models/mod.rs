//! Tests of models at chosen centres.

mod oracle;
mod properties;
mod statistics;

use noisefloor_kernels::regression::models::{Field, Planes, Rules};

use crate::random::Random;

/// A frame with an edge, a slope, features with noise, and noise.
pub struct Case {
    pub size: (usize, usize),
    pub guide: [Vec<f32>; 3],
    pub guide_variance: [Vec<f32>; 3],
    pub target: [Vec<f32>; 3],
    pub variance: Vec<f32>,
    pub importance: Vec<f32>,
    pub features: Vec<Vec<f32>>,
    pub rules: Rules,
}

impl Case {
    pub fn new(width: usize, height: usize, seed: u64) -> Self {
        let mut random = Random(seed);
        let pixels = width * height;
        let mut features: Vec<Vec<f32>> = (0..7)
            .map(|f| {
                let at =
                    |p: usize| (p % width) as f32 * 0.02 * (f as f32 - 3.0) + ((p / width) % 5) as f32 * 0.1;
                (0..pixels).map(|p| at(p) + 0.05 * random.uniform()).collect()
            })
            .collect();
        // One that is far from its range in the image in most windows.
        features[6]
            .iter_mut()
            .enumerate()
            .filter(|(p, _)| p % width + 1 == width)
            .for_each(|(_, v)| *v += 500.0);
        let truth = |c: usize, p: usize| {
            f32::from(p % width > width / 2) + 0.3 * features[1][p] + 0.1 * c as f32 + 0.5
        };
        let mut plane = |scale: f32| -> [Vec<f32>; 3] {
            [0, 1, 2].map(|c| (0..pixels).map(|p| truth(c, p) + scale * random.normal()).collect())
        };
        let (guide, target) = (plane(0.05), plane(0.2));
        let mut positive =
            |scale: f32| (0..pixels).map(|_| scale * (0.2 + random.uniform())).collect::<Vec<f32>>();
        Self {
            size: (width, height),
            guide,
            guide_variance: [positive(0.0025), positive(0.0025), positive(0.0025)],
            target,
            variance: positive(0.04),
            importance: positive(1.0),
            features,
            rules: Rules {
                patch_radius: 3,
                range_sigma: 1.0,
                bandwidths: vec![1.0, 2.0, 4.0],
                least_weight: 1e-6,
                ridge: 1e-3,
            },
        }
    }

    pub fn planes(&self) -> Planes<'_> {
        Planes {
            guide: self.guide.each_ref().map(Vec::as_slice),
            guide_variance: self.guide_variance.each_ref().map(Vec::as_slice),
            target: self.target.each_ref().map(Vec::as_slice),
            variance: &self.variance,
            importance: &self.importance,
            features: self.features.iter().map(Vec::as_slice).collect(),
        }
    }

    pub fn field(&self) -> Field {
        Field::new(self.size.0, self.size.1, &self.planes(), self.rules.clone()).unwrap()
    }
}
