//! The parameters with every "as the profile says" resolved.

use noisefloor_frame::Sampling;
use noisefloor_kernels::regression::dense;

use super::params::{
    Channels, Depth, Exposure, Guide, NegativeError, Params, Profile, Solver, VarianceScaling,
};

/// What program and pseudo-code, and those who measure, decide differently.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Settings {
    pub channels: Channels,
    pub solver: Solver,
    pub depth: Depth,
    pub negative_error: NegativeError,
    pub guide: Guide,
    pub feature_guide: Guide,
    pub last_feature_window: usize,
    pub last_feature_patch: usize,
    pub last_factor: f64,
    pub positions: bool,
    pub exposure: Exposure,
    pub variance_scaling: VarianceScaling,
}

impl Settings {
    /// The first author's program.
    const PROGRAM: Self = Self {
        channels: Channels::Minimum,
        solver: Solver::Dropped,
        depth: Depth::Raw,
        negative_error: NegativeError::Kept,
        guide: Guide::OppositeHalf,
        feature_guide: Guide::OppositeHalf,
        last_feature_window: 2,
        last_feature_patch: 3,
        last_factor: 2.0,
        positions: true,
        exposure: Exposure::AsIs,
        variance_scaling: VarianceScaling::Never,
    };
    /// The pseudo-code; where it is silent the program.
    const PAPER: Self = Self { guide: Guide::SameHalf, last_factor: 1.0, positions: false, ..Self::PROGRAM };
    /// What wins by measurement.
    const BEST: Self = Self {
        solver: Solver::MinimalNorm,
        negative_error: NegativeError::Clamped,
        exposure: Exposure::Common,
        variance_scaling: VarianceScaling::Auto,
        ..Self::PROGRAM
    };

    pub fn of(params: &Params) -> Self {
        let profile = match params.profile {
            Profile::Program => Self::PROGRAM,
            Profile::Paper => Self::PAPER,
            Profile::Best => Self::BEST,
        };
        Self {
            channels: params.channels.unwrap_or(profile.channels),
            solver: params.solver.unwrap_or(profile.solver),
            depth: params.depth.unwrap_or(profile.depth),
            negative_error: params.negative_error.unwrap_or(profile.negative_error),
            guide: params.guide.unwrap_or(profile.guide),
            feature_guide: params.feature_guide.unwrap_or(profile.feature_guide),
            last_feature_window: params.last_feature_window_radius_px.unwrap_or(profile.last_feature_window),
            last_feature_patch: params.last_feature_patch_radius_px.unwrap_or(profile.last_feature_patch),
            last_factor: params.last_variance_factor.unwrap_or(profile.last_factor),
            positions: params.positions.unwrap_or(profile.positions),
            exposure: params.exposure.unwrap_or(profile.exposure),
            variance_scaling: params.variance_scaling.unwrap_or(profile.variance_scaling),
        }
    }

    /// Whether sample variances of such a frame are scaled.
    pub fn scales(&self, sampling: Sampling) -> bool {
        match self.variance_scaling {
            VarianceScaling::Auto => sampling != Sampling::Independent,
            VarianceScaling::Always => true,
            VarianceScaling::Never => false,
        }
    }

    pub fn join(&self) -> dense::Join {
        match self.channels {
            Channels::Minimum => dense::Join::Minimum,
            Channels::Mean => dense::Join::Mean,
        }
    }

    pub fn kernel_solver(&self) -> dense::Solver {
        match self.solver {
            Solver::Dropped => dense::Solver::Dropped,
            Solver::MinimalNorm => dense::Solver::MinimalNorm,
        }
    }
}
