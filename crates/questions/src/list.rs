//! All questions.

use noisefloor_study::record::Record;

use crate::cell::{Cell, MeasureError};
use crate::level::{LevelCell, LevelFound};
use crate::question::Question;
use crate::{
    bias_variance, bounds, breakage, comparison, convergence, cost, coverage, equal_time, error, flicker,
    growth, instrument, intervals, membership, own_error, paper, pit, reference_free, statistics,
};

/// All questions, in the order in which they are measured, analysed and shown.
pub const QUESTIONS: &[Question] = &[
    paper::QUESTION,
    error::QUESTION,
    comparison::QUESTION,
    convergence::QUESTION,
    bias_variance::QUESTION,
    cost::QUESTION,
    statistics::QUESTION,
    coverage::QUESTION,
    reference_free::QUESTION,
    pit::QUESTION,
    intervals::QUESTION,
    bounds::QUESTION,
    membership::QUESTION,
    own_error::QUESTION,
    growth::QUESTION,
    equal_time::QUESTION,
    flicker::QUESTION,
    breakage::QUESTION,
    instrument::QUESTION,
];

/// Puts questions to a finished cell.
///
/// # Errors
/// Of the first question that cannot be measured.
pub fn measure(questions: &[Question], cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    questions.iter().try_for_each(|question| (question.measure)(cell, record))
}

/// Puts questions to a level.
///
/// # Errors
/// Of the first question that cannot be measured.
pub fn measure_level(questions: &[Question], level: &LevelCell<'_>) -> Result<LevelFound, MeasureError> {
    let mut found = LevelFound::default();
    questions.iter().try_for_each(|question| (question.level)(level, &mut found))?;
    Ok(found)
}
