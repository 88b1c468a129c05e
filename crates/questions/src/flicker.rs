//! Does the error change from frame to frame?

mod analyse;
mod exhibit;
mod measure;
mod over_time;
mod readme;

pub use measure::{Images, Sequences, flicker};

use noisefloor_study::exhibit::Exhibit;
use noisefloor_study::summary::Summary;

use crate::question::Question;
use crate::readme::Kind;
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

    fn exhibits(&self, view: &View<'_>) -> Vec<Exhibit> {
        exhibit::exhibits(view)
    }

    fn readme(&self) -> &'static [Kind] {
        readme::KINDS
    }
}
