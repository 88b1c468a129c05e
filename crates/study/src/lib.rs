#![doc = include_str!("../README.md")]

mod bits;
pub mod check;
pub mod context;
mod error;
pub mod exhibit;
pub mod files;
pub mod format;
mod key;
pub mod look;
pub mod metric;
mod names;
mod over_time;
pub mod plan;
pub mod record;
mod study;
pub mod summary;

pub use bits::{Bits, hash_of_frame};
pub use error::{Place, StudyError};
pub use key::{Key, key_of, seed_of};
pub use names::BASELINE;
pub use over_time::{Corrected, Flicker, OverTime};
pub use study::{
    AdaptiveFrames, BuiltinStudy, FIGURES, Family, LONGEST_NAME, MethodRow, PaperComparison, PaperRatio,
    ReferenceSpec, Replicates, RowFrames, SceneSource, SceneSpec, Shot, Study, Timing, builtin_studies,
};

pub use noisefloor_frame::Maps;
