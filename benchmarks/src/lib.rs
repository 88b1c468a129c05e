//! What the whole-workspace benchmarks share; see the files beside this package.

mod flash_frame;
mod method_frame;
mod model;
mod nlm_frame;
mod noise;
mod regression;

pub use flash_frame::flash_frame;
pub use method_frame::method_frame;
pub use model::one_model;
pub use nlm_frame::{NlmFrame, NlmVariant, nlm_variants};
pub use noise::{noise, surfaces};
pub use regression::{naive_patch_means, naive_regression, patch_means, regression};
