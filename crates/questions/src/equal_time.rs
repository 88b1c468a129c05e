//! What would the same time have bought?

mod analyse;
mod exhibit;

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::summary::Summary;

use crate::question::Question;
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

    fn exhibit(&self, view: &View<'_>) -> Option<Exhibit> {
        exhibit::exhibit(view)
    }
}
