//! All questions.

use noisefloor_study::record::Record;

use crate::bounds::Bounds;
use crate::breakage::Breakage;
use crate::cell::{Cell, MeasureError};
use crate::comparison::Comparison;
use crate::convergence::Convergence;
use crate::cost::Cost;
use crate::coverage::Coverage;
use crate::equal_time::EqualTime;
use crate::error::Error;
use crate::flicker::Flicker;
use crate::growth::Growth;
use crate::own_error::OwnError;
use crate::paper::Paper;
use crate::question::Question;

/// All questions, in the order in which they are measured, analysed and shown.
pub const QUESTIONS: &[&dyn Question] = &[
    &Paper,
    &Error,
    &Comparison,
    &Convergence,
    &Cost,
    &Coverage,
    &Bounds,
    &OwnError,
    &Growth,
    &EqualTime,
    &Flicker,
    &Breakage,
];

/// Puts every question to a finished cell.
///
/// # Errors
/// Of the first question that cannot be measured.
pub fn measure(cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    QUESTIONS.iter().try_for_each(|question| question.measure(cell, record))
}
