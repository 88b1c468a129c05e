//! Intervals and counts that are wrong.

use noisefloor_harness::Laboratory;
use noisefloor_questions::{Cell, MeasureError, QUESTIONS, Question};
use noisefloor_stats::{
    IntervalFamily, IntervalNeed, IntervalPlanes, Level, SampleCounts, SamplePlanes, ShapeError, family,
    students_t,
};
use noisefloor_study::check::CheckKind;
use noisefloor_study::record::Record;

use super::planted::{TINY, measured, named, silent};

/// What is wrong with an interval.
#[derive(Debug)]
enum Wrong {
    /// s in place of s/√n.
    OneSample,
    /// All of α lies beyond each end.
    OneSided,
}

impl IntervalFamily for Wrong {
    fn id(&self) -> &'static str {
        "wrong"
    }

    fn name(&self) -> &'static str {
        "wrong"
    }

    fn source(&self) -> &'static str {
        "none: made up for a test"
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        match self {
            Self::OneSample => {
                let right = students_t().intervals(planes, level)?;
                let SampleCounts::Uniform(n) = planes.observed.counts else { return Ok(None) };
                let root = f64::from(n).sqrt();
                let wider = |ends: Vec<f64>| -> Vec<f64> {
                    let mean = planes.observed.mean.iter().map(|v| f64::from(*v));
                    ends.into_iter().zip(mean).map(|(end, mean)| mean + root * (end - mean)).collect()
                };
                Ok(right.map(|planes| IntervalPlanes { low: wider(planes.low), high: wider(planes.high) }))
            }
            Self::OneSided => {
                let level = Level::two_sided(1.0 - 2.0 * level.alpha()).unwrap();
                students_t().intervals(planes, level)
            }
        }
    }
}

fn with(intervals: &dyn IntervalFamily) -> noisefloor_study::summary::Summary {
    measured(TINY, Laboratory { intervals, ..Laboratory::default() })
}

const SCENE: &str = "normal (instrument)";

#[test]
fn a_the_spread_of_one_sample_for_that_of_the_mean_covers_too_often() {
    let summary = with(&Wrong::OneSample);
    for spp in [4, 16] {
        let found = named(&summary, CheckKind::Normal, SCENE, spp, 20.0).record.found.unwrap();
        assert!(found.value > found.expected, "{found:?}");
    }
    // Frames, references and variances are right.
    silent(&summary, &[CheckKind::Halves, CheckKind::Brightness, CheckKind::ClosedForm]);
}

#[test]
fn b_the_quantile_of_one_side_for_that_of_two_covers_too_rarely() {
    let summary = with(&Wrong::OneSided);
    for spp in [4, 16] {
        let found = named(&summary, CheckKind::Normal, SCENE, spp, 20.0).record.found.unwrap();
        assert!(found.value < found.expected, "{found:?}");
    }
    silent(&summary, &[CheckKind::Halves, CheckKind::Brightness, CheckKind::ClosedForm]);
}

#[test]
fn b_prime_the_normal_quantile_for_that_of_students_t_covers_too_rarely() {
    let summary = with(family("normal").unwrap());
    for spp in [4, 16] {
        let found = named(&summary, CheckKind::Normal, SCENE, spp, 10.0).record.found.unwrap();
        assert!(found.value < found.expected, "{found:?}");
    }
    silent(&summary, &[CheckKind::Halves, CheckKind::Brightness, CheckKind::ClosedForm]);
}

/// Counts what all samples missed as covered.
fn missed_is_covered(cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    (right("coverage").measure)(cell, record)?;
    for count in &mut record.coverage {
        count.constant += std::mem::take(&mut count.missed);
    }
    Ok(())
}

fn right(id: &str) -> &'static Question {
    QUESTIONS.iter().find(|question| question.id == id).unwrap()
}

#[test]
fn h_pixels_without_spread_that_count_as_covered_are_named() {
    let mut questions = QUESTIONS.to_vec();
    let coverage = questions.iter_mut().find(|question| question.id == "coverage").unwrap();
    coverage.measure = missed_is_covered;
    let summary = measured(TINY, Laboratory { questions: &questions, ..Laboratory::default() });
    for spp in [4, 16] {
        named(&summary, CheckKind::Rare, "rare (instrument)", spp, 100.0);
    }
    silent(&summary, &[CheckKind::Normal, CheckKind::Halves, CheckKind::Brightness]);
}
