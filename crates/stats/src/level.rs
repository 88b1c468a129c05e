use serde::{Deserialize, Serialize};
use thiserror::Error;

/// On how many sides an interval is limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sides {
    /// α/2 outside on either side.
    Two,
    /// α above the limit, nothing below.
    Upper,
}

/// A confidence level: probability 1−α and sidedness, never a bare number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Raw")]
pub struct Level {
    confidence: f64,
    sides: Sides,
}

/// A level as it stands in a file.
#[derive(Deserialize)]
#[serde(rename = "Level")]
struct Raw {
    confidence: f64,
    sides: Sides,
}

impl TryFrom<Raw> for Level {
    type Error = LevelError;

    fn try_from(raw: Raw) -> Result<Self, LevelError> {
        Self::new(raw.confidence, raw.sides)
    }
}

/// A confidence outside (0, 1).
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("confidence level is {confidence}, it must lie strictly between 0 and 1")]
pub struct LevelError {
    /// The value given.
    pub confidence: f64,
}

impl Level {
    /// 95 %, two-sided.
    pub const TWO_SIDED_95: Self = Self { confidence: 0.95, sides: Sides::Two };
    /// 99 %, two-sided.
    pub const TWO_SIDED_99: Self = Self { confidence: 0.99, sides: Sides::Two };
    /// 99.8 %, two-sided.
    pub const TWO_SIDED_998: Self = Self { confidence: 0.998, sides: Sides::Two };

    /// A two-sided level.
    ///
    /// # Errors
    /// If `confidence` is not strictly between 0 and 1.
    pub fn two_sided(confidence: f64) -> Result<Self, LevelError> {
        Self::new(confidence, Sides::Two)
    }

    /// An upper one-sided level.
    ///
    /// # Errors
    /// If `confidence` is not strictly between 0 and 1.
    pub fn upper(confidence: f64) -> Result<Self, LevelError> {
        Self::new(confidence, Sides::Upper)
    }

    fn new(confidence: f64, sides: Sides) -> Result<Self, LevelError> {
        if confidence > 0.0 && confidence < 1.0 {
            Ok(Self { confidence, sides })
        } else {
            Err(LevelError { confidence })
        }
    }

    /// 1−α.
    #[must_use]
    pub fn confidence(self) -> f64 {
        self.confidence
    }

    /// α.
    #[must_use]
    pub fn alpha(self) -> f64 {
        1.0 - self.confidence
    }

    /// Sidedness.
    #[must_use]
    pub fn sides(self) -> Sides {
        self.sides
    }

    /// Probability in the upper tail beyond the critical value: α/2 or α.
    #[must_use]
    pub fn upper_tail(self) -> f64 {
        match self.sides {
            Sides::Two => 0.5 * self.alpha(),
            Sides::Upper => self.alpha(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_probabilities_are_levels() {
        for bad in [0.0, 1.0, -0.5, 99.0, f64::NAN] {
            assert!(Level::two_sided(bad).is_err());
        }
        assert!((Level::TWO_SIDED_99.upper_tail() - 0.005).abs() < 1e-15);
        assert!((Level::upper(0.95).unwrap().upper_tail() - 0.05).abs() < 1e-15);
    }
}
