//! Do the input's confidence intervals cover?

mod analyse;
mod claims;
mod exhibit;
mod measure;
mod readme;

pub(crate) use analyse::mark;
pub(crate) use claims::{Part, bracketed};
pub(crate) use measure::counted;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    measure: measure::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("coverage", include_str!("coverage/METHODOLOGY.md"))
};
