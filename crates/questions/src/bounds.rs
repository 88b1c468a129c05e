//! Do the statistical claims hold?

mod analyse;
mod exhibit;
mod measure;
mod readme;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    measure: measure::measure,
    analyse: analyse::analyse,
    answer: exhibit::answer,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("bounds", include_str!("bounds/METHODOLOGY.md"))
};
