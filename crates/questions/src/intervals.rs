//! What do other intervals than Student's t cover, and what do they cost in width?

mod analyse;
mod exhibit;
mod measure;

pub(crate) use exhibit::coverage_of;
pub(crate) use measure::of_family;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    measure: measure::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    ..Question::new(measure::ID, include_str!("intervals/METHODOLOGY.md"))
};
