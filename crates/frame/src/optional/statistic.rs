//! What can be asked for.

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
