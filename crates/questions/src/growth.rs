//! Which pixels did the filter make worse?

mod analyse;
mod exhibit;
mod measure;

use crate::question::Question;

/// Name of its answers on disk.
const ID: &str = "growth";

pub(crate) const QUESTION: Question = Question {
    measure: measure::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    ..Question::new(ID, include_str!("growth/METHODOLOGY.md"))
};
