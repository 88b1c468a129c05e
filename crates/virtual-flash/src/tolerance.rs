//! Half-widths of the homogeneity test (Eq. 2).

use noisefloor_denoiser::half_widths;
use noisefloor_frame::{Image, Samples, luminance};
use noisefloor_kernels::flash_filter::{self, Membership};
use noisefloor_stats::Level;

use crate::{Params, TestKind};

/// t·s_p/√n_p per pixel, as the chosen test needs it.
#[derive(Debug, Clone)]
pub(crate) enum Tolerance {
    /// No test.
    Off,
    /// Three channels, one set.
    Joint(Image),
    /// Three channels, three sets.
    PerChannel(Image),
    /// One channel.
    Luminance(Image),
}

impl Tolerance {
    /// From the variance of what is tested; `None` switches the test off.
    pub fn new(params: &Params, variance: Option<&Image>, samples: &Samples, level: Level) -> Self {
        let Some(variance) = variance.filter(|_| params.homogeneous) else { return Self::Off };
        match params.test {
            TestKind::Joint => Self::Joint(half_widths(variance, samples, level)),
            TestKind::PerChannel => Self::PerChannel(half_widths(variance, samples, level)),
            TestKind::Luminance => {
                Self::Luminance(half_widths(&luminance_variance(variance), samples, level))
            }
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

    /// For each channel, whether pixel `q` is homogeneous with `p`: the kernel's test, for the loops that it does not cover.
    pub fn members(&self, source: &Image, p: usize, q: usize) -> [bool; 3] {
        let passes = |v_p: f32, v_q: f32, tolerance: f32| {
            (v_q - v_p).abs() <= flash_filter::half_width(tolerance, v_p)
        };
        let channel =
            |image: &Image, c: usize| passes(source.plane(c)[p], source.plane(c)[q], image.plane(c)[p]);
        match self {
            Self::Off => [true; 3],
            Self::Joint(image) => [(0..3).all(|c| channel(image, c)); 3],
            Self::PerChannel(image) => [0, 1, 2].map(|c| channel(image, c)),
            Self::Luminance(image) => {
                let of = |p: usize| {
                    let [r, g, b] = [0, 1, 2].map(|c| source.plane(c)[p]);
                    flash_filter::luminance(r, g, b)
                };
                [passes(of(p), of(q), image.plane(0)[p]); 3]
            }
        }
    }
}

/// Variance of luminance if the channels were fully correlated: (Σ weight·standard deviation)². An upper bound of the true
/// one, whose covariances a frame does not carry.
fn luminance_variance(variance: &Image) -> Image {
    Image::from_fn(variance.width(), variance.height(), 1, |_, x, y| {
        luminance([0, 1, 2].map(|c| variance.get(c, x, y).max(0.0).sqrt())).powi(2)
    })
}
