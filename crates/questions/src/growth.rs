//! Which pixels did the filter make worse?

mod analyse;
mod exhibit;
mod measure;

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;

use crate::cell::{Cell, MeasureError};
use crate::question::Question;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Growth;

/// Name of its answers on disk.
const ID: &str = "growth";

impl Question for Growth {
    fn id(&self) -> &'static str {
        ID
    }

    fn methodology(&self) -> &'static str {
        include_str!("growth/METHODOLOGY.md")
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
}
