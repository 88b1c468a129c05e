//! Do the statistical claims hold?

mod analyse;
mod exhibit;
mod measure;
mod readme;

use noisefloor_study::exhibit::{Answer, Exhibit};
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;

use crate::cell::{Cell, MeasureError};
use crate::question::Question;
use crate::readme::Kind;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Bounds;

impl Question for Bounds {
    fn id(&self) -> &'static str {
        "bounds"
    }

    fn methodology(&self) -> &'static str {
        include_str!("bounds/METHODOLOGY.md")
    }

    fn measure(&self, cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
        measure::measure(cell, record)
    }

    fn analyse(&self, records: &Index<'_>, summary: &mut Summary) {
        analyse::analyse(records, summary);
    }

    fn answer(&self, view: &View<'_>) -> Option<Answer> {
        exhibit::answer(view)
    }

    fn exhibits(&self, view: &View<'_>) -> Vec<Exhibit> {
        exhibit::exhibits(view)
    }

    fn readme(&self) -> &'static [Kind] {
        readme::KINDS
    }
}
