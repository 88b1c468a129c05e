//! Weighted first-order regression over windows.

pub mod dense;
pub mod models;
