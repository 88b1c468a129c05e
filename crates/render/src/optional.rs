//! Optional statistics of a rendering: how they are asked for, what a pixel keeps, and what a frame gets.

mod plan;
mod record;
mod tally;
mod taps;

pub use plan::{OptionalPlan, put};
pub use record::OptionalRecord;
pub use tally::{OptionalTally, Positions};
pub use taps::Taps;
