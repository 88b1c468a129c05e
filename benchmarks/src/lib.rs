//! What the whole-workspace benchmarks share; see the files beside this package.

mod flash_frame;
mod method_frame;
mod nlm_frame;
mod noise;

pub use flash_frame::flash_frame;
pub use method_frame::method_frame;
pub use nlm_frame::{NlmFrame, NlmVariant, nlm_variants};
pub use noise::{noise, surfaces};
