//! What does it cost?

mod exhibit;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    answer: exhibit::answer,
    exhibits: exhibit::exhibits,
    ..Question::new("cost", include_str!("cost/METHODOLOGY.md"))
};
