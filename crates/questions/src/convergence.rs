//! Does the error vanish with the samples?

mod analyse;
mod exhibit;
mod readme;

pub(crate) use exhibit::chart;

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::summary::Summary;

use crate::question::Question;
use crate::readme::Kind;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Convergence;

impl Question for Convergence {
    fn id(&self) -> &'static str {
        "convergence"
    }

    fn methodology(&self) -> &'static str {
        include_str!("convergence/METHODOLOGY.md")
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
