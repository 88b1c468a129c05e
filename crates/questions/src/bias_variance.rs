//! How much of a row's error is bias, how much variance?

mod analyse;
mod answer;
mod exhibit;
mod level;
mod maps;

use crate::question::Question;

/// Name of its answers on disk.
const ID: &str = "bias_variance";

pub(crate) const QUESTION: Question = Question {
    level: level::measure,
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    ..Question::new(ID, include_str!("bias_variance/METHODOLOGY.md"))
};
