//! Half-widths of the homogeneity test (Sec. 3.3, Eq. 2).
//!
//! t·s_p/√n_p is half the length L of the interval around x̄_p that holds the truth with the step's probability (App. A, Eq. 3),
//! so the means of homogeneous pixels lie within L/2 of x̄_p (App. A, Eq. 4).

use noisefloor_denoiser::into_half_widths;
use noisefloor_frame::{Image, Samples};
use noisefloor_kernels::flash_filter::Membership;
use noisefloor_stats::Level;

use crate::{Params, TestKind};

/// t·s_p/√n_p per pixel, as the chosen test needs it; t two-sided with n_p − 1 degrees of freedom.
#[derive(Debug, Clone)]
pub(crate) enum Tolerance {
    /// No test.
    Off,
    /// Three channels, one set: Eq. 2 in each, which keeps Eq. 4 for each.
    Joint(Image),
    /// Three channels, three sets.
    PerChannel(Image),
    /// One channel.
    Luminance(Image),
}

impl Tolerance {
    /// From the variance of what is tested, see [`crate::spread`]; `None` switches the test off.
    pub fn new(params: &Params, variance: Option<Image>, samples: &Samples, level: Level) -> Self {
        let Some(variance) = variance else { return Self::Off };
        let half_widths = into_half_widths(variance, samples, level);
        match params.test {
            TestKind::Joint => Self::Joint(half_widths),
            TestKind::PerChannel => Self::PerChannel(half_widths),
            TestKind::Luminance => Self::Luminance(half_widths),
        }
    }

    /// The same for the kernel.
    pub fn membership(&self) -> Membership<'_> {
        match self {
            Self::Off => Membership::Off,
            Self::Joint(image) => Membership::Joint([0, 1, 2].map(|c| image.plane(c))),
            Self::PerChannel(image) => Membership::PerChannel([0, 1, 2].map(|c| image.plane(c))),
            Self::Luminance(image) => Membership::Luminance(image.plane(0)),
        }
    }
}
