//! The trait of every method.

use crate::{Adaptive, DenoiseError, Input, MethodCard, Output};

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
