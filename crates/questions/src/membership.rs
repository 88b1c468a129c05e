//! How often does the test by which pixels are averaged tell equal ones apart, and unequal ones not?

mod analyse;
mod exhibit;
mod level;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    level: level::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    ..Question::new(level::ID, include_str!("membership/METHODOLOGY.md"))
};
