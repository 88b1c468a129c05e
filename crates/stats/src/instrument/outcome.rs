use serde::{Deserialize, Serialize};

use crate::holm_adjusted;

/// A statistic beside what it is without a fault.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Tested {
    /// The statistic.
    pub value: f64,
    /// What it is without a fault.
    pub expected: f64,
    /// Standard error of the statistic without a fault; above 0.
    pub standard_error: f64,
    /// Difference from the expectation in standard errors, shrunk towards 0 where the sums are skewed.
    pub z: f64,
    /// Two-sided p-value of this test alone.
    pub p: f64,
    /// The p-value adjusted for all tests of the same call by Holm's rule.
    pub adjusted: f64,
    /// Effective number of independent terms behind the standard error.
    pub effective: f64,
}

/// What a check found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Tested.
    Tested(Tested),
    /// Too few bright samples, pixels or blocks to tell: not a success.
    TooFew {
        /// Effective number of independent terms that were found.
        effective: f64,
    },
}

impl Outcome {
    /// The test, if there was one.
    #[must_use]
    pub fn tested(&self) -> Option<&Tested> {
        match self {
            Self::Tested(tested) => Some(tested),
            Self::TooFew { .. } => None,
        }
    }

    /// Whether the test, adjusted for its family, has a p-value of at most `alpha`.
    #[must_use]
    pub fn fails(&self, alpha: f64) -> bool {
        self.tested().is_some_and(|tested| tested.adjusted <= alpha)
    }
}

/// Adjusts all tests among the outcomes as one family.
pub(crate) fn adjust<'a>(outcomes: impl IntoIterator<Item = &'a mut Outcome>) {
    let mut tests: Vec<&mut Tested> = outcomes
        .into_iter()
        .filter_map(|outcome| match outcome {
            Outcome::Tested(tested) => Some(tested),
            Outcome::TooFew { .. } => None,
        })
        .collect();
    let adjusted = holm_adjusted(&tests.iter().map(|t| t.p).collect::<Vec<_>>());
    tests.iter_mut().zip(adjusted).for_each(|(test, p)| test.adjusted = p);
}
