//! Test-only: synthetic frames, derived tolerances, hard cases and the conformance check.
//!
//! A method's own tests, and those of the whole workspace, run every method through [`hard_cases`] with
//! [`check_method`]: each case must end in finite output or a typed error.
//!
//! ```
//! use noisefloor_denoiser::MonteCarlo;
//!
//! for case in noisefloor_testkit::hard_cases() {
//!     noisefloor_testkit::check_method(&MonteCarlo, &case)?;
//! }
//! # Ok::<(), String>(())
//! ```

mod conformance;
mod tolerance;

pub use conformance::{Survival, check_method};
pub use noisefloor_synthetic as synthetic;
pub use noisefloor_synthetic::{HardCase, hard_case, hard_cases};
pub use tolerance::Tolerance;
