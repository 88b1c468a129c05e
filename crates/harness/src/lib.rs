#![doc = include_str!("../README.md")]

mod access;
mod cache;
mod error;
mod fingerprint;
mod forecast;
mod gate;
mod laboratory;
mod looks;
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
pub use forecast::{Forecast, SpreadsOf, forecast, spreads_of};
pub use gate::{GateFailure, gate};
pub use laboratory::{Laboratory, Passing};
pub use memory::{MemoryEstimate, memory_estimate};
pub use observer::{Observer, Silent, Stage, Workload};
pub use reanalyse::{reanalyse, reanalyse_into};
pub use recorded::{analysis_of, record as record_study};
pub use run::{StudyRun, run};
pub use study_of_folder::study_of_folder;
