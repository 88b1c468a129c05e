//! The parameters with every "as the profile says" resolved.

use noisefloor_frame::Far;
use noisefloor_kernels::nlm::{
    Border, Center, Denominator, GuideDenominator, Pairs, Rule, Smoothing, Taps, WeightRules,
};

use crate::params::{
    CenterWeight, ColorDenominator, Density, DepthRange, DerivativeRule, FeatureDenominator, PatchTaps,
    Profile, SecondPass, Ties, WindowBorder,
};
use crate::{Gradient, Params, VarianceScaling};

/// Least weight of a pixel in its own mean, for [`CenterWeight::LargestNeighbor`]: the authors' program's.
const LEAST_CENTER: f32 = 1e-3;
/// τ of FIRST and SECOND (Alg. 1, line 9 and Alg. 1, line 11): printed 10E−3, and 10⁻³ in the authors' program.
pub(crate) const FLOOR: f32 = 1e-3;
/// τ of THIRD and of the second pass (Alg. 1, line 13 and Alg. 1, line 27): printed 10E−4, and 10⁻⁴ in the authors' program. It
/// has a say in the program's second pass only, as the printed one has no features.
pub(crate) const LOW_FLOOR: f32 = 1e-4;

/// What the sources, and those who measure, decide differently.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Choices {
    gradient: Gradient,
    depth_range: DepthRange,
    feature_denominator: FeatureDenominator,
    center_weight: CenterWeight,
    derivative: DerivativeRule,
    ties: Ties,
    second_pass: SecondPass,
    second_pass_denominator: ColorDenominator,
    map_patch: usize,
    weight_smoothing: bool,
    symmetric_pairs: bool,
    window_border: WindowBorder,
    patch_taps: PatchTaps,
    density: Density,
}

impl Choices {
    /// The printed text. Where it is silent ours: slope, depth range, derivative of three channels, and ties, of which the later
    /// would blur noise-free input.
    const PAPER: Self = Self {
        gradient: Gradient::Central,
        depth_range: DepthRange::Largest,
        feature_denominator: FeatureDenominator::Centre, // Sec. 5, Φ²
        center_weight: CenterWeight::One,                // Eq. 2 and Eq. 3 at q = p
        derivative: DerivativeRule::Exact,
        ties: Ties::Earlier,
        second_pass: SecondPass::Text,                   // Alg. 1, line 27
        second_pass_denominator: ColorDenominator::Pair, // Sec. 4, Δ²
        map_patch: 1,                                    // Alg. 1, line 15 and Alg. 1, line 22
        weight_smoothing: false,
        symmetric_pairs: false,
        window_border: WindowBorder::Clipped,
        patch_taps: PatchTaps::Mirrored,
        density: Density::Text, // Sec. 8
    };
    /// The authors' program: read off its source, not printed.
    const AUTHORS: Self = Self {
        gradient: Gradient::MinHalf,
        depth_range: DepthRange::Common,
        feature_denominator: FeatureDenominator::Pair,
        center_weight: CenterWeight::LargestNeighbor,
        derivative: DerivativeRule::Joint,
        ties: Ties::Program,
        second_pass: SecondPass::Code,
        second_pass_denominator: ColorDenominator::TwiceCentre,
        map_patch: 3,
        weight_smoothing: true,
        symmetric_pairs: true,
        window_border: WindowBorder::Mirrored,
        patch_taps: PatchTaps::Clipped,
        density: Density::Code,
    };
    /// What wins by measurement.
    const BEST: Self = Self {
        gradient: Gradient::Central,
        derivative: DerivativeRule::Exact,
        ties: Ties::Later,
        weight_smoothing: false,
        symmetric_pairs: false,
        window_border: WindowBorder::Clipped,
        patch_taps: PatchTaps::Mirrored,
        // It takes light from pixels that are brighter than their surroundings, and gains little elsewhere.
        second_pass: SecondPass::Off,
        density: Density::Effective,
        ..Self::AUTHORS
    };

