//! Which row is closest to the truth, and by how much?

mod analyse;
mod exhibit;
mod measure;
mod ratio;

pub(crate) use analyse::monte_carlo;
pub use measure::{BOOTSTRAP_IMAGES, bootstrap_seed, measure_metrics};
pub(crate) use ratio::ratio_within_se;

use noisefloor_study::exhibit::{Answer, Exhibit};
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;

use crate::cell::{Cell, MeasureError};
use crate::question::Question;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Error;

impl Question for Error {
    fn id(&self) -> &'static str {
        "error"
    }

    fn methodology(&self) -> &'static str {
        include_str!("error/METHODOLOGY.md")
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

    fn exhibit(&self, view: &View<'_>) -> Option<Exhibit> {
        exhibit::exhibit(view)
    }
}
