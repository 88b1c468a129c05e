//! Faults of an instrument, planted from outside: the report must name each of them, and none where there is none.

mod boxed;
mod estimates;
mod frames;
mod intervals;
mod planted;
mod references;

use noisefloor_denoiser::{Registry, mc};
use noisefloor_harness::{Laboratory, StudyRun, run};
use noisefloor_questions::{checks, failed_checks};
use noisefloor_stats::rate_standard_error;
use noisefloor_study::Study;
use noisefloor_study::check::CheckKind;
use noisefloor_study::exhibit::Tone;

use crate::common::{Place, Watch, study};
use boxed::{Sure, boxed};
use planted::{SMALL, TINY, first_screen, measured};

#[test]
fn without_a_fault_nothing_is_named() {
    let summary = measured(SMALL, Laboratory::default());
    assert_eq!(failed_checks(&summary), Vec::<String>::new());
    let screen = first_screen(&summary);
    assert!(screen.tone != Tone::Bad && screen.sentences[0].ends_with("found no fault."), "{screen:?}");
    let all = checks(&summary);
    for kind in CheckKind::ALL {
        let tested = all.iter().filter(|check| check.record.kind == kind && check.adjusted.is_some());
        assert!(tested.count() > 0, "{kind}");
    }
}

#[test]
fn sound_instruments_alarm_no_more_often_than_stated() {
    // 200 seeds with all methods are those of the example `clean_self_checks`.
    const SEEDS: u64 = 8;
    let registry = Registry::new([mc(), boxed(Sure::Whole)]);
    let tiny = study(TINY);
    let (mut alarms, mut tests, mut low) = (Vec::new(), 0, 0);
    for seed in 1..=SEEDS {
        let study = Study { seed, ..tiny.clone() };
        let place = Place::new();
        let run_it = |request: StudyRun<'_>| run(&StudyRun { registry: &registry, ..request });
        let summary = place.run_with(&study, &Watch::default(), run_it).unwrap();
        alarms.extend(failed_checks(&summary).into_iter().map(|text| (seed, text)));
        let p: Vec<f64> = checks(&summary).iter().filter_map(|check| Some(check.record.found?.p)).collect();
        tests += p.len() as u64;
        low += p.iter().filter(|p| **p <= 0.05).count();
    }
    // A report's checks are one family at 1 %.
    let limit = 0.05 + 4.0 * rate_standard_error(0.05, SEEDS);
    assert!(alarms.len() as f64 <= limit * SEEDS as f64, "{alarms:?}");
    // Alone they are below 5 % as often; those of one level at three confidences and their missed events share samples, so
    // that four are one trial.
    let limit = 0.05 + 4.0 * rate_standard_error(0.05, tests / 4);
    println!("{low} of {tests} checks below 5 %");
    assert!(low as f64 <= limit * tests as f64, "{low} of {tests}");
}
