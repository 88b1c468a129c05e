use crate::noise::{noise, surfaces};
use noisefloor_kernels::nlm::{Channel, FeatureChannel, NlmInputs, Pass, Perturbation, Planes, Rule};

/// Planes for the non-local means engine as from a renderer at 16 samples: flat surfaces of 40×40 pixels with noise,
/// and features with a tenth of it.
#[derive(Debug)]
pub struct NlmFrame {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    color: [[Vec<f32>; 2]; 3],
    halves: Vec<Vec<f32>>,
    features: Vec<[Vec<f32>; 3]>,
    step: [Vec<f32>; 3],
}

impl NlmFrame {
    /// Most feature channels of [`NlmFrame::inputs`].
    pub const FEATURE_CHANNELS: usize = 10;

    /// Fixed random numbers: the same frame on every machine.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        let mut noise = noise();
        let mean = |i: usize, c: usize| surfaces(c, i % width, i / width);
        let n = width * height;
        // The error of a half is √2 times that of the mean of both.
        let (error, feature_error) = (0.05f32, 0.005f32);
        let halves: Vec<Vec<f32>> = (0..6)
            .map(|k| (0..n).map(|i| mean(i, k % 3) + noise(error * std::f32::consts::SQRT_2)).collect())
            .collect();
        let color = [0, 1, 2].map(|c| {
            let both = halves[c].iter().zip(&halves[c + 3]);
            [both.map(|(a, b)| 0.5 * (a + b)).collect(), vec![error * error; n]]
        });
        let features = (0..Self::FEATURE_CHANNELS)
            .map(|c| {
                let value = (0..n).map(|i| mean(i, c) + noise(feature_error)).collect();
                [value, vec![feature_error * feature_error; n], vec![1e-4; n]]
            })
            .collect();
        let step = color.each_ref().map(|[value, _]| value.iter().map(|v: &f32| 0.01 * v.abs()).collect());
        Self { width, height, color, halves, features, step }
    }

    /// Both halves guided by the colour, with features of these numbers of channels.
    #[must_use]
    pub fn inputs(&self, features: &[usize]) -> NlmInputs<'_> {
        let mut channels =
            self.features.iter().map(|[value, variance, spread]| FeatureChannel { value, variance, spread });
        NlmInputs {
            frame: Planes {
                guide: self.color.iter().map(|[value, variance]| Channel { value, variance }).collect(),
                features: features.iter().map(|&count| channels.by_ref().take(count).collect()).collect(),
                targets: self.halves.iter().map(Vec::as_slice).collect(),
            },
            neighbors: Vec::new(),
            perturbation: Some(Perturbation {
                step: self.step.each_ref().map(Vec::as_slice),
                rule: Rule::Exact,
            }),
        }
    }

    /// Pixel-offsets of one sweep of window radius `radius`: for each pixel the neighbours inside the image.
    #[must_use]
    pub fn pixel_offsets(&self, radius: usize) -> u64 {
        let line = |n: usize| -> u64 {
            (0..n).map(|i| ((i + radius + 1).min(n) - i.saturating_sub(radius)) as u64).sum()
        };
        line(self.width) * line(self.height)
    }
}

/// One thing to time: passes and the features that they see.
#[derive(Debug)]
pub struct NlmVariant {
    /// Short name.
    pub name: &'static str,
    /// Passes of one sweep.
    pub passes: Vec<Pass>,
    /// Channels of each feature.
    pub features: &'static [usize],
    /// Arithmetic operations per pixel-offset without any overhead (fused multiply-add = 2), where counted.
    pub flop: Option<f64>,
}

/// What the engine is timed on: a colour filter of either patch, with features, and the three candidates of
/// rousselle2013rdfc with their derivatives in one sweep.
#[must_use]
pub fn nlm_variants() -> Vec<NlmVariant> {
    let pass = |patch, floor, derivative| Pass { patch, floor, derivative };
    let candidates = |d| vec![pass(Some(1), 1e-3, d), pass(Some(3), 1e-3, d), pass(None, 1e-4, d)];
    let variant = |name, passes, features, flop| NlmVariant { name, passes, features, flop };
    vec![
        variant("colour_f1", vec![pass(Some(1), 1e-3, false)], &[], Some(52.0)),
        variant("colour_f3", vec![pass(Some(3), 1e-3, false)], &[], Some(58.0)),
        variant("f3_10_features", vec![pass(Some(3), 1e-3, false)], &[3, 3, 3, 1], Some(128.0)),
        variant("features_only_8", vec![pass(None, 1e-4, false)], &[3, 1, 3, 1], None),
        variant("candidates_8_features", candidates(true), &[3, 1, 3, 1], None),
        variant("candidates_10_features", candidates(true), &[3, 3, 3, 1], Some(300.0)),
    ]
}
