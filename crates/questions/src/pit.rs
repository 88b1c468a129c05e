//! At which of their own quantiles have the input's intervals the truth?

mod analyse;
mod answer;
mod exhibit;
mod level;

use crate::question::Question;

/// Name of its answers on disk, and of its claims.
const ID: &str = "pit";

pub(crate) const QUESTION: Question = Question {
    level: level::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    ..Question::new(ID, include_str!("pit/METHODOLOGY.md"))
};
