//! How do our ratios stand beside those of the source work?

mod analyse;
mod exhibit;

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::summary::Summary;

use crate::question::Question;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Paper;

impl Question for Paper {
    fn id(&self) -> &'static str {
        "paper"
    }

    fn methodology(&self) -> &'static str {
        include_str!("paper/METHODOLOGY.md")
    }

    fn analyse(&self, records: &Index<'_>, summary: &mut Summary) {
        analyse::analyse(records, summary);
    }

    fn exhibit(&self, view: &View<'_>) -> Option<Exhibit> {
        exhibit::exhibit(view)
    }
}
