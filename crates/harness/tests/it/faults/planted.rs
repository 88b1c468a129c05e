//! A small study measured with a faulty laboratory, and what its report says.

use noisefloor_denoiser::{Registry, mc};
use noisefloor_harness::{Laboratory, StudyRun, run};
use noisefloor_questions::{Check, checks, document, failed_checks};
use noisefloor_study::check::CheckKind;
use noisefloor_study::exhibit::{Answer, Tone};
use noisefloor_study::summary::Summary;

use super::boxed::{Sure, boxed};
use crate::common::{Place, Watch, study};

/// A rendered scene and one of a known law, at the replicates that studies have by default.
pub const SMALL: &str = r#"
name = "planted"
spp = [4, 16]
replicates = 4
width = 48
height = 36
depth = 2
timing = { warmup = 0, runs = 1 }
reference = { spp = 128 }
[[scene]]
id = "direct"
[[scene]]
id = "steps"
synthetic = { image = "edges", law = "gaussian", sd = 0.2, width = 48, height = 36, guides = "none" }
[[method]]
id = "mc"
[[method]]
id = "boxed"
"#;

/// Little beside the check of the instrument itself.
pub const TINY: &str = r#"
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

/// A study measured with a laboratory, by methods without a fault.
pub fn measured(toml: &str, laboratory: Laboratory<'_>) -> Summary {
    measured_with(toml, laboratory, &Registry::new([mc(), boxed(Sure::Whole)]))
}

pub fn measured_with(toml: &str, laboratory: Laboratory<'_>, registry: &Registry) -> Summary {
    let place = Place::new();
    let run_it = |request: StudyRun<'_>| run(&StudyRun { laboratory, registry, ..request });
    place.run_with(&study(toml), &Watch::default(), run_it).unwrap()
}

/// What the first screen says of the instrument.
pub fn first_screen(summary: &Summary) -> Answer {
    let answers = document(summary).front.answers;
    answers.into_iter().find(|answer| answer.question == "Does the instrument work?").unwrap()
}

/// The check of this kind that found the most on a scene at a level: it must have failed by at least so many standard errors,
/// the command must end with a fault, and the first screen must name the kind with scene, level and size.
pub fn named(summary: &Summary, kind: CheckKind, scene: &str, spp: u32, least: f64) -> Check {
    let all = checks(summary);
    let here = |check: &&Check| {
        let record = &check.record;
        record.kind == kind && record.scene == scene && record.spp == Some(spp) && check.adjusted.is_some()
    };
    let size = |check: &Check| check.record.found.map_or(0.0, |found| found.z.abs());
    let worst = all.iter().filter(here).max_by(|a, b| size(a).total_cmp(&size(b))).cloned();
    let worst = worst.unwrap_or_else(|| panic!("no {kind} on {scene} at {spp} spp"));
    println!("{kind} on {scene} at {spp} spp, {}: {:?}", worst.record.what, worst.record.found);
    assert!(worst.failed, "{worst:?}\n{:?}", failed_checks(summary));
    assert!(size(&worst) >= least, "{worst:?}");

    let told = failed_checks(summary);
    assert!(told.iter().any(|text| text.starts_with(&kind.to_string()) && text.contains(scene)), "{told:?}");
    let screen = first_screen(summary);
    assert_eq!(screen.tone, Tone::Bad);
    let on_screen = screen.sentences.iter().find(|text| text.starts_with(&kind.to_string()));
    let on_screen = on_screen.unwrap_or_else(|| panic!("{kind} is not on the first screen: {screen:?}"));
    for part in [" on ", " spp, ", " standard errors"] {
        assert!(on_screen.contains(part), "{on_screen}");
    }
    worst
}

/// That no check of these kinds failed.
pub fn silent(summary: &Summary, kinds: &[CheckKind]) {
    let failed = checks(summary).into_iter().filter(|c| c.failed && kinds.contains(&c.record.kind));
    assert_eq!(failed.collect::<Vec<_>>(), []);
}
