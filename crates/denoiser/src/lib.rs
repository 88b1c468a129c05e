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
mod card;
mod caveat;
mod citation;
mod error;
mod exposure;
mod factory;
mod guarded;
mod input;
mod interval;
mod mc;
mod needs;
mod output;
pub mod param;
mod registry;
mod timer;

#[cfg(test)]
mod tests;

pub use adaptive::Adaptive;
pub use card::{Claim, Claims, Cost, Invariance, MethodCard, Need, Role};
pub use caveat::Caveat;
pub use citation::{Citation, Entry, Published};
pub use error::DenoiseError;
pub use exposure::Exposed;
pub use factory::{BuildError, Factory, check_overrides, method};
pub use guarded::Guarded;
pub use input::{Diagnostics, Input};
pub use interval::{half_widths, into_half_widths};
pub use mc::{MonteCarlo, NoParams, mc};
pub use needs::{Alternative, Setting};
pub use output::{Bound, Diagnostic, Figure, Output, StageSeconds, Unit};
pub use param::{Choices, Kind, Param, ParamError, Parameters};
pub use registry::{Method, Registry};
pub use timer::StageTimer;

/// A denoiser: see the crate documentation for a complete one.
pub trait Denoiser: Send + Sync {
    /// Identity, citation, inputs it needs and claims. Cheap; does not depend on any frame.
    fn card(&self) -> MethodCard;

    /// Denoises `input.target`.
    ///
    /// The same input gives the same bits for any number of threads. The target has been sanitised (no non-finite
    /// values) by whoever built the [`Input`], see [`Input::new`].
    ///
    /// # Errors
    /// [`DenoiseError::MissingInputs`] before any work if something in [`MethodCard::needs`] is absent, and whatever the
    /// method's own limits are.
    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError>;

    /// The part of the method that steers adaptive sampling, if it has one.
    fn adaptive(&self) -> Option<&dyn Adaptive> {
        None
    }
}
