//! Studies: what is asked, on which scenes, at how many samples, of which methods.

mod builtin;
mod check;
mod compare;
mod frames;
mod limits;
mod lines;
mod model;
mod of_scene;
mod parse;
mod plain;
mod rows;
mod sequence;
mod shot;

pub use builtin::{BuiltinStudy, builtin_studies};
pub use compare::{PaperComparison, PaperRatio};
pub use frames::{AdaptiveFrames, RowFrames};
pub use limits::LONGEST_NAME;
pub use model::{FIGURES, MethodRow, ReferenceSpec, Replicates, SceneSource, SceneSpec, Study, Timing};
pub use noisefloor_stats::Family;
pub use shot::Shot;
