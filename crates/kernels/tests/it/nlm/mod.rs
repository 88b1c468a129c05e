mod bits;
mod hard_cases;
mod oracle;
mod properties;
mod rules;

use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::inside::nlm_in_tiles;
use noisefloor_kernels::nlm::naive::filter_f64;
use noisefloor_kernels::nlm::*;

use crate::random::Random;

/// Planes of one frame that own their values.
#[derive(Clone, Debug)]
struct Owned {
    /// Value and variance.
    guide: Vec<[Vec<f32>; 2]>,
    /// Value, variance and spread of each channel of each feature.
    features: Vec<Vec<[Vec<f32>; 3]>>,
    targets: Vec<Vec<f32>>,
}

impl Owned {
    fn random(u: &mut Random, n: usize, channels: usize, features: &[usize], targets: usize) -> Self {
        // A third of the variances is zero; differences are of the size of the noise.
        let variance = |u: &mut Random| if u.uniform() < 0.33 { 0.0 } else { 0.1 * u.uniform() };
        Self {
            guide: (0..channels)
                .map(|_| [u.plane(n, |u| 0.2 + 0.5 * u.uniform()), u.plane(n, variance)])
                .collect(),
            features: features
                .iter()
                .map(|&count| {
                    (0..count)
                        .map(|_| {
                            let value = u.plane(n, |u| 0.2 * u.uniform());
                            let variance = u.plane(n, |u| 0.01 * u.uniform() * u.uniform());
                            let spread = variance.iter().map(|v| v.max(0.02 * u.uniform())).collect();
                            [value, variance, spread]
                        })
                        .collect()
                })
                .collect(),
            targets: (0..targets).map(|_| u.plane(n, Random::uniform)).collect(),
        }
    }

    fn planes(&self) -> Planes<'_> {
        Planes {
            guide: self.guide.iter().map(|[value, variance]| Channel { value, variance }).collect(),
            features: self
                .features
                .iter()
                .map(|feature| {
                    feature
                        .iter()
                        .map(|[value, variance, spread]| FeatureChannel { value, variance, spread })
                        .collect()
                })
                .collect(),
            targets: self.targets.iter().map(Vec::as_slice).collect(),
        }
    }
}

/// Everything of one call.
#[derive(Clone, Debug)]
struct Case {
    params: NlmParams,
    passes: Vec<Pass>,
    frame: Owned,
    neighbors: Vec<Owned>,
    step: Option<([Vec<f32>; 3], Rule)>,
}

impl Case {
    fn random(width: usize, height: usize, radius: usize, passes: &[Pass], features: &[usize]) -> Self {
        let mut u = Random((width * 1000 + height * 10 + radius) as u64);
        let frame = Owned::random(&mut u, width * height, 3, features, 2);
        let params = NlmParams::new(width, height, radius, 0.45);
        Self { params, passes: passes.to_vec(), frame, neighbors: Vec::new(), step: None }
    }

    fn with_step(mut self, rule: Rule) -> Self {
        let mut u = Random(7);
        // A tenth of the pixels asks for the derivative of fixed weights.
        self.step = Some((
            [0, 1, 2].map(|c| {
                let values = self.frame.guide[c][0].iter();
                values.map(|v| if u.uniform() < 0.1 { 0.0 } else { 0.01 * v }).collect()
            }),
            rule,
        ));
        self
    }

    fn with_neighbors(mut self, count: usize) -> Self {
        let mut u = Random(11);
        let features: Vec<usize> = self.frame.features.iter().map(Vec::len).collect();
        let (n, channels) = (self.params.width * self.params.height, self.frame.guide.len());
        self.neighbors = (0..count)
            .map(|_| Owned::random(&mut u, n, channels, &features, self.frame.targets.len()))
            .collect();
        self
    }

    fn inputs(&self) -> NlmInputs<'_> {
        NlmInputs {
            frame: self.frame.planes(),
            neighbors: self.neighbors.iter().map(Owned::planes).collect(),
            perturbation: self
                .step
                .as_ref()
                .map(|(step, rule)| Perturbation { step: [&step[0], &step[1], &step[2]], rule: *rule }),
        }
    }

    fn fast(&self) -> Vec<Filtered> {
        filter(&self.params, &self.passes, &self.inputs()).unwrap_or_else(|e| panic!("{e}"))
    }

    fn oracle(&self) -> Vec<Filtered<f64>> {
        filter_f64(&self.params, &self.passes, &self.inputs()).unwrap_or_else(|e| panic!("{e}"))
    }
}

fn pass(patch: Option<usize>, floor: f32) -> Pass {
    Pass { patch, floor, derivative: false }
}

/// The three candidate filters of rousselle2013rdfc.
fn candidates(derivative: bool) -> [Pass; 3] {
    [(Some(1), 1e-3), (Some(3), 1e-3), (None, 1e-4)].map(|(patch, floor)| Pass { patch, floor, derivative })
}

/// Largest deviations from the oracle: of planes, of weight sums relative to themselves, of shares, and of derivatives.
fn deviations(fast: &[Filtered], oracle: &[Filtered<f64>]) -> [f64; 4] {
    let far = |a: &[f32], b: &[f64], relative: bool| {
        assert_eq!(a.len(), b.len());
        a.iter().zip(b).fold(0.0f64, |worst, (a, b)| {
            let d = (f64::from(*a) - b).abs() / if relative { *b } else { 1.0 };
            if d.is_nan() { f64::INFINITY } else { worst.max(d) }
        })
    };
    let many = |a: &[Vec<f32>], b: &[Vec<f64>]| {
        assert_eq!(a.len(), b.len());
        a.iter().zip(b).fold(0.0f64, |worst, (a, b)| worst.max(far(a, b, false)))
    };
    let mut worst = [0.0f64; 4];
    assert_eq!(fast.len(), oracle.len());
    for (a, b) in fast.iter().zip(oracle) {
        let these = [
            many(&a.planes, &b.planes),
            far(&a.weight_sum, &b.weight_sum, true),
            far(&a.center_share, &b.center_share, false),
            many(&a.derivative, &b.derivative),
        ];
        for (worst, this) in worst.iter_mut().zip(these) {
            *worst = worst.max(this);
        }
    }
    worst
}
