//! The recipes, one file each.

mod bounds;
mod card;
mod counts;
mod density;
mod diagnostics;
mod enclosure;
mod exposure;
mod extremes;
mod features;
mod fireflies;
mod follows;
mod level;
mod missing;
mod neighbors;
mod numbers;
mod order;
mod raw;
mod repeats;
mod runs;
mod scales;
mod sizes;
mod threads;
mod units;
mod variance;

use crate::Recipe;
use crate::recipe::Run;

const fn recipe(id: &'static str, asks: &'static str, run: Run) -> Recipe {
    Recipe { id, asks, run }
}

static RECIPES: [Recipe; 23] = [
    recipe("card", "has one card, whose exceptions have reasons", card::run),
    recipe("runs", "denoises a frame that has everything", runs::run),
    recipe("missing", "refuses a frame that lacks a need, before anything else, and names it", missing::run),
    recipe("numbers", "bears what is left of values that are no numbers or negative", numbers::run),
    recipe("raw", "does not panic on values that nobody mended", raw::run),
    recipe("sizes", "takes images of any size, down to one pixel", sizes::run),
    recipe("counts", "takes any number of samples that it does not refuse, equal or not", counts::run),
    recipe("variance", "bears variances of zero, and all but zero", variance::run),
    recipe("fireflies", "bears values a million above all others", fireflies::run),
    recipe("level", "keeps an even image where it is, far from zero", level::run),
    recipe("scales", "takes radiances from 1e-8 to 1e8", scales::run),
    recipe("extremes", "gives no infinity for values near the end of the number range", extremes::run),
    recipe("features", "bears features and a flash that are constant, collinear, or absent", features::run),
    recipe("diagnostics", "gives the same image with diagnostics as without", diagnostics::run),
    recipe("repeats", "gives the same bits when it is asked again", repeats::run),
    recipe("threads", "gives the same bits on one thread and on four", threads::run),
    recipe("neighbors", "takes as many neighbouring frames as it says, and fewer", neighbors::run),
    recipe("density", "steers samples by finite numbers that are not negative", density::run),
    recipe("enclosure", "stays inside every enclosure that it claims", enclosure::run),
    recipe("bounds", "exceeds a bound that it says is proven no more often than that says", bounds::run),
    recipe("exposure", "follows the exposure of a frame", exposure::run),
    recipe("channels", "does not depend on which channel is called red", order::run),
    recipe("units", "does not depend on the unit of length", units::run),
];

/// All recipes, in the order in which a method is best mended.
#[must_use]
pub fn recipes() -> &'static [Recipe] {
    &RECIPES
}

#[cfg(test)]
mod tests {
    use noisefloor_synthetic::hard_cases;

    use super::*;

    #[test]
    fn every_hard_case_of_synthetic_scenes_is_in_a_recipe() {
        let mut taken: Vec<&str> = [
            &numbers::KNOWN[..],
            &sizes::KNOWN,
            &counts::KNOWN,
            &variance::KNOWN,
            &fireflies::KNOWN,
            &level::KNOWN,
            &scales::KNOWN,
            &features::KNOWN,
        ]
        .concat();
        taken.sort_unstable();
        let mut all: Vec<&str> = hard_cases().iter().map(|case| case.name).collect();
        all.sort_unstable();
        assert_eq!(taken, all);
        assert!(density::KNOWN.iter().all(|name| all.contains(name)));
    }

    #[test]
    fn ids_are_unique_and_questions_are_predicates() {
        let ids: std::collections::BTreeSet<&str> = recipes().iter().map(|recipe| recipe.id).collect();
        assert_eq!(ids.len(), recipes().len());
        assert!(recipes().iter().all(|recipe| !recipe.asks.ends_with('.') && recipe.asks.contains(' ')));
    }
}
