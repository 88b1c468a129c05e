//! A check of the instrument itself: of frames, references and of what counts intervals.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Which check it is. Its number is for people who look it up in METHODOLOGY.md.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum CheckKind {
    /// Coverage on normal samples, which is nominal.
    #[serde(rename = "I1")]
    Normal,
    /// Missed events and coverage on rare events, which are known exactly.
    #[serde(rename = "I2")]
    Rare,
    /// Spread of half buffers against the stated variance.
    #[serde(rename = "I3")]
    Halves,
    /// Brightness of frames against their reference.
    #[serde(rename = "I4")]
    Brightness,
    /// Independence of frames, their reference and each other.
    #[serde(rename = "I5")]
    Dependence,
    /// Brightness of scenes whose image is known in closed form.
    #[serde(rename = "I6")]
    ClosedForm,
    /// Estimates of the own error where the variance is known.
    #[serde(rename = "I7")]
    KnownVariance,
}

impl CheckKind {
    /// All.
    pub const ALL: [Self; 7] = [
        Self::Normal,
        Self::Rare,
        Self::Halves,
        Self::Brightness,
        Self::Dependence,
        Self::ClosedForm,
        Self::KnownVariance,
    ];

    /// Its number.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Normal => "I1",
            Self::Rare => "I2",
            Self::Halves => "I3",
            Self::Brightness => "I4",
            Self::Dependence => "I5",
            Self::ClosedForm => "I6",
            Self::KnownVariance => "I7",
        }
    }

    /// What is checked.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "coverage of normal samples",
            Self::Rare => "rare events",
            Self::Halves => "half buffers against the variance",
            Self::Brightness => "brightness against the reference",
            Self::Dependence => "independence",
            Self::ClosedForm => "closed-form brightness",
            Self::KnownVariance => "error estimates at known variance",
        }
    }
}

impl fmt::Display for CheckKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.id(), self.name())
    }
}

/// One check on one scene at one level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CheckRecord {
    /// Which.
    pub kind: CheckKind,
    /// What exactly was looked at, such as `95 % intervals`.
    pub what: String,
    /// Scene id.
    pub scene: String,
    /// Samples per pixel, if it is about one level.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spp: Option<u32>,
    /// What was found; none where too few bright samples tell nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found: Option<CheckFound>,
    /// Why there is nothing, or what the numbers do not say.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

/// A statistic beside what it is without a fault.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CheckFound {
    /// The statistic.
    pub value: f64,
    /// What it is without a fault.
    pub expected: f64,
    /// Difference in standard errors.
    pub z: f64,
    /// p-value of this check alone; 0 for what cannot happen without a fault.
    pub p: f64,
}
