//! Do the input's confidence intervals cover?

mod analyse;
mod exhibit;
mod measure;
mod readme;

pub(crate) use analyse::mark;

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;

use crate::cell::{Cell, MeasureError};
use crate::question::Question;
use crate::readme::Kind;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Coverage;

impl Question for Coverage {
    fn id(&self) -> &'static str {
        "coverage"
    }

    fn methodology(&self) -> &'static str {
        include_str!("coverage/METHODOLOGY.md")
    }

    fn measure(&self, cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
        measure::measure(cell, record)
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
