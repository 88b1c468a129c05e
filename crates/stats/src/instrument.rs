//! Do frames and reference keep what every number of a study rests on? Pure statistics of the checks of the instrument
//! itself.

mod blocks;
mod correlation;
mod residuals;
mod weights;

pub use blocks::Blocks;
pub use correlation::{Correlation, correlation};
pub use residuals::{LEAST_EFFECTIVE, PixelPair, ResidualSums, Spread, shrunk};
pub use weights::smooth_weights;
