//! Precisions of the slow twins.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// `f64`, in which a twin is the oracle of the tests, or `f32`, in which it is the baseline of speed ratios.
pub trait Real:
    Copy
    + PartialOrd
    + From<f32>
    + Into<f64>
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Sum
{
    /// Largest finite number.
    const MAX: Self;

    /// The nearest value of a number.
    fn round(value: f64) -> Self;
    /// e^x.
    fn exp(self) -> Self;
    /// The smaller of two; the other if one is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger of two; the other if one is NaN.
    fn max(self, other: Self) -> Self;
}

macro_rules! real {
    ($($real:ident)+) => {$(
        impl Real for $real {
            const MAX: Self = $real::MAX;

            fn round(value: f64) -> Self {
                value as $real
            }

            fn exp(self) -> Self {
                $real::exp(self)
            }

            fn min(self, other: Self) -> Self {
                $real::min(self, other)
            }

            fn max(self, other: Self) -> Self {
                $real::max(self, other)
            }
        }
    )+};
}

real! { f32 f64 }
