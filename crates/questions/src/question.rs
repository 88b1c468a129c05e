//! What a question is.

use noisefloor_study::exhibit::{Answer, Exhibit};
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;

use crate::cell::{Cell, MeasureError};
use crate::readme::Kind;
use crate::records::Index;
use crate::view::View;

/// A question to the data. All parts but the id and the paragraph may be absent.
pub trait Question: Sync {
    /// Anchor in the page, and the name of its answers on disk.
    fn id(&self) -> &'static str;

    /// Its paragraph of the methodology, Markdown.
    fn methodology(&self) -> &'static str;

    /// Measures a finished cell, into its record.
    ///
    /// # Errors
    /// If image, frame and truth do not fit together.
    fn measure(&self, cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
        let _ = (cell, record);
        Ok(())
    }

    /// Analyses all records, into the summary; what comes before it in [`QUESTIONS`](crate::QUESTIONS) is there already.
    fn analyse(&self, records: &Index<'_>, summary: &mut Summary) {
        let _ = (records, summary);
    }

    /// The answer in a sentence or a few, for the first screen.
    fn answer(&self, view: &View<'_>) -> Option<Answer> {
        let _ = view;
        None
    }

    /// What a reader sees; nothing where the study has nothing to show. The first of every question come before the
    /// further ones.
    fn exhibits(&self, view: &View<'_>) -> Vec<Exhibit> {
        let _ = view;
        Vec::new()
    }

    /// Tables that it has for a README.
    fn readme(&self) -> &'static [Kind] {
        &[]
    }
}
