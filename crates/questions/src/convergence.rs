//! Does the error vanish with the samples?

mod analyse;
mod exhibit;

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::summary::Summary;

use crate::question::Question;
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

    fn exhibit(&self, view: &View<'_>) -> Option<Exhibit> {
        exhibit::exhibit(view)
    }
}
