//! Runs studies: plan, frames, cells, records, resumable at every stage.
//!
//! The harness is *handed* the registry and names no method but the baseline; it asks every question of
//! `noisefloor_questions` and knows none. What it reads and writes is plain data of `noisefloor_study`.
//!
//! * [`run`] plans a study, renders or imports its frames, denoises, measures, appends one record per finished cell, and
//!   has the records analysed. Called again it continues.
//! * [`reanalyse`] makes the summary again from what a study's folder keeps.

mod cache;
mod error;
mod fingerprint;
mod machine;
mod memory;
mod observer;
mod plan;
mod reanalyse;
mod recorded;
mod row;
mod run;
mod source;
mod store;
mod study_of_folder;

pub use error::HarnessError;
pub use memory::{MemoryEstimate, memory_estimate};
pub use observer::{Observer, Silent, Stage, Workload};
pub use reanalyse::{reanalyse, reanalyse_into};
pub use recorded::{analysis_of, record as record_study};
pub use run::{StudyRun, run};
pub use study_of_folder::study_of_folder;
