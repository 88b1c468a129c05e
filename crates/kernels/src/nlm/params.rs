//! Parameters and input planes of the engine, and the check that both make sense. All limits are ours.

use super::{Smoothing, WeightRules};
use crate::KernelError;
use crate::check::{self, count, real};

/// Largest window radius in pixels.
pub const MAX_WINDOW_RADIUS: usize = 32;
/// Largest patch radius in pixels.
pub const MAX_PATCH_RADIUS: usize = 3;
/// Largest magnitude of a guide, feature or target value. Squared differences stay far from overflow.
pub const MAX_VALUE: f32 = 1e15;
/// Largest variance or spread.
pub const MAX_VARIANCE: f32 = 1e30;
/// Most pixels that an image may have.
pub const MAX_PIXELS: usize = 1 << 31;
/// Most channels of a guide.
pub const MAX_GUIDE_CHANNELS: usize = 4;
/// Most channels of all features together.
pub const MAX_FEATURE_CHANNELS: usize = 32;
/// Most passes of one call.
pub const MAX_PASSES: usize = 4;
/// Range of ε.
pub const MIN_EPSILON: f32 = 1e-36;
/// Range of ε.
pub const MAX_EPSILON: f32 = 1e6;
/// Range of k and k_f.
pub const MIN_K: f32 = 1e-3;
/// Range of k and k_f.
pub const MAX_K: f32 = 1e3;
/// Range of τ.
pub const MIN_FLOOR: f32 = 1e-6;
/// Range of τ.
pub const MAX_FLOOR: f32 = 1e6;

/// Usual ε of Δ² (Sec. 4, which prints no number): the authors' program's.
const EPSILON: f32 = 1e-10;

/// What all passes of one call share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NlmParams {
    /// Image width in pixels, at least 1.
    pub width: usize,
    /// Image height in pixels, at least 1.
    pub height: usize,
    /// Window radius r in pixels: (2r+1)² pixels, at the image border by [`WeightRules::border`]. 0 to [`MAX_WINDOW_RADIUS`].
    pub window_radius: usize,
    /// k: damping of guide distances, [`MIN_K`] to [`MAX_K`]. Larger blurs more.
    pub k: f32,
    /// κ: share of the expected noise that is taken off squared guide differences, 0 to 4; 1 makes d² zero on average
    /// where only noise differs.
    pub cancellation: f32,
    /// Denominator of Δ².
    pub guide_denominator: GuideDenominator,
    /// ε: what denominators of Δ² are at least, a variance; [`MIN_EPSILON`] to [`MAX_EPSILON`]. Guides whose values are
    /// of order 1 have 1e-10 in the program of rousselle2013rdfc; what is added to variances must scale with them.
    pub epsilon: f32,
    /// k_f: damping of feature distances, [`MIN_K`] to [`MAX_K`].
    pub feature_k: f32,
    /// Denominator of Φ².
    pub denominator: Denominator,
    /// Weight of the pixel itself.
    pub center: Center,
    /// What the authors' programs do beside the printed formulas.
    pub rules: WeightRules,
}

/// Denominator of Δ², beside ε.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuideDenominator {
    /// k²·(v(p) + v(q)), as printed in rousselle2013rdfc, Sec. 4: a bright outlier q, whose variance is as large as
    /// itself, looks similar to every p.
    Pair,
    /// 2·k²·v(p), as in the second pass of the authors' program: p alone says what is noise.
    TwiceCenter,
}

/// Denominator of Φ²_j: which pixels' D = max(τ, s) it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Denominator {
    /// k_f²·D(p), as printed in rousselle2013rdfc, Sec. 5, above Eq. 3.
    Center,
    /// k_f²·(D(p) + D(q)), as in the authors' program.
    Pair,
}

/// Weight that the pixel itself gets in its own mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Center {
    /// What the formula gives: 1.
    One,
    /// The largest weight among the neighbours, at least `least` (above 0, at most 1): lonely bright pixels are spread.
    LargestNeighbor {
        /// Weight of a pixel without any similar neighbour.
        least: f32,
    },
}

/// One sweep's weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// Patch radius f in pixels, 0 to [`MAX_PATCH_RADIUS`]; `None`: k = ∞, the guide has no say and w_c = 1.
    pub patch: Option<usize>,
    /// τ: least D of a feature, [`MIN_FLOOR`] to [`MAX_FLOOR`].
    pub floor: f32,
    /// Whether to give the derivative; needs [`NlmInputs::perturbation`]. Without a patch it is w(p,p)/Σw.
    pub derivative: bool,
}

