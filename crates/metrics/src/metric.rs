//! What a metric is.

use crate::MetricError;
use crate::pixels::Pixels;

/// Which values of a metric are good.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Better {
    /// Of an error.
    Lower,
    /// Of a score.
    Higher,
    /// Of a balance, which can be off to either side: not ranked, and in no ratio to another row's.
    CloserTo(f64),
}

impl std::fmt::Display for Better {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Lower => f.write_str("lower"),
            Self::Higher => f.write_str("higher"),
            Self::CloserTo(ideal) => write!(f, "closer to {ideal}"),
        }
    }
}

/// How a metric's number comes about.
#[derive(Debug, Clone, Copy)]
pub enum Rule {
    /// The mean, over the pixels asked for, of a value that every pixel has: made once for an image, row-major, whatever it
    /// holds in pixels that do not [take part](Pixels::take_part). `None` where the metric is not defined.
    Map(fn(&Pixels<'_>) -> Result<Option<Vec<f64>>, MetricError>),
    /// The number over some pixels, at least one; a bootstrap asks for pixels several times.
    Over(fn(&Pixels<'_>, &[usize]) -> Option<f64>),
}

/// A metric: what its number means, and how it comes about.
#[derive(Debug, Clone, Copy)]
pub struct Metric {
    /// Stable id, as in records.
    pub id: &'static str,
    /// Short name for tables and plots.
    pub name: &'static str,
    /// Formula: x test, r reference, p pixels, c channels.
    pub formula: &'static str,
    /// ε, if the formula has one.
    pub epsilon: Option<f64>,
    /// What is averaged over what, in which order.
    pub averaging: &'static str,
    /// Which values are good.
    pub better: Better,
    /// Unit, or empty for a pure number.
    pub unit: &'static str,
    /// Whether the reference's noise is taken out.
    pub reference_noise_removed: bool,
    /// Power of the error that it measures: 2 for squared errors, 1 for their root, `None` where plain Monte
    /// Carlo has no fixed rate. Under independent sampling its expectation is c/n (2) for plain Monte Carlo.
    pub order: Option<u32>,
    /// What happens to values that are NaN or infinite.
    pub non_finite: &'static str,
    /// How the number comes about.
    pub rule: Rule,
}

impl Metric {
    /// A pure number, smaller is better, without ε, correction for the reference's noise or a rate of convergence; with
    /// `..` from here an entry says what is different.
    #[must_use]
    pub const fn new(id: &'static str, name: &'static str, formula: &'static str, rule: Rule) -> Self {
        Self {
            id,
            name,
            formula,
            epsilon: None,
            averaging: "mean over pixels",
            better: Better::Lower,
            unit: "",
            reference_noise_removed: false,
            order: None,
            non_finite: LEFT_OUT,
            rule,
        }
    }

    /// The formula with everything that a reader needs beside it: averaging order and what happens to the
    /// reference's noise.
    #[must_use]
    pub fn formula_text(&self) -> String {
        let noise = if self.reference_noise_removed {
            "reference noise removed"
        } else {
            "not corrected for the reference's noise"
        };
        format!("{}; {}; {noise}", self.formula, self.averaging)
    }
}

const LEFT_OUT: &str = "a pixel with a NaN or infinite channel is counted and left out";
