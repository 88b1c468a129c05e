//! The parameters with every "as the profile says" resolved.

use noisefloor_kernels::nlm::{Center, Denominator, Rule};

use crate::params::{CenterWeight, DerivativeRule, FeatureDenominator, Profile, SecondPass, Ties};
use crate::{Gradient, Params, VarianceScaling};

/// Least weight of a pixel in its own mean, for [`CenterWeight::LargestNeighbor`].
const LEAST_CENTER: f32 = 1e-3;
/// τ of FIRST and SECOND.
pub(crate) const FLOOR: f32 = 1e-3;
/// τ of THIRD, and of the program's second pass.
pub(crate) const LOW_FLOOR: f32 = 1e-4;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Settings {
    pub radius: usize,
    pub color_k: f32,
    pub feature_k: f32,
    pub gradient: Gradient,
    pub prefilter: Option<Prefilter>,
    pub scaling: VarianceScaling,
    pub denominator: Denominator,
    pub center: Center,
    pub rule: Rule,
    pub ties: Ties,
    pub second_pass: SecondPass,
    pub map_patch: usize,
    /// Whether sampling densities divide by what contributes, as the program does, or by one more than that.
    pub plain_density: bool,
}

/// The features' own filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Prefilter {
    pub k: f32,
    pub radius: usize,
    pub patch: usize,
}

impl Settings {
    pub fn new(params: &Params) -> Self {
        let paper = params.profile == Profile::Paper;
        let pick = |own, authors| if paper { own } else { authors };
        let denominator = params.feature_denominator.unwrap_or(if paper {
            FeatureDenominator::Centre
        } else {
            FeatureDenominator::Pair
        });
        let center = params.center_weight.unwrap_or(if paper {
            CenterWeight::One
        } else {
            CenterWeight::LargestNeighbor
        });
        let rule =
            params.derivative.unwrap_or(if paper { DerivativeRule::Exact } else { DerivativeRule::Joint });
        Self {
            radius: params.window_radius_px,
            color_k: params.color_k as f32,
            feature_k: params.feature_k as f32,
            gradient: params.gradient,
            prefilter: params.prefilter.then_some(Prefilter {
                k: params.prefilter_k as f32,
                radius: params.prefilter_window_radius_px,
                patch: params.prefilter_patch_radius_px,
            }),
            scaling: params.variance_scaling,
            denominator: match denominator {
                FeatureDenominator::Centre => Denominator::Center,
                FeatureDenominator::Pair => Denominator::Pair,
            },
            center: match center {
                CenterWeight::One => Center::One,
                CenterWeight::LargestNeighbor => Center::LargestNeighbor { least: LEAST_CENTER },
            },
            rule: match rule {
                DerivativeRule::Exact => Rule::Exact,
                DerivativeRule::Joint => Rule::Joint,
            },
            ties: params.ties.unwrap_or(if paper { Ties::Earlier } else { Ties::Later }),
            second_pass: params.second_pass.unwrap_or(if paper {
                SecondPass::Text
            } else {
                SecondPass::Code
            }),
            map_patch: params.map_patch_radius_px.unwrap_or(pick(1, 3)),
            plain_density: !paper,
        }
    }
}
