//! Faults of an instrument, planted from outside: the report must name each of them, and none where there is none.

mod estimates;
mod frames;
mod intervals;
mod planted;
mod references;

use noisefloor_denoiser::{Registry, mc};
use noisefloor_harness::{StudyRun, run};
use noisefloor_questions::{checks, failed_checks};
use noisefloor_stats::rate_standard_error;
use noisefloor_study::Study;
use noisefloor_study::check::CheckKind;
use noisefloor_study::exhibit::Tone;

use crate::common::{Place, Watch, study};
use estimates::{Sure, boxed};
use planted::{first_screen, measured};

#[test]
fn without_a_fault_nothing_is_named() {
    let summary = measured(Default::default());
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
    const SEEDS: u64 = 40;
    let registry = Registry::new([mc(), boxed(Sure::Whole)]);
    let tiny = study(TINY);
    let alarms: Vec<(u64, Vec<String>)> = (1..=SEEDS)
        .map(|seed| {
            let study = Study { seed, ..tiny.clone() };
            let place = Place::new();
            let run_it = |request: StudyRun<'_>| run(&StudyRun { registry: &registry, ..request });
            let summary = place.run_with(&study, &Watch::default(), run_it).unwrap();
            (seed, failed_checks(&summary))
        })
        .filter(|(_, failed)| !failed.is_empty())
        .collect();
    // The family is at 1 %; 200 seeds with all methods are those of the example `clean_self_checks`.
    let limit = 0.05 + 4.0 * rate_standard_error(0.05, SEEDS);
    assert!(alarms.len() as f64 <= limit * SEEDS as f64, "{alarms:?}");
}

/// Little beside the check of the instrument itself.
const TINY: &str = r#"
name = "tiny"
spp = [4, 16]
replicates = 4
timing = { warmup = 0, runs = 1 }
[[scene]]
id = "steps"
synthetic = { image = "edges", law = "gaussian", sd = 0.2, width = 24, height = 16, guides = "none" }
[[method]]
id = "mc"
"#;
