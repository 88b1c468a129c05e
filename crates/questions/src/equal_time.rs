//! What would the same time have bought?

mod analyse;
mod exhibit;
mod readme;

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::summary::Summary;

use crate::question::Question;
use crate::readme::Kind;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct EqualTime;

impl Question for EqualTime {
    fn id(&self) -> &'static str {
        "equal-time"
    }

    fn methodology(&self) -> &'static str {
        include_str!("equal_time/METHODOLOGY.md")
    }

    fn analyse(&self, records: &Index<'_>, summary: &mut Summary) {
        analyse::analyse(records, summary);
    }

    fn exhibits(&self, view: &View<'_>) -> Vec<Exhibit> {
        exhibit::exhibits(view)
    }

    fn readme(&self) -> &'static [Kind] {
        readme::KINDS
    }
}
