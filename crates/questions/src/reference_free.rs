//! Do the input's confidence intervals cover where no reference is asked?

mod analyse;
mod exhibit;
mod level;

use crate::question::Question;

/// Name of its answers on disk, and of its claims.
const ID: &str = "reference_free";

pub(crate) const QUESTION: Question = Question {
    level: level::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    ..Question::new(ID, include_str!("reference_free/METHODOLOGY.md"))
};
