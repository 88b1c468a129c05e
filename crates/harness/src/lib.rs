#![doc = include_str!("../README.md")]

mod analysis;
mod cache;
mod context;
mod error;
mod fingerprint;
mod flicker;
mod machine;
mod measure;
mod memory;
mod metric;
mod observer;
mod plan;
mod reanalyse;
pub mod record;
mod recorded;
mod run;
mod source;
mod store;
mod study;
pub mod summary;

pub use analysis::violations;
pub use error::{HarnessError, Place};
pub use memory::{MemoryEstimate, memory_estimate};
pub use observer::{Observer, Silent, Stage, Workload};
pub use reanalyse::{reanalyse, reanalyse_into};
pub use recorded::{analysis_of, record as record_study};
pub use run::{StudyRun, run};
pub use study::{
    AdaptiveFrames, BuiltinStudy, FIGURES, Family, Maps, MethodRow, PaperComparison, PaperRatio,
    ReferenceSpec, Replicates, RowFrames, SceneSource, SceneSpec, Shot, Study, Timing, builtin_studies,
};

/// The id of the baseline: the input itself.
pub const BASELINE: &str = "mc";

/// The three names closest to `given`, closest first.
fn nearest<'a>(given: &str, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    // The time that a comparison takes grows with the product of both lengths.
    let given = given.char_indices().nth(100).map_or(given, |(end, _)| &given[..end]);
    let mut ranked: Vec<(f64, &str)> = names.map(|n| (strsim::jaro_winkler(given, n), n)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    ranked.into_iter().take(3).map(|(_, n)| n.to_owned()).collect()
}
