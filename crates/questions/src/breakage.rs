//! Does anything break?

mod analyse;
mod builds;
mod exhibit;
mod progress;
mod readme;
mod warnings;

pub use warnings::violations;

use noisefloor_study::exhibit::Answer;
use noisefloor_study::summary::Summary;

use crate::question::Question;
use crate::readme::Kind;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Breakage;

impl Question for Breakage {
    fn id(&self) -> &'static str {
        "breakage"
    }

    fn methodology(&self) -> &'static str {
        include_str!("breakage/METHODOLOGY.md")
    }

    fn analyse(&self, records: &Index<'_>, summary: &mut Summary) {
        analyse::analyse(records, summary);
    }

    fn answer(&self, view: &View<'_>) -> Option<Answer> {
        exhibit::answer(view)
    }

    fn readme(&self) -> &'static [Kind] {
        readme::KINDS
    }
}
