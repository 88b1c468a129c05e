//! Tests of whether two pixels have the same mean: which of its neighbours a filter averages.

mod expected;
mod mean;
mod rejections;
mod test;
#[cfg(test)]
mod tests;
mod welch;

pub use expected::interval_rejection;
pub use mean::SampleMean;
pub use rejections::{RejectionTally, rejections};
pub use test::MembershipTest;
