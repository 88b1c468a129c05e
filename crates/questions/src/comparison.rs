//! Which rows can the replicates tell apart?

mod analyse;
mod exhibit;

pub(crate) use exhibit::pairs;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    analyse: analyse::analyse,
    ..Question::new("comparison", include_str!("comparison/METHODOLOGY.md"))
};
