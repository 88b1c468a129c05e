//! What a question is.

use noisefloor_study::exhibit::{Answer, Exhibit};
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;

use crate::cell::{Cell, MeasureError};
use crate::level::{LevelCell, LevelFound};
use crate::readme::Kind;
use crate::records::Index;
use crate::view::View;

/// A question to the data: its folder as a row of [`QUESTIONS`](crate::QUESTIONS). What a folder leaves out does nothing.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Anchor in the page, and the name of its answers on disk.
    pub id: &'static str,
    /// Its paragraph of the methodology, Markdown.
    pub methodology: &'static str,
    /// Measures a finished cell, into its record.
    pub measure: fn(&Cell<'_>, &mut Record) -> Result<(), MeasureError>,
    /// Measures all replicates of a level together, once they are there.
    pub level: fn(&LevelCell<'_>, &mut LevelFound) -> Result<(), MeasureError>,
    /// Analyses all records, into the summary; what comes before it in [`QUESTIONS`](crate::QUESTIONS) is there already.
    pub analyse: fn(&Index<'_>, &mut Summary),
    /// The answer in a sentence or a few, for the first screen.
    pub answer: fn(&View<'_>) -> Option<Answer>,
    /// What a reader sees; nothing where the study has nothing to show. The first of every question come before the
    /// further ones.
    pub exhibits: fn(&View<'_>) -> Vec<Exhibit>,
    /// Tables that it has for a README.
    pub readme: &'static [Kind],
}

impl Question {
    /// A question that measures, analyses and shows nothing.
    pub(crate) const fn new(id: &'static str, methodology: &'static str) -> Self {
        Self {
            id,
            methodology,
            measure: |_, _| Ok(()),
            level: |_, _| Ok(()),
            analyse: |_, _| (),
            answer: |_| None,
            exhibits: |_| Vec::new(),
            readme: &[],
        }
    }
}
