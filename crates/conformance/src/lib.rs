//! What every denoiser must keep, as recipes that a method is run through: one's own as well as the built-in ones.
//!
//! A [`Recipe`] makes frames of one kind (hostile numbers, tiny images, no variance, another exposure), runs the method on
//! them, and says what came of it. What a method need not keep its card says: inputs that it needs
//! ([`MethodCard::needs`](noisefloor_denoiser::MethodCard)), what its results depend on (`varies_with`), and what it does not
//! promise (`caveats`). No recipe knows any method.
//!
//! In a method's own tests one line runs them all:
//!
//! ```
//! use noisefloor_denoiser::MonteCarlo;
//!
//! noisefloor_conformance::assert_conforms(&MonteCarlo);
//! ```
//!
//! The command does the same for every registered method (`noisefloor check ID`). [`check`] gives the verdicts as data:
//!
//! ```
//! use noisefloor_conformance::{Outcome, check};
//! use noisefloor_denoiser::MonteCarlo;
//!
//! let report = check(&MonteCarlo);
//! assert!(report.conforms(), "{report}");
//! assert!(matches!(report.of("sizes"), Some(Outcome::Kept { refused: 0, .. })));
//! ```

mod case;
pub mod change;
mod citations;
pub mod known;
mod outcome;
pub mod outputs;
mod recipe;
mod recipes;
mod report;
mod tolerance;
mod trial;
mod violation;

pub use citations::cited;
pub use outcome::Outcome;
pub use recipe::Recipe;
pub use recipes::recipes;
pub use report::{Report, assert_conforms, check};
pub use tolerance::Tolerance;
pub use violation::{Broken, Violation};
