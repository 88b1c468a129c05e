//! Do frames and reference keep what every number of a study rests on? Pure statistics of the checks of the instrument
//! itself.

mod bernoulli;
mod blocks;
mod brightness;
mod correlation;
mod dependence;
mod halves;
mod outcome;
mod residuals;
mod weights;

pub use bernoulli::{BernoulliCoverage, bernoulli_coverage, missed_by_all};
pub use blocks::Blocks;
pub use brightness::{BrightnessCheck, SampledTruth, brightness};
pub use correlation::{Correlation, correlation};
pub use dependence::{Dependence, FrameMeans, dependence};
pub use halves::{HalvedFrame, half_variance_ratio};
pub use outcome::{Outcome, Tested};
pub use residuals::{LEAST_EFFECTIVE, PixelPair, ResidualSums, Spread, shrunk};
pub use weights::smooth_weights;
