//! Does the instrument itself work: frames, references, intervals?

mod analyse;
mod exhibit;
mod id;
mod known;
mod level;

pub use analyse::{Check, checks, failed_checks};
pub use known::{SELF_CHECK, SELF_CHECK_SIZE, self_check_study, self_checks};

use id::ID;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    level: level::measure,
    analyse: analyse::analyse,
    answer: exhibit::answer,
    exhibits: exhibit::exhibits,
    ..Question::new(ID, include_str!("instrument/METHODOLOGY.md"))
};
