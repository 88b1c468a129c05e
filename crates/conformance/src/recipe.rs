use std::fmt;

use noisefloor_denoiser::Denoiser;

use crate::trial::{Trial, attempt};
use crate::{Outcome, Violation};

/// One thing that every method must keep, with the frames that show whether it does.
pub struct Recipe {
    /// Stable id, one or two words.
    pub id: &'static str,
    /// What it asks of a method: the predicate of a sentence.
    pub asks: &'static str,
    /// Runs the method on the frames.
    pub(crate) run: Run,
}

pub(crate) type Run = fn(&mut Trial<'_>) -> Result<Outcome, Violation>;

impl Recipe {
    /// Runs a method through the recipe. A panic of the method is a verdict like any other.
    #[must_use]
    pub fn check(&self, denoiser: &dyn Denoiser) -> Outcome {
        let card = attempt("its card", || denoiser.card());
        let outcome = card.and_then(|card| (self.run)(&mut Trial::new(denoiser, card)));
        outcome.unwrap_or_else(Outcome::Broken)
    }
}

impl fmt::Debug for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Recipe").field("id", &self.id).field("asks", &self.asks).finish_non_exhaustive()
    }
}
