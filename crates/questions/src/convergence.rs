//! Does the error vanish with the samples?

mod analyse;
mod exhibit;
mod readme;

pub(crate) use exhibit::chart;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("convergence", include_str!("convergence/METHODOLOGY.md"))
};
