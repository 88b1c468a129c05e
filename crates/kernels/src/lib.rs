//! Fast filter kernels, each beside a slow and obvious twin.
//!
//! A kernel here works on plain slices of planar `f32` (one slice per channel, rows of `width` values without
//! padding) and knows nothing of frames or denoisers. Each has three forms of the same mathematics: an `f64` twin
//! written straight from the formula, which is the oracle of the tests; the same loop in `f32`, the baseline of
//! every speed ratio; and the fast form, whose result has the same bits for every instruction set and any
//! number of threads.
//!
//! This is the only crate of the workspace that may use `unsafe`.

mod check;
pub mod cross_bilateral;
mod engine;
mod error;
pub mod flash_filter;
pub mod guided;
#[doc(hidden)]
pub mod inside;
pub mod joint_nlm;
pub mod nlm;
mod real;
pub mod regression;

pub use engine::{InstructionSet, NotForced, UnknownInstructionSet, Vectorised, mirror};
pub use error::KernelError;
