//! What does it cost?

mod exhibit;

use noisefloor_study::exhibit::{Answer, Exhibit};

use crate::question::Question;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Cost;

impl Question for Cost {
    fn id(&self) -> &'static str {
        "cost"
    }

    fn methodology(&self) -> &'static str {
        include_str!("cost/METHODOLOGY.md")
    }

    fn answer(&self, view: &View<'_>) -> Option<Answer> {
        exhibit::answer(view)
    }

    fn exhibits(&self, view: &View<'_>) -> Vec<Exhibit> {
        exhibit::exhibits(view)
    }
}
