//! Laws of samples with a known mean.

use noisefloor_stats::random::Normals;

/// A law of independent samples.
#[derive(Debug, Clone, Copy)]
pub enum Law {
    /// Standard normal numbers.
    Gaussian,
    /// Mean 1.
    Exponential,
    /// Exponential numbers, on the right half of the image eight times as bright.
    ExponentialEdge,
    /// exp of standard normal numbers.
    LogNormal,
    /// 1 with this probability, else 0.
    Bernoulli(f64),
}

impl Law {
    pub const ALL: [Self; 6] = [
        Self::Gaussian,
        Self::Exponential,
        Self::ExponentialEdge,
        Self::LogNormal,
        Self::Bernoulli(0.02),
        Self::Bernoulli(0.1),
    ];

    pub fn name(self) -> String {
        match self {
            Self::Gaussian => "gaussian".into(),
            Self::Exponential => "exponential".into(),
            Self::ExponentialEdge => "exponential-edge".into(),
            Self::LogNormal => "log-normal".into(),
            Self::Bernoulli(q) => format!("bernoulli-{q}"),
        }
    }

    /// Mean at a column of an image, given as a share of its width.
    pub fn mean(self, column: f64) -> f64 {
        match self {
            Self::Gaussian => 0.0,
            Self::Exponential => 1.0,
            Self::ExponentialEdge => edge(column),
            Self::LogNormal => 0.5f64.exp(),
            Self::Bernoulli(q) => q,
        }
    }

    pub fn sample(self, column: f64, random: &mut Normals) -> f64 {
        match self {
            Self::Gaussian => random.next(),
            Self::Exponential => -random.uniform().ln(),
            Self::ExponentialEdge => -random.uniform().ln() * edge(column),
            Self::LogNormal => random.next().exp(),
            Self::Bernoulli(q) => f64::from(u8::from(random.uniform() < q)),
        }
    }
}

fn edge(column: f64) -> f64 {
    if column < 0.5 { 1.0 } else { 8.0 }
}
