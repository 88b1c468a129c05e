//! What can be asked for.

use std::fmt;
use std::str::FromStr;

use super::rows::TABLE;
use crate::FrameError;

/// A statistic of the samples of a pixel beyond mean, variance and halves, for each channel of the colour.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Statistic {
    /// Third central moment of one sample, unbiased, in cubed units of the colour.
    ThirdMoment,
    /// Smallest sample, in units of the colour.
    Least,
    /// Largest sample, in units of the colour.
    Greatest,
    /// Means of four disjoint parts of the samples, in units of the colour. Part k has the samples whose index leaves k
    /// when divided by 4: parts 0 and 2 make up half A, parts 1 and 3 half B.
    FourParts,
    /// Mean of the transformed samples, with its variance.
    BoxCox(BoxCox),
    /// Covariance of one sample with its position in the pixel, right and down, unbiased, in units of the colour times
    /// pixel widths.
    Position,
}

/// The transform g(x) = (x^λ − 1)/λ, or ln x for λ = 0, of Box and Cox (1964), of samples raised to a positive floor.
///
/// Radiance can be 0, where the logarithm and negative powers have no value: g(max(x, floor)) is taken of every sample,
/// whatever λ, and how many samples lie below the floor is kept too. The results depend on the floor where any does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxCox {
    lambda: f64,
    floor: f64,
}

impl BoxCox {
    /// With λ in −2..=2, and a floor in 10⁻⁶..=10⁶ in units of the colour.
    ///
    /// # Errors
    /// [`FrameError::Parameter`] beyond these ranges, within which no transformed sample of a radiance up to 10¹⁵ leaves
    /// the range of `f32`.
    pub fn new(lambda: f64, floor: f64) -> Result<Self, FrameError> {
        let check = |parameter, value: f64, least: f64, greatest: f64| {
            if (least..=greatest).contains(&value) {
                return Ok(());
            }
            Err(FrameError::Parameter { parameter, value, least, greatest })
        };
        check("the exponent λ of a Box–Cox transform", lambda, -2.0, 2.0)?;
        check("the floor of a Box–Cox transform", floor, 1e-6, 1e6)?;
        // No negative zero, which would have a name of its own.
        Ok(Self { lambda: lambda + 0.0, floor })
    }

    /// λ.
    #[must_use]
    pub fn lambda(self) -> f64 {
        self.lambda
    }

    /// Smaller samples count as this.
    #[must_use]
    pub fn floor(self) -> f64 {
        self.floor
    }

    /// g(max(x, floor)).
    #[must_use]
    pub fn of(self, x: f64) -> f64 {
        let log = x.max(self.floor).ln();
        if self.lambda == 0.0 {
            return log;
        }
        // Where λ·ln x is small, x^λ − 1 would cancel.
        (self.lambda * log).exp_m1() / self.lambda
    }
}

/// As it is asked for by name and called in files: the id of its row, for a Box–Cox transform with λ and the floor, such as
/// `box-cox:0.5:0.001`.
impl fmt::Display for Statistic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.row().id)?;
        match self {
            Self::BoxCox(BoxCox { lambda, floor }) => write!(f, ":{lambda}:{floor}"),
            _ => Ok(()),
        }
    }
}

impl FromStr for Statistic {
    type Err = FrameError;

    fn from_str(text: &str) -> Result<Self, FrameError> {
        let plain = [Self::ThirdMoment, Self::Least, Self::Greatest, Self::FourParts, Self::Position];
        if let Some(found) = plain.into_iter().find(|statistic| statistic.row().id == text) {
            return Ok(found);
        }
        let unknown = || {
            let ids: Vec<_> = TABLE.iter().map(|row| row.id).collect();
            let known = format!("{}, with box-cox:λ:floor such as box-cox:0.5:0.001", ids.join(", "));
            FrameError::UnknownStatistic { text: text.to_owned(), known }
        };
        let numbers = text.strip_prefix("box-cox:").and_then(|numbers| numbers.split_once(':'));
        let (lambda, floor) = numbers.ok_or_else(unknown)?;
        let number = |text: &str| text.parse::<f64>().map_err(|_| unknown());
        BoxCox::new(number(lambda)?, number(floor)?).map(Self::BoxCox)
    }
}
