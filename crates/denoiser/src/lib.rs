//! The contract between denoisers and everything that runs them.
//!
//! A method is two functions: [`Denoiser::card`] says who it is, what it needs and what it claims;
//! [`Denoiser::denoise`] does the work. The trait is object-safe, takes `&self`, and keeps no state between calls,
//! so a harness can hold a list of boxed methods, refuse a method before any work, and run it on many frames.
//! What that shape costs: a method cannot learn from one frame for the next; neighbours of an animation come in
//! through [`Input`].
//!
//! A complete method:
//!
//! ```
//! use noisefloor_denoiser::{Citation, DenoiseError, Denoiser, Input, MethodCard, Output};
//!
//! /// Returns the input.
//! struct Identity;
//!
//! impl Denoiser for Identity {
//!     fn card(&self) -> MethodCard {
//!         MethodCard::new("identity", "Identity", Citation::new("none", "no source"))
//!     }
//!     fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
//!         Ok(Output::from_image(input.target.color.mean.clone()))
//!     }
//! }
//! ```
//!
//! To be found by name, a method also gives a [`Factory`], most easily by [`method()`] with a struct of [`parameters!`], and a
//! [`Registry`] is a list of factories.

mod adaptive;
mod alternative;
mod because;
mod built;
mod card;
mod caveat;
mod citation;
mod denoiser;
mod error;
mod exposure;
mod factory;
mod guarded;
mod input;
mod interval;
mod mc;
mod need;
mod output;
pub mod param;
mod projection;
mod registry;
mod timer;
mod ways_out;

#[cfg(test)]
mod tests;

pub use adaptive::Adaptive;
pub use alternative::{Alternative, Setting};
pub use built::Method;
pub use card::{Claim, Claims, Cost, Invariance, MethodCard, Role};
pub use caveat::Caveat;
pub use citation::{Citation, Entry, Published};
pub use denoiser::Denoiser;
pub use error::DenoiseError;
pub use exposure::Exposed;
pub use factory::{BuildError, Factory, check_overrides, method};
pub use guarded::Guarded;
pub use input::{Diagnostics, Input};
pub use interval::{half_widths, into_half_widths, sample_planes};
pub use mc::{MonteCarlo, NoParams, mc};
pub use need::Need;
pub use output::{Bound, Diagnostic, Figure, Output, StageSeconds, Unit};
pub use param::{Choices, Kind, Param, ParamError, Parameters};
pub use registry::Registry;
pub use timer::StageTimer;