/// A channel of a guide.
#[derive(Clone, Copy, Debug)]
pub struct Channel<'a> {
    /// Values, magnitude at most [`MAX_VALUE`].
    pub value: &'a [f32],
    /// Variances of the values, 0 to [`MAX_VARIANCE`].
    pub variance: &'a [f32],
}

/// A channel of a feature.
#[derive(Clone, Copy, Debug)]
pub struct FeatureChannel<'a> {
    /// Values, magnitude at most [`MAX_VALUE`].
    pub value: &'a [f32],
    /// Residual variances of the values, 0 to [`MAX_VARIANCE`].
    pub variance: &'a [f32],
    /// s: what a difference is measured against beside τ, 0 to [`MAX_VARIANCE`]: in rousselle2013rdfc the larger of
    /// variance and squared gradient.
    pub spread: &'a [f32],
}

/// A feature: channels whose Φ² are averaged.
pub type Feature<'a> = Vec<FeatureChannel<'a>>;

/// All planes of one frame, each of width·height values in rows.
#[derive(Clone, Debug, Default)]
pub struct Planes<'a> {
    /// Guide; may be empty if no pass has a patch. At most [`MAX_GUIDE_CHANNELS`].
    pub guide: Vec<Channel<'a>>,
    /// Features; none: w_f = 1.
    pub features: Vec<Feature<'a>>,
    /// Planes to filter, magnitude at most [`MAX_VALUE`].
    pub targets: Vec<&'a [f32]>,
}

/// Steps of the finite difference.
#[derive(Clone, Copy, Debug)]
pub struct Perturbation<'a> {
    /// δ for each of the guide's three channels at each pixel, 0 to [`MAX_VALUE`]. Where it is 0 the derivative is
    /// w(p,p)/Σw, the value for fixed weights.
    pub step: [&'a [f32]; 3],
    /// How the guide's value at p is moved.
    pub rule: Rule,
}

/// How the guide's value at p is moved for the derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Each channel alone, wherever p is the centre of its own patch or a tap of a neighbour's: what running the
    /// filter again would give, but for pixels nearer to the border than f, where the mirrored copies of p stay as
    /// they were.
    Exact,
    /// All channels at once and the centre of p's own patch only, as in the authors' program.
    Joint,
}

/// Input planes.
#[derive(Clone, Debug)]
pub struct NlmInputs<'a> {
    /// The frame to filter.
    pub frame: Planes<'a>,
    /// Frames beside it, with as many planes; the window is searched in them too. Their spreads count with
    /// [`Denominator::Pair`] only.
    pub neighbors: Vec<Planes<'a>>,
    /// For passes with a derivative; the guide must have three channels.
    pub perturbation: Option<Perturbation<'a>>,
}

/// What a pass gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Filtered<T = f32> {
    /// The filtered targets in their order.
    pub planes: Vec<Vec<T>>,
    /// Σ_q w(p,q), the pixel itself included.
    pub weight_sum: Vec<T>,
    /// w(p,p)/Σ_q w(p,q): the derivative of the mean if the weights were fixed.
    pub center_share: Vec<T>,
    /// dF_c/dg_c at p, three planes; empty if the pass asks for none.
    pub derivative: Vec<Vec<T>>,
}

impl NlmParams {
    /// Parameters of a plain guided sweep: κ = 1, ε = 1e-10, the printed denominators and weights, centre weight 1; k_f = 0.6
    /// as in rousselle2013rdfc, Alg. 1, lines 9, 11 and 13.
    #[must_use]
    pub fn new(width: usize, height: usize, window_radius: usize, k: f32) -> Self {
        Self {
            width,
            height,
            window_radius,
            k,
            cancellation: 1.0,
            guide_denominator: GuideDenominator::Pair,
            epsilon: EPSILON,
            feature_k: 0.6,
            denominator: Denominator::Center,
            center: Center::One,
            rules: WeightRules::default(),
        }
    }

