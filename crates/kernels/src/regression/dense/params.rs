//! Parameters and input planes, and the check that they make sense. All limits are ours.

use crate::KernelError;
use crate::check::{self, count, real};
use crate::nlm::{Channel, MAX_PIXELS, MAX_VALUE, MAX_VARIANCE};

/// Largest window radius in pixels.
pub const MAX_WINDOW_RADIUS: usize = 16;
/// Largest patch radius in pixels.
pub const MAX_PATCH_RADIUS: usize = 3;
/// Most scalar features of a model.
pub const MAX_FEATURES: usize = 29;
/// Most columns of a model: the constant, positions and features.
pub(super) const MOST: usize = 3 + MAX_FEATURES;
/// Most channels of one call of [`super::means`].
pub const MAX_CHANNELS: usize = 32;
/// Range of ε.
pub const MIN_EPSILON: f32 = 1e-36;
/// Range of ε.
pub const MAX_EPSILON: f32 = 1e25;
/// Range of k.
pub const MIN_K: f32 = 1e-3;
/// Range of k.
pub const MAX_K: f32 = 1e3;
/// Range of s.
pub const MIN_SCALE: f32 = 1e-3;
/// Range of s.
pub const MAX_SCALE: f32 = 1e3;

/// What weights are made with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighting {
    /// Image width in pixels, at least 1.
    pub width: usize,
    /// Image height in pixels, at least 1.
    pub height: usize,
    /// R: radius of the window in pixels, 0 to [`MAX_WINDOW_RADIUS`]; windows are cut at the border of the image.
    pub window: usize,
    /// F: radius of the patch in pixels, 0 to [`MAX_PATCH_RADIUS`].
    pub patch: usize,
    /// k: damping of distances, [`MIN_K`] to [`MAX_K`]. Larger blurs more.
    pub k: f32,
    /// s: what variances are multiplied by, [`MIN_SCALE`] to [`MAX_SCALE`]: 2 where the guide is a half buffer and the
    /// variance that of the mean of both.
    pub scale: f32,
    /// ε: what is added to denominators, in squared units of the guide, [`MIN_EPSILON`] to [`MAX_EPSILON`].
    pub epsilon: f32,
}

/// How the distances of the guide's channels become one weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Join {
    /// The smallest of their weights.
    Minimum,
    /// The weight of the mean distance.
    Mean,
}

/// What becomes of columns that the window's pixels do not tell apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Their coefficient is 0, found by pivoting.
    Dropped,
    /// Among all solutions the one of least norm, columns in units of their range; the constant is not penalised.
    MinimalNorm,
}

/// What models are fitted with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// The weights.
    pub weighting: Weighting,
    /// How channels are joined.
    pub join: Join,
    /// The solver.
    pub solver: Solver,
    /// Whether the positions x and y are columns beside the constant and the features.
    pub positions: bool,
}

/// A channel that is filtered by itself.
#[derive(Clone, Debug)]
pub struct Alone<'a> {
    /// What its weights come from.
    pub guide: Channel<'a>,
    /// Planes to filter with them, magnitude at most [`MAX_VARIANCE`], as squares are filtered too.
    pub targets: Vec<&'a [f32]>,
}

/// Planes of a regression, each of width·height values in rows.
#[derive(Clone, Debug)]
pub struct Planes<'a> {
    /// What weights come from: at least one channel.
    pub guide: Vec<Channel<'a>>,
    /// Scalar features, at most [`MAX_FEATURES`], magnitude at most [`MAX_VARIANCE`].
    pub features: Vec<&'a [f32]>,
    /// What is fitted, magnitude at most [`MAX_VARIANCE`].
    pub image: [&'a [f32]; 3],
}

impl Weighting {
    fn check(&self) -> Result<(), KernelError> {
        check::size(self.width, self.height, MAX_PIXELS)?;
        count("window radius", self.window, 0, MAX_WINDOW_RADIUS)?;
        count("patch radius", self.patch, 0, MAX_PATCH_RADIUS)?;
        real("k", self.k, MIN_K, MAX_K)?;
        real("s", self.scale, MIN_SCALE, MAX_SCALE)?;
        real("ε", self.epsilon, MIN_EPSILON, MAX_EPSILON)
    }

    fn guide(&self, channel: &Channel<'_>) -> Result<(), KernelError> {
        self.plane("guide", channel.value, "a magnitude of at most 1e15", |v| v.abs() <= MAX_VALUE)?;
        // An unknown variance is NaN: distances are the largest there.
        let known = |v: f32| v.is_nan() || (0.0..=MAX_VARIANCE).contains(&v);
        self.plane("variance", channel.variance, "NaN, or 0 to 1e30", known)
    }

    fn values(&self, name: &'static str, plane: &[f32]) -> Result<(), KernelError> {
        // Mean squared errors are filtered too: squares of values.
        self.plane(name, plane, "a magnitude of at most 1e30", |v| v.abs() <= MAX_VARIANCE)
    }

    fn plane(
        &self,
        plane: &'static str,
        values: &[f32],
        allowed: &'static str,
        good: impl Fn(f32) -> bool + Sync,
    ) -> Result<(), KernelError> {
        check::plane(|| plane.to_owned(), values, (self.width, self.height), allowed, good)
    }

    /// Checks a call of [`super::means`].
    ///
    /// # Errors
    /// The first parameter or plane that is out of range.
    pub fn check_means(&self, channels: &[Alone<'_>]) -> Result<(), KernelError> {
        self.check()?;
        count("channels", channels.len(), 0, MAX_CHANNELS)?;
        for channel in channels {
            self.guide(&channel.guide)?;
            channel.targets.iter().try_for_each(|target| self.values("target", target))?;
        }
        Ok(())
    }
}

impl Fit {
    /// Checks a call of [`super::regress`].
    ///
    /// # Errors
    /// The first parameter or plane that is out of range.
    pub fn check(&self, planes: &Planes<'_>) -> Result<(), KernelError> {
        self.weighting.check()?;
        count("guide channels", planes.guide.len(), 1, MAX_CHANNELS)?;
        count("features", planes.features.len(), 0, MAX_FEATURES)?;
        planes.guide.iter().try_for_each(|channel| self.weighting.guide(channel))?;
        planes.features.iter().try_for_each(|feature| self.weighting.values("feature", feature))?;
        planes.image.iter().try_for_each(|image| self.weighting.values("image", image))
    }
}