    fn of(params: &Params) -> Self {
        let profile = match params.profile {
            Profile::Paper => Self::PAPER,
            Profile::Authors => Self::AUTHORS,
            Profile::Best => Self::BEST,
        };
        Self {
            gradient: params.gradient.unwrap_or(profile.gradient),
            depth_range: params.depth_range.unwrap_or(profile.depth_range),
            feature_denominator: params.feature_denominator.unwrap_or(profile.feature_denominator),
            center_weight: params.center_weight.unwrap_or(profile.center_weight),
            derivative: params.derivative.unwrap_or(profile.derivative),
            ties: params.ties.unwrap_or(profile.ties),
            second_pass: params.second_pass.unwrap_or(profile.second_pass),
            second_pass_denominator: params
                .second_pass_denominator
                .unwrap_or(profile.second_pass_denominator),
            map_patch: params.map_patch_radius_px.unwrap_or(profile.map_patch),
            weight_smoothing: params.weight_smoothing.unwrap_or(profile.weight_smoothing),
            symmetric_pairs: params.symmetric_pairs.unwrap_or(profile.symmetric_pairs),
            window_border: params.window_border.unwrap_or(profile.window_border),
            patch_taps: params.patch_taps.unwrap_or(profile.patch_taps),
            density: params.density.unwrap_or(profile.density),
        }
    }
}

impl Choices {
    /// What the engine does beside the printed weights.
    fn rules(&self) -> WeightRules {
        WeightRules {
            smoothing: if self.weight_smoothing { Smoothing::BelowPatch } else { Smoothing::None },
            pairs: if self.symmetric_pairs { Pairs::Near } else { Pairs::None },
            border: match self.window_border {
                WindowBorder::Clipped => Border::Clipped,
                WindowBorder::Mirrored => Border::Mirrored,
            },
            taps: match self.patch_taps {
                PatchTaps::Mirrored => Taps::Mirrored,
                PatchTaps::Clipped => Taps::Clipped,
            },
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Settings {
    pub radius: usize,
    pub color_k: f32,
    pub feature_k: f32,
    pub gradient: Gradient,
    pub far: Far,
    pub prefilter: Option<Prefilter>,
    pub scaling: VarianceScaling,
    pub denominator: Denominator,
    pub center: Center,
    pub rule: Rule,
    pub ties: Ties,
    pub second_pass: SecondPass,
    pub second_denominator: GuideDenominator,
    pub map_patch: usize,
    /// Of every filter but the candidates.
    pub rules: WeightRules,
    pub density: Density,
}

/// The features' own filter (Sec. 5; Alg. 1, line 5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Prefilter {
    pub k: f32,
    pub radius: usize,
    pub patch: usize,
}

impl Settings {
    /// Rules of the candidates: a smoothed weight would have no derivative.
    pub fn candidate_rules(&self) -> WeightRules {
        WeightRules { smoothing: Smoothing::None, ..self.rules }
    }

    pub fn new(params: &Params) -> Self {
        let choices = Choices::of(params);
        Self {
            radius: params.window_radius_px,
            color_k: params.color_k as f32,
            feature_k: params.feature_k as f32,
            gradient: choices.gradient,
            far: match choices.depth_range {
                DepthRange::Largest => Far::Largest,
                DepthRange::Common => Far::Common,
            },
            prefilter: params.prefilter.then_some(Prefilter {
                k: params.prefilter_k as f32,
                radius: params.prefilter_window_radius_px,
                patch: params.prefilter_patch_radius_px,
            }),
            scaling: params.variance_scaling,
            denominator: match choices.feature_denominator {
                FeatureDenominator::Centre => Denominator::Center,
                FeatureDenominator::Pair => Denominator::Pair,
            },
            center: match choices.center_weight {
                CenterWeight::One => Center::One,
                CenterWeight::LargestNeighbor => Center::LargestNeighbor { least: LEAST_CENTER },
            },
            rule: match choices.derivative {
                DerivativeRule::Exact => Rule::Exact,
                DerivativeRule::Joint => Rule::Joint,
            },
            ties: choices.ties,
            second_pass: choices.second_pass,
            second_denominator: match choices.second_pass_denominator {
                ColorDenominator::Pair => GuideDenominator::Pair,
                ColorDenominator::TwiceCentre => GuideDenominator::TwiceCenter,
            },
            map_patch: choices.map_patch,
            rules: choices.rules(),
            density: choices.density,
        }
    }
}
