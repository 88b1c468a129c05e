//! Parameters, and what is refused.

use crate::KernelError;
use crate::check::{self, count, real};

/// Most pixels that an image may have.
pub const MAX_PIXELS: usize = 1 << 31;
/// Most guide channels.
pub const MAX_GUIDES: usize = 16;
/// Most planes that are averaged in one call.
pub const MAX_AVERAGED: usize = 1024;
/// Most filters of a bank.
pub const MAX_FILTERS: usize = 32;
/// Largest window radius in pixels.
pub const MAX_RADIUS: usize = 64;
/// Largest magnitude of a guide's value.
pub const MAX_VALUE: f32 = 1e7;
/// Largest variance of a guide.
pub const MAX_VARIANCE: f32 = 1e14;
/// Largest magnitude of what is averaged.
pub const MAX_MAGNITUDE: f32 = 1e30;

/// What all filters of a bank share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BilateralParams {
    /// Image width in pixels, at least 1.
    pub width: usize,
    /// Image height in pixels, at least 1.
    pub height: usize,
    /// Least variance of a difference, in squared units of the guides, 1e-12 to 1e6; li2012sbf has 0.01.
    pub floor: f32,
}

/// One guide channel.
#[derive(Clone, Copy, Debug)]
pub struct BilateralGuide<'a> {
    /// f_k, at most [`MAX_VALUE`] in magnitude.
    pub value: &'a [f32],
    /// S_k in squared units of `value`, 0 to [`MAX_VARIANCE`]. Used as it is: li2012sbf hands in the variance of the samples,
    /// not that of their mean.
    pub variance: &'a [f32],
    /// σ_k, a number without unit, 0.001 to 100.
    pub sigma: f32,
}

/// One filter of a bank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spatial {
    /// σ_i in pixels, 0 to 1e6. At 0 no neighbour has a weight: planes come back as they are, W is 1.
    pub sigma: f32,
    /// Window radius in pixels, at most [`MAX_RADIUS`]; may be larger than the image.
    pub radius: usize,
}

impl Spatial {
    /// The radius that li2012sbf takes: 2σ to the nearest whole number, halves up.
    #[must_use]
    pub fn new(sigma: f32) -> Self {
        // Out of range is 0 or very large, for the check to find.
        Self { sigma, radius: (2.0 * sigma).round() as usize }
    }

    /// The window's radius where anything but the pixel itself has a weight, else 0.
    pub(super) fn reach(&self) -> usize {
        if self.sigma > 0.0 { self.radius } else { 0 }
    }
}

impl BilateralParams {
    /// Checks everything that [`super::filter`] refuses: sizes, numbers of things, parameters and values out of range or not
    /// finite.
    ///
    /// # Errors
    /// The first thing that is wrong; of values with plane and pixel.
    pub fn check(
        &self,
        guides: &[BilateralGuide<'_>],
        planes: &[&[f32]],
        bank: &[Spatial],
    ) -> Result<(), KernelError> {
        check::size(self.width, self.height, MAX_PIXELS)?;
        // These keep products of two denominators among the normal numbers.
        real("variance floor", self.floor, 1e-12, 1e6)?;
        count("guide channels", guides.len(), 0, MAX_GUIDES)?;
        count("averaged planes", planes.len(), 1, MAX_AVERAGED)?;
        count("filters", bank.len(), 1, MAX_FILTERS)?;
        for spatial in bank {
            real("spatial sigma", spatial.sigma, 0.0, 1e6)?;
            count("window radius", spatial.radius, 0, MAX_RADIUS)?;
        }
        let size = (self.width, self.height);
        for (i, guide) in guides.iter().enumerate() {
            real("sigma of a guide", guide.sigma, 1e-3, 1e2)?;
            let (value, variance) = (|| format!("guide {i}"), || format!("variance of guide {i}"));
            check::plane(value, guide.value, size, "a magnitude of at most 1e7", |v| v.abs() <= MAX_VALUE)?;
            check::plane(variance, guide.variance, size, "0 to 1e14", |v| (0.0..=MAX_VARIANCE).contains(&v))?;
        }
        for (i, plane) in planes.iter().enumerate() {
            let name = || format!("averaged plane {i}");
            check::plane(name, plane, size, "a magnitude of at most 1e30", |v| v.abs() <= MAX_MAGNITUDE)?;
        }
        Ok(())
    }
}
