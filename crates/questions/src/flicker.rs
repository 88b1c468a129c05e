//! Does the error change from frame to frame?

mod analyse;
mod exhibit;
mod measure;
mod over_time;

pub use measure::{Images, Sequences, flicker};

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::summary::Summary;

use crate::question::Question;
use crate::records::Index;
use crate::view::View;

/// The question.
#[derive(Debug)]
pub(crate) struct Flicker;

impl Question for Flicker {
    fn id(&self) -> &'static str {
        "flicker"
    }

    fn methodology(&self) -> &'static str {
        include_str!("flicker/METHODOLOGY.md")
    }

    fn analyse(&self, records: &Index<'_>, summary: &mut Summary) {
        analyse::analyse(records, summary);
    }

    fn exhibit(&self, view: &View<'_>) -> Option<Exhibit> {
        exhibit::exhibit(view)
    }
}
