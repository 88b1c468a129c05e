//! Which claims hold, by one rule for all of them?

mod answer;
mod exhibit;

use crate::question::Question;

/// Anchor in the page.
const ID: &str = "statistics";

pub(crate) const QUESTION: Question = Question {
    answer: answer::answer,
    exhibits: exhibit::exhibits,
    ..Question::new(ID, include_str!("statistics/METHODOLOGY.md"))
};
