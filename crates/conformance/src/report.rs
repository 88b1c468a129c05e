use std::fmt;

use noisefloor_denoiser::Denoiser;

use crate::trial::attempt;
use crate::{Outcome, Recipe, Violation, recipes};

/// What came of a method and all recipes.
#[derive(Debug)]
pub struct Report {
    /// Method id.
    pub method: String,
    /// All recipes in order.
    pub outcomes: Vec<(&'static Recipe, Outcome)>,
}

/// Runs a method through all recipes.
#[must_use]
pub fn check(denoiser: &dyn Denoiser) -> Report {
    let method = attempt("", || denoiser.card().id).unwrap_or_else(|_| "a method without a card".into());
    let outcomes = recipes().iter().map(|recipe| (recipe, recipe.check(denoiser))).collect();
    Report { method, outcomes }
}

/// [`check`] as one line of a test.
///
/// # Panics
/// If the method breaks a recipe, with a sentence for each.
#[track_caller]
pub fn assert_conforms(denoiser: &dyn Denoiser) {
    let report = check(denoiser);
    assert!(report.conforms(), "{report}");
}

impl Report {
    /// Whether no recipe is broken.
    #[must_use]
    pub fn conforms(&self) -> bool {
        self.broken().next().is_none()
    }

    /// The broken ones.
    pub fn broken(&self) -> impl Iterator<Item = (&'static Recipe, &Violation)> {
        self.outcomes.iter().filter_map(|(recipe, outcome)| Some((*recipe, outcome.violation()?)))
    }

    /// What came of the recipe of this id.
    #[must_use]
    pub fn of(&self, recipe: &str) -> Option<&Outcome> {
        self.outcomes.iter().find(|(known, _)| known.id == recipe).map(|(_, outcome)| outcome)
    }
}

/// One sentence for each broken recipe.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.conforms() {
            return write!(f, "{} keeps all {} recipes", self.method, self.outcomes.len());
        }
        let mut between = "";
        for (recipe, violation) in self.broken() {
            write!(f, "{between}{}, recipe `{}`: {violation}", self.method, recipe.id)?;
            between = "\n";
        }
        Ok(())
    }
}
