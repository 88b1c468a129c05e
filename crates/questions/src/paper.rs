//! How do our ratios stand beside those of the source work?

mod analyse;
mod exhibit;
mod readme;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("paper", include_str!("paper/METHODOLOGY.md"))
};
