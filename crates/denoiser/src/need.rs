//! What a method cannot run without.

use std::fmt;

use noisefloor_frame::{FeatureId, Flash, Frame, Sampling};

/// One input that a method cannot run without.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Need {
    /// Variance of the colour mean.
    ColorVariance,
    /// Half buffers of the colour.
    ColorHalves,
    /// At least this many samples in every pixel.
    Samples(u32),
    /// Independent samples, so that s²/n is the variance of the mean.
    IndependentSamples,
    /// A feature's mean.
    Feature(FeatureId),
    /// A feature's mean and its variance.
    FeatureVariance(FeatureId),
    /// A feature's half buffers.
    FeatureHalves(FeatureId),
    /// The virtual flash image: either ready-made or in parts.
    Flash,
    /// Variance of the virtual flash image (for parts: of both).
    FlashVariance,
    /// Third central moment of the colour's samples, an optional statistic.
    ThirdMoment,
    /// Least and greatest sample of the colour, optional statistics.
    Extremes,
}

impl Need {
    /// Whether the frame has it.
    #[must_use]
    pub fn is_met(&self, frame: &Frame) -> bool {
        match self {
            Self::ColorVariance => frame.color.variance.is_some(),
            Self::ColorHalves => frame.color.halves.is_some(),
            Self::Samples(n) => frame.samples.total().least() >= *n,
            Self::IndependentSamples => frame.sampling == Sampling::Independent,
            Self::Feature(id) => frame.feature(id).is_some(),
            Self::FeatureVariance(id) => frame.feature(id).is_some_and(|f| f.variance.is_some()),
            Self::FeatureHalves(id) => frame.feature(id).is_some_and(|f| f.halves.is_some()),
            Self::Flash => frame.flash.is_some(),
            Self::FlashVariance => match &frame.flash {
                Some(Flash::Parts { base, light, .. }) => base.variance.is_some() && light.variance.is_some(),
                Some(Flash::Ready(flash)) => flash.variance.is_some(),
                None => false,
            },
            Self::ThirdMoment => frame.optional.third_moment().is_some(),
            Self::Extremes => frame.optional.least().is_some() && frame.optional.greatest().is_some(),
        }
    }
}

impl fmt::Display for Need {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ColorVariance => f.write_str("variance of the colour mean"),
            Self::ColorHalves => f.write_str("half buffers of the colour"),
            Self::Samples(n) => write!(f, "at least {n} samples in every pixel"),
            Self::IndependentSamples => f.write_str("independent samples"),
            Self::Feature(id) => write!(f, "feature `{id}`"),
            Self::FeatureVariance(id) => write!(f, "feature `{id}` with its variance"),
            Self::FeatureHalves(id) => write!(f, "feature `{id}` with its half buffers"),
            Self::Flash => f.write_str("virtual flash image"),
            Self::FlashVariance => f.write_str("variance of the virtual flash image"),
            Self::ThirdMoment => {
                f.write_str("third moment of the samples: `statistics = [\"third-moment\"]`")
            }
            Self::Extremes => {
                f.write_str("least and greatest samples: `statistics = [\"least\", \"greatest\"]`")
            }
        }
    }
}
