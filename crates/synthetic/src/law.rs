use crate::SyntheticError;
use crate::random::Stream;

/// Law of one sample of a pixel and channel whose true mean is μ. The mean of every law is exactly μ.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum SampleLaw {
    /// Normal with a constant standard deviation, or with one proportional to |μ|.
    Gaussian {
        /// Standard deviation of one sample: radiance, or a multiple of |μ| if `relative`. At least 0.
        sd: f64,
        /// Whether `sd` is a multiple of |μ|.
        relative: bool,
    },
    /// Exponential: variance μ². Needs μ ≥ 0.
    Exponential,
    /// μ·exp(σZ − σ²/2): variance μ²·(exp σ² − 1). Needs μ ≥ 0.
    LogNormal {
        /// Standard deviation of the logarithm, in (0, 4].
        sigma: f64,
    },
    /// Rare bright event: μ·(1−b) always, and b·μ/q more with probability q: variance (bμ)²·(1−q)/q. Needs μ
    /// ≥ 0.
    Bernoulli {
        /// Probability q of the event, in (0, 1].
        q: f64,
        /// Share b of the mean that the event carries, in (0, 1]; 1 leaves zero without the event.
        bright: f64,
    },
}

impl SampleLaw {
    /// Name in study files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Gaussian { .. } => "gaussian",
            Self::Exponential => "exponential",
            Self::LogNormal { .. } => "log-normal",
            Self::Bernoulli { .. } => "bernoulli",
        }
    }

    /// Variance of one sample where the true mean is `mean`, squared radiance.
    #[must_use]
    pub fn variance(&self, mean: f64) -> f64 {
        match *self {
            Self::Gaussian { sd, relative } => (if relative { sd * mean } else { sd }).powi(2),
            Self::Exponential => mean * mean,
            Self::LogNormal { sigma } => mean * mean * (sigma * sigma).exp_m1(),
            // q > 0 by validation.
            Self::Bernoulli { q, bright } => (bright * mean).powi(2) * (1.0 - q) / q,
        }
    }

    /// Whether samples are normal, so that t-intervals are exact.
    #[must_use]
    pub fn is_normal(&self) -> bool {
        matches!(self, Self::Gaussian { .. })
    }

    pub(crate) fn needs_positive_mean(&self) -> bool {
        !self.is_normal()
    }

    pub(crate) fn check(&self) -> Result<(), SyntheticError> {
        let range = |parameter, value: f64, ok: bool, allowed| {
            if ok { Ok(()) } else { Err(SyntheticError::OutOfRange { parameter, value, allowed }) }
        };
        match *self {
            Self::Gaussian { sd, .. } => {
                range("sd", sd, sd.is_finite() && sd >= 0.0, "a finite number of at least 0")
            }
            Self::Exponential => Ok(()),
            Self::LogNormal { sigma } => {
                range("sigma", sigma, sigma > 0.0 && sigma <= 4.0, "above 0, at most 4")
            }
            Self::Bernoulli { q, bright } => {
                range("q", q, q > 0.0 && q <= 1.0, "above 0, at most 1")?;
                range("bright", bright, bright > 0.0 && bright <= 1.0, "above 0, at most 1")
            }
        }
    }

    /// One sample per channel around `mean`; with `common`, one random number drives all channels.
    #[inline]
    pub(crate) fn draw(&self, mean: [f64; 3], common: bool, stream: &mut Stream) -> [f64; 3] {
        /// Turns a random number per channel, or one for all, into samples.
        #[inline]
        fn each(
            mean: [f64; 3],
            common: bool,
            mut random: impl FnMut() -> f64,
            sample: impl Fn(f64, f64) -> f64,
        ) -> [f64; 3] {
            if common {
                let r = random();
                mean.map(|m| sample(m, r))
            } else {
                mean.map(|m| sample(m, random()))
            }
        }
        match *self {
            Self::Gaussian { sd, relative: false } => {
                each(mean, common, || stream.normal(), |m, z| m + sd * z)
            }
            Self::Gaussian { sd, relative: true } => {
                each(mean, common, || stream.normal(), |m, z| m + sd * m * z)
            }
            // u lies in the open unit interval.
            Self::Exponential => each(mean, common, || -stream.uniform().ln(), |m, e| m * e),
            Self::LogNormal { sigma } => {
                let shift = 0.5 * sigma * sigma;
                each(mean, common, || (sigma * stream.normal() - shift).exp(), |m, f| m * f)
            }
            Self::Bernoulli { q, bright } => {
                let (without, with) = (1.0 - bright, 1.0 - bright + bright / q);
                each(mean, common, || if stream.uniform() < q { with } else { without }, |m, f| m * f)
            }
        }
    }
}
