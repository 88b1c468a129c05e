//! Which rows can the replicates tell apart?

mod analyse;
mod exhibit;

pub(crate) use exhibit::pairs;

use noisefloor_study::summary::Summary;

use crate::question::Question;
use crate::records::Index;

/// The question.
#[derive(Debug)]
pub(crate) struct Comparison;

impl Question for Comparison {
    fn id(&self) -> &'static str {
        "comparison"
    }

    fn methodology(&self) -> &'static str {
        include_str!("comparison/METHODOLOGY.md")
    }

    fn analyse(&self, records: &Index<'_>, summary: &mut Summary) {
        analyse::analyse(records, summary);
    }
}
