//! What would the same time have bought?

mod analyse;
mod exhibit;
mod readme;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("equal-time", include_str!("equal_time/METHODOLOGY.md"))
};
