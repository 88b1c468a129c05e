//! First-order models of the colour, fitted by weighted least squares.

pub mod dense;
