//! Parameters in the form that steps use.

use noisefloor_kernels::regression::models::Rules;

use crate::Params;
use crate::params::{Assembled, KSum};

/// Bandwidths that a model chooses from (Sec. 4).
const BANDWIDTHS: [f64; 5] = [1.0, 1.5, 2.0, 3.5, 4.0];
/// A pixel takes part in a fit if its weight is at least this share of the least that is covered; ours: what it would add is
/// below that share.
const LEAST_SHARE: f64 = 1e-5;
/// Most bandwidths; ours, room in [`crate::centres::Center`].
pub(crate) const MOST_BANDWIDTHS: usize = BANDWIDTHS.len();

/// What the models and their blend need.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Settings {
    /// Bandwidths, ascending.
    pub bandwidths: Vec<f32>,
    /// θ.
    pub coverage: f32,
    pub divided: bool,
    pub assembled: Assembled,
    /// T.
    pub steps: usize,
    pub prefiltered: bool,
    pub growth: usize,
    /// Side of a tile and how far windows reach beyond it.
    pub tile: usize,
    pub reach: usize,
    pub rules: Rules,
}

impl Settings {
    pub fn new(params: &Params) -> Self {
        let bandwidths: Vec<f32> = match params.fixed_k {
            Some(k) => vec![k as f32],
            None => BANDWIDTHS.iter().map(|k| (k * params.k_scale) as f32).collect(),
        };
        let radii = [params.small_radius_px, params.growth_radius_px, params.large_radius_px];
        Self {
            coverage: params.coverage as f32,
            divided: params.k_sum == KSum::Divided,
            assembled: params.assembled,
            steps: params.iterations,
            prefiltered: params.fit == crate::Fit::Prefiltered,
            growth: params.growth_radius_px,
            tile: 2 * params.large_radius_px + 1,
            reach: radii.into_iter().max().unwrap_or(0),
            rules: Rules {
                patch_radius: params.patch_radius_px,
                range_sigma: params.range_sigma as f32,
                bandwidths: bandwidths.clone(),
                least_weight: (params.coverage * LEAST_SHARE) as f32,
                ridge: params.ridge,
            },
            bandwidths,
        }
    }

    /// g_t of Eq. 12, for t from 1 on: 1 − 1/(t+1)².
    pub fn step_weight(t: usize) -> f64 {
        1.0 - 1.0 / ((t + 1) as f64).powi(2)
    }
}