    /// Checks the parameters and every input value.
    ///
    /// # Errors
    /// The first thing that is out of range; see [`KernelError`].
    pub fn check(&self, passes: &[Pass], inputs: &NlmInputs<'_>) -> Result<(), KernelError> {
        check::size(self.width, self.height, MAX_PIXELS)?;
        count("window radius", self.window_radius, 0, MAX_WINDOW_RADIUS)?;
        real("k", self.k, MIN_K, MAX_K)?;
        real("cancellation", self.cancellation, 0.0, 4.0)?;
        real("epsilon", self.epsilon, MIN_EPSILON, MAX_EPSILON)?;
        real("feature k", self.feature_k, MIN_K, MAX_K)?;
        if let Center::LargestNeighbor { least } = self.center {
            real("least centre weight", least, f32::MIN_POSITIVE, 1.0)?;
        }
        count("number of passes", passes.len(), 1, MAX_PASSES)?;
        for pass in passes {
            count("patch radius", pass.patch.unwrap_or(0), 0, MAX_PATCH_RADIUS)?;
            real("floor", pass.floor, MIN_FLOOR, MAX_FLOOR)?;
        }
        let frame = &inputs.frame;
        count("number of guide channels", frame.guide.len(), 0, MAX_GUIDE_CHANNELS)?;
        if frame.guide.is_empty() && passes.iter().any(|pass| pass.patch.is_some()) {
            return Err(KernelError::Mismatch { what: "a pass has a patch, but there is no guide".into() });
        }
        let channels: usize = frame.features.iter().map(Vec::len).sum();
        count("number of feature channels", channels, 0, MAX_FEATURE_CHANNELS)?;
        for feature in &frame.features {
            count("number of channels of a feature", feature.len(), 1, MAX_FEATURE_CHANNELS)?;
        }
        self.check_derivative(passes, inputs)?;
        self.check_planes("", frame)?;
        for (i, neighbor) in inputs.neighbors.iter().enumerate() {
            let shape = |planes: &Planes<'_>| {
                (
                    planes.guide.len(),
                    planes.features.iter().map(Vec::len).collect::<Vec<_>>(),
                    planes.targets.len(),
                )
            };
            if shape(neighbor) != shape(frame) {
                return Err(KernelError::Mismatch {
                    what: format!("neighbouring frame {i} has other planes than the frame to filter"),
                });
            }
            self.check_planes(&format!(" of neighbouring frame {i}"), neighbor)?;
        }
        Ok(())
    }

    fn check_derivative(&self, passes: &[Pass], inputs: &NlmInputs<'_>) -> Result<(), KernelError> {
        if passes.iter().any(|pass| pass.derivative && pass.patch.is_some()) {
            if self.rules.smoothing != Smoothing::None {
                // A smoothed weight of p depends on the patches of the pixels around p.
                let what = "smoothed weights have no derivative by the guide".into();
                return Err(KernelError::Mismatch { what });
            }
            if inputs.perturbation.is_none() {
                let what = "a pass with a derivative needs a perturbation".into();
                return Err(KernelError::Mismatch { what });
            }
            let channels = inputs.frame.guide.len();
            if channels != 3 {
                let what = format!("a derivative needs a guide of 3 channels, it has {channels}");
                return Err(KernelError::Mismatch { what });
            }
        }
        if let Some(perturbation) = &inputs.perturbation {
            for (c, step) in perturbation.step.iter().enumerate() {
                self.plane(|| format!("step {c}"), step, "0 to 1e15", |v| (0.0..=MAX_VALUE).contains(&v))?;
            }
        }
        Ok(())
    }

    /// One plane and each of its values.
    fn plane(
        &self,
        name: impl Fn() -> String,
        values: &[f32],
        allowed: &'static str,
        good: impl Fn(f32) -> bool + Sync,
    ) -> Result<(), KernelError> {
        check::plane(name, values, (self.width, self.height), allowed, good)
    }

    fn check_planes(&self, whose: &str, planes: &Planes<'_>) -> Result<(), KernelError> {
        let value = |name: &str, i: usize, values: &[f32]| {
            let name = || format!("{name} {i}{whose}");
            self.plane(name, values, "a magnitude of at most 1e15", |v| v.abs() <= MAX_VALUE)
        };
        let variance = |name: &str, i: usize, values: &[f32]| {
            let name = || format!("{name} {i}{whose}");
            self.plane(name, values, "0 to 1e30", |v| (0.0..=MAX_VARIANCE).contains(&v))
        };
        for (i, channel) in planes.guide.iter().enumerate() {
            value("guide channel", i, channel.value)?;
            variance("variance of guide channel", i, channel.variance)?;
        }
        for (i, channel) in planes.features.iter().flatten().enumerate() {
            value("feature channel", i, channel.value)?;
            variance("variance of feature channel", i, channel.variance)?;
            variance("spread of feature channel", i, channel.spread)?;
        }
        for (i, target) in planes.targets.iter().enumerate() {
            value("target", i, target)?;
        }
        Ok(())
    }
}
