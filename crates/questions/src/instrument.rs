//! Does the instrument itself work: frames, references, intervals?

mod analyse;
mod exhibit;
mod known;
mod level;

pub use analyse::{Check, checks, failed_checks};
pub use known::{SELF_CHECK, SELF_CHECK_SIZE, self_check_study, self_checks};

use crate::question::Question;

/// Name of its answers on disk.
const ID: &str = "instrument";

pub(crate) const QUESTION: Question = Question {
    level: level::measure,
    analyse: analyse::analyse,
    answer: exhibit::answer,
    exhibits: exhibit::exhibits,
    ..Question::new(ID, include_str!("instrument/METHODOLOGY.md"))
};
