//! Do methods know their own error?

mod analyse;
mod exhibit;
mod measure;
mod readme;

pub(crate) use analyse::claim;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    measure: measure::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("estimates", include_str!("own_error/METHODOLOGY.md"))
};
