//! Rows whose frames have the variance of their law in place of the samples' own.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;

use noisefloor_frame::Frame;
use noisefloor_harness::{Laboratory, Passing, StudyRun, run};
use noisefloor_study::{RowFrames, Study};

use crate::common::{Place, Watch, study};

fn toml(scene: &str, row: &str) -> String {
    format!(
        r#"
        name = "known"
        spp = [4]
        replicates = 2
        timing = {{ warmup = 0, runs = 1 }}
        [[scene]]
        id = "here"
        {scene}
        [[method]]
        id = "mc"
        [[method]]
        id = "judge"
        {row}
        "#
    )
}

const SYNTHETIC: &str = r#"synthetic = { image = "edges", law = "gaussian", sd = 0.5, width = 24, height = 16, guides = "none" }"#;
const KNOWN: &str = "variance = \"known\"";

fn refused(text: &str) -> String {
    Study::from_toml(text, Path::new("test.toml")).unwrap_err().to_string()
}

#[test]
fn a_row_asks_for_the_variance_of_the_law_of_synthetic_scenes_alone() {
    let known = study(&toml(SYNTHETIC, KNOWN));
    let frames: Vec<&RowFrames> = known.methods.iter().map(|row| &row.frames).collect();
    assert_eq!(frames, [&RowFrames::Uniform, &RowFrames::KnownVariance]);

    let told = refused(&toml("scene = \"cornell\"", KNOWN));
    for part in ["method[1].variance", "here", "synthetic scenes"] {
        assert!(told.contains(part), "{told}");
    }
    let told = refused(&toml(SYNTHETIC, "variance = \"guessed\""));
    assert!(told.contains("`guessed`") && told.contains("`known`"), "{told}");
    let told = refused(&toml(SYNTHETIC, &format!("{KNOWN}\nadaptive = {{ rounds = 2 }}")));
    assert!(told.contains("several of `adaptive`, `equal_time` and `variance`"), "{told}");
}

/// Keeps all frames that it sees, the study's own and those of rows alike.
#[derive(Default)]
struct Seen(Mutex<BTreeMap<u32, Vec<Frame>>>);

impl Passing for Seen {
    fn frame(&self, _: &str, _: u32, replicate: u32, frame: &mut Frame) {
        self.0.lock().unwrap().entry(replicate).or_default().push(frame.clone());
    }
}

#[test]
fn its_frames_are_the_studys_own_but_for_a_variance_that_is_the_same_everywhere() {
    let place = Place::new();
    let seen = Seen::default();
    let laboratory = Laboratory { passing: Some(&seen), ..Laboratory::default() };
    // Nothing but the study itself: the check of the instrument is not checked once more.
    let study = Study { name: noisefloor_questions::SELF_CHECK.into(), ..study(&toml(SYNTHETIC, KNOWN)) };
    let summary =
        place.run_with(&study, &Watch::default(), |request| run(&StudyRun { laboratory, ..request }));
    let summary = summary.unwrap();
    let variance = |frame: &Frame| frame.color.variance.as_ref().unwrap().mean_variance().clone();
    let law = 0.5f32 * 0.5 / 4.0;
    let of_law = |frame: &&Frame| variance(frame).data().iter().all(|v| *v == law);
    for (replicate, frames) in seen.0.lock().unwrap().iter() {
        let known: Vec<&Frame> = frames.iter().filter(of_law).collect();
        let own: Vec<&Frame> = frames.iter().filter(|frame| !of_law(frame)).collect();
        assert!(!known.is_empty() && !own.is_empty(), "{replicate}");
        for frame in known {
            let mut as_own = frame.clone();
            as_own.color.variance.clone_from(&own[0].color.variance);
            assert_eq!(&as_own, own[0], "colour, halves and all else are the same bits");
        }
    }
    // The row's estimate is the variance that it was given.
    let estimate = summary.estimates.iter().find(|e| e.label == "judge" && e.class == "all").unwrap();
    assert_eq!((estimate.estimated.value, estimate.estimated.standard_error), (f64::from(law), Some(0.0)));
    // Frames that share all samples on purpose are no finding.
    assert_eq!(summary.findings, []);
}
