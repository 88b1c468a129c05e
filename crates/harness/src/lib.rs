//! Study files to plan to cells to records to analysis, resumable at every stage.
//!
//! The harness is *handed* the registry and names no method. Everything that a report needs is in the
//! [`record`]s and the [`summary`]; a report never runs anything.

pub mod record;
pub mod summary;
