//! A first-order model at every pixel, and the non-local means that weigh it: the two filters of bitterli2016.
//!
//! For pixel p and its neighbours q = p + d in the window of radius R, cut at the border of the image, with guide g of variance
//! v, of which a = s·v(p) and b = s·v(q):
//!
//! ```text
//! Δ²(p)  = ((g(p) − g(q))² − (a + min(a, b))) / (k²·(a + b) + ε),  at most 1e4; 1e4 where it is NaN
//! d²(p)  = mean of Δ²(p + n) over |n|∞ ≤ F with p + n and q + n inside the image
//! w(p,q) = exp(−max(0, d²)), of each channel alone; w(p,p) at least 1e-4
//! ```
//!
//! [`means`] gives Σ w·u(q) / Σ w of each channel with its own weights. [`regress`] joins the channels' weights and fits, in every
//! window, the colour by a constant, the position and the features:
//!
//! ```text
//! x(q) = [1, x_q − x_p, y_q − y_p, f_j(q) − f_j(p) …],  β = argmin Σ_q w(p,q)·|u(q) − x(q)·β|²
//! out(q) = Σ_p w(p,q)·x(q)·β(p) / Σ_p w(p,q)
//! ```
//!
//! The model of p predicts all pixels of its window. Columns that the window's pixels do not tell apart are left to a
//! [`Solver`]. Weights are made in `f32`; differences, sums, solution and prediction in `f64`, as which columns depend on others
//! is decided at 1.42e-14 of their squares, or at 1e-9 of the largest eigenvalue.
//!
//! Each pixel's sums are taken in one order whatever the instruction set and the number of threads.

mod distances;
mod fit;
mod guide;
mod job;
mod means;
mod minimal_norm;
mod model;
mod moments;
pub mod naive;
mod params;
mod predict;
mod prediction;
mod solve;
mod spectrum;
mod units;
mod weigh;

pub use crate::nlm::Channel;
pub use params::{
    Alone, Fit, Join, MAX_CHANNELS, MAX_EPSILON, MAX_FEATURES, MAX_K, MAX_PATCH_RADIUS, MAX_SCALE,
    MAX_WINDOW_RADIUS, MIN_EPSILON, MIN_K, MIN_SCALE, Planes, Solver, Weighting,
};

use crate::engine::InstructionSet;
use crate::{KernelError, check};

/// Filters every channel by itself with the fastest instruction set of this machine: for each its targets.
///
/// # Errors
/// As [`Weighting::check_means`].
///
/// ```
/// use noisefloor_kernels::regression::dense::{Alone, Channel, Weighting, means};
///
/// // A step of height 10 and noise of variance 1: the values on each side are averaged among themselves.
/// let noisy = [0.5, -0.5, 0.5, 10.5, 9.5, 10.5];
/// let guide = Channel { value: &noisy, variance: &[1.0; 6] };
/// let weighting = Weighting { width: 6, height: 1, window: 5, patch: 0, k: 0.5, scale: 1.0, epsilon: 1e-7 };
/// let filtered = means(&weighting, &[Alone { guide, targets: vec![&noisy] }])?;
/// assert!(filtered[0][0][..3].iter().all(|v| (v - 0.5 / 3.0).abs() < 1e-6));
/// # Ok::<(), noisefloor_kernels::KernelError>(())
/// ```
pub fn means(weighting: &Weighting, channels: &[Alone<'_>]) -> Result<Vec<Vec<Vec<f32>>>, KernelError> {
    means_at(weighting, channels, InstructionSet::in_use())
}

/// [`means`] with a given instruction set. Every level gives the same bits.
///
/// # Errors
/// As there, and [`KernelError::LevelUnavailable`].
pub fn means_at(
    weighting: &Weighting,
    channels: &[Alone<'_>],
    level: InstructionSet,
) -> Result<Vec<Vec<Vec<f32>>>, KernelError> {
    weighting.check_means(channels)?;
    check::available(level)?;
    Ok(means::filter(weighting, channels, level))
}

/// Fits a model at every pixel with the fastest instruction set of this machine, and gives the mean of what all windows predict.
///
/// # Errors
/// As [`Fit::check`].
pub fn regress(fit: &Fit, planes: &Planes<'_>) -> Result<[Vec<f32>; 3], KernelError> {
    regress_at(fit, planes, InstructionSet::in_use())
}

/// [`regress`] with a given instruction set. Every level gives the same bits.
///
/// # Errors
/// As there, and [`KernelError::LevelUnavailable`].
pub fn regress_at(
    fit: &Fit,
    planes: &Planes<'_>,
    level: InstructionSet,
) -> Result<[Vec<f32>; 3], KernelError> {
    fit.check(planes)?;
    check::available(level)?;
    Ok(fit::regress(fit, planes, level))
}
