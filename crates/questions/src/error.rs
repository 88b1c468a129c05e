//! Which row is closest to the truth, and by how much?

mod analyse;
mod exhibit;
mod measure;
mod ratio;
mod readme;

pub(crate) use analyse::monte_carlo;
pub(crate) use exhibit::{board, cards};
pub use measure::{BOOTSTRAP_IMAGES, bootstrap_seed, measure_metrics};
pub(crate) use ratio::ratio_within_se;

use crate::question::Question;

pub(crate) const QUESTION: Question = Question {
    measure: measure::measure,
    analyse: analyse::analyse,
    answer: exhibit::answer,
    exhibits: exhibit::exhibits,
    readme: readme::KINDS,
    ..Question::new("error", include_str!("error/METHODOLOGY.md"))
};
