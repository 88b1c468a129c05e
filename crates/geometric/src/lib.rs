#![doc = include_str!("../README.md")]

mod algorithm;
mod as_written;
mod cone;
mod corrected;
mod guides;
mod params;
mod radius;
pub mod recurrence;
mod source;

#[cfg(test)]
mod tests;

pub use as_written::{GeometricAsWritten, geometric_as_written};
pub use corrected::{GeometricCorrected, geometric_corrected};
pub use params::{AsWrittenParams, CorrectedParams, FloorUnit, LARGEST_RADIUS_PX, Material, Spread};
pub use recurrence::Recurrence;
pub use source::{CITATION, README};
