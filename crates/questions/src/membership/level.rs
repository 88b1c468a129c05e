//! Rejections between the same pixel of two replicates: one mean, whatever the light.

use noisefloor_stats::{Level, MembershipTest, RejectionTally, rejections};
use serde::{Deserialize, Serialize};

use crate::answers;
use crate::cell::{Measure, MeasureError};
use crate::level::{LevelCell, LevelFound};

/// Name of its answers on disk.
pub(super) const ID: &str = "membership";

/// Differences that are looked for, in estimated standard errors of the centre; 0 is none.
const SHIFTS: [f64; 4] = [0.0, 2.0, 4.0, 8.0];

/// Counts of one test at one level and shift, over pairs of replicates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Pairs {
    /// Name of the test.
    pub(super) test: String,
    /// Confidence of its intervals.
    pub(super) confidence: f64,
    /// Shift of the other mean.
    pub(super) shift: f64,
    /// Pixel class or `all`.
    pub(super) class: String,
    /// One per pair of replicates; no replicate is in two.
    pub(super) counts: Vec<RejectionTally>,
}

/// A name for the page.
pub(super) fn name(test: MembershipTest) -> &'static str {
    match test {
        MembershipTest::InInterval => "mean in the interval (moon2013flash)",
        MembershipTest::Overlap => "intervals overlap",
        MembershipTest::Welch => "Welch's t-test",
    }
}

pub(super) fn measure(level: &LevelCell<'_>, found: &mut LevelFound) -> Result<(), MeasureError> {
    if !level.study.membership {
        return Ok(());
    }
    let measures: Vec<Measure<'_>> = level.measures().collect();
    let Some(first) = measures.first() else { return Ok(()) };
    let names: Vec<&str> = first.names().collect();
    let mut out: Vec<Pairs> = Vec::new();
    for pair in measures.chunks_exact(2) {
        let (Some(centre), Some(other)) = (pair[0].intervals(), pair[1].intervals()) else { continue };
        for test in MembershipTest::ALL {
            for confidence in &level.study.coverage {
                let Ok(at) = Level::two_sided(*confidence) else { continue };
                for shift in SHIFTS {
                    let tallies = rejections(&centre, &other, test, shift, at, Some(first.groups()))?;
                    for (class, tally) in names.iter().zip(tallies).filter(|(_, tally)| tally.total > 0) {
                        add(&mut out, (name(test), *confidence, shift, class), tally);
                    }
                }
            }
        }
    }
    if !out.is_empty() {
        answers::keep(&mut found.answers, ID, &out);
    }
    Ok(())
}

fn add(
    out: &mut Vec<Pairs>,
    (test, confidence, shift, class): (&str, f64, f64, &str),
    tally: RejectionTally,
) {
    let same =
        |p: &&mut Pairs| p.test == test && p.confidence == confidence && p.shift == shift && p.class == class;
    match out.iter_mut().find(same) {
        Some(pairs) => pairs.counts.push(tally),
        None => {
            let (test, class) = (test.into(), class.into());
            out.push(Pairs { test, confidence, shift, class, counts: vec![tally] });
        }
    }
}
