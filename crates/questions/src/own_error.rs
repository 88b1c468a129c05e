//! Do methods know their own error?

mod analyse;
mod exhibit;
mod measure;
mod readme;

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
pub(crate) struct OwnError;

impl Question for OwnError {
    fn id(&self) -> &'static str {
        "estimates"
    }

    fn methodology(&self) -> &'static str {
        include_str!("own_error/METHODOLOGY.md")
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
