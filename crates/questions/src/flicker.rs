//! Does the error change from frame to frame?

mod analyse;
mod exhibit;
mod measure;
mod over_time;
mod readme;

pub use measure::{Images, Sequences, flicker};

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    analyse: analyse::analyse,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("flicker", include_str!("flicker/METHODOLOGY.md"))
};
