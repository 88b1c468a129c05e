//! Does anything break?

mod analyse;
mod builds;
mod exhibit;
mod looked;
mod progress;
mod readme;
mod warnings;

pub use warnings::violations;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    analyse: analyse::analyse,
    answer: exhibit::answer,
    readme: readme::KINDS,
    ..Question::new("breakage", include_str!("breakage/METHODOLOGY.md"))
};
