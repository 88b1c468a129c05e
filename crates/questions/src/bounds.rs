//! Do the statistical claims hold?

mod analyse;
mod exhibit;
mod measure;
mod readme;

pub(crate) use analyse::id_of;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    measure: measure::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("bounds", include_str!("bounds/METHODOLOGY.md"))
};
