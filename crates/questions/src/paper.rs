//! How do our ratios stand beside those of the source work?

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

    fn exhibits(&self, view: &View<'_>) -> Vec<Exhibit> {
        exhibit::exhibits(view)
    }

    fn readme(&self) -> &'static [Kind] {
        readme::KINDS
    }
}
