//! Statistics of the colour that a frame carries only where they were asked for.
//!
//! Each is one [`Row`] of one table, [`TABLE`]: what is kept of the samples, how one is added, how two sets of samples
//! are put together, and what comes of it. [`Gathering`] is a choice of rows, [`Gathered`] what they have seen of one
//! pixel, [`Optional`] what a frame has of them. All samples of a pixel, [`Tapped`], have no fixed size and are kept
//! beside the table.

mod gathered;
mod names;
mod recorded;
mod rows;
mod statistic;
mod tap;
#[cfg(test)]
mod tests;

pub use gathered::{Block, Gathered, Gathering};
pub use recorded::{BoxCoxMoments, FourParts, Optional};
pub use rows::{Row, TABLE};
pub use statistic::{BoxCox, Statistic};
pub use tap::{Tapped, TappedSample};
