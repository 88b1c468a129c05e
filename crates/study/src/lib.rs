//! Studies as plain data: study files, plans, records of cells, summaries, and exhibits for a reader.
//!
//! What runs a study, what analyses it and what shows it meet here. Nothing in this crate renders, denoises or spawns a
//! thread, so that a report, a merge or a binding to another language needs no more than this.
//!
//! * A [`Study`] is a file: scenes, samples per pixel, replicates, rows of methods, metrics.
//! * A [`record::Record`] is one finished cell: scene × samples per pixel × replicate × row.
//! * A [`summary::Summary`] is the analysis: averages over replicates, each number with its uncertainty.
//! * An [`exhibit::Document`] is what a reader sees of it: sentences, tables, charts.

mod bits;
pub mod context;
mod error;
pub mod exhibit;
pub mod files;
pub mod format;
mod key;
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
