//! What the whole-workspace benchmarks share; see the files beside this package.

mod nlm_frame;

pub use nlm_frame::{NlmFrame, NlmVariant, nlm_variants};
