//! Commands that every Unix has, as denoisers: what goes well and each way to fail.
#![cfg(unix)]

use std::time::{Duration, Instant};

use noisefloor_command::{Command, Params, command};
use noisefloor_conformance::{assert_conforms, check};
use noisefloor_denoiser::{DenoiseError, Denoiser, Input, Need, Output};
use noisefloor_frame::{FeatureId, Frame};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};
use serde_json::{Map, json};

fn frame() -> Frame {
    let law = SampleLaw::Gaussian { sd: 0.3, relative: false };
    SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 8, 6).unwrap().render(4, 1)
}

fn guest(run: &str) -> Command {
    Command::new(Params { run: run.into(), ..Params::default() }).unwrap()
}

/// Runs a script of the shell on a frame.
fn shell(script: &str) -> Result<Output, DenoiseError> {
    guest(&format!("sh -c '{script}' sh {{color.pfm}} {{output.pfm}} {{seconds}}"))
        .denoise(&Input::new(&frame()))
}

#[test]
fn a_copy_gives_back_every_bit_in_both_formats() {
    for run in ["cp {color.pfm} {output.pfm}", "cp {color.exr} {output}", "cp {input} {output}"] {
        let output = guest(run).denoise(&Input::new(&frame())).unwrap();
        assert_eq!(output.image, frame().color.mean, "{run}");
        assert_eq!(output.seconds, None);
        assert_eq!(output.stages.len(), 3);
    }
}

#[test]
fn a_copy_conforms_and_a_program_that_fails_does_not() {
    assert_conforms(&guest("cp {color.pfm} {output.pfm}"));
    let report = check(&guest("false {color.pfm} {output.pfm}"));
    assert!(
        report.to_string().contains("refuses a frame that has all it needs: false ended with code 1"),
        "{report}"
    );
}

#[test]
fn it_needs_what_its_command_line_names() {
    let params = Params {
        run: "filter {input} {albedo.pfm} {normal.variance.exr} {variance.pfm} {odd.pfm} {output}".into(),
        needs: vec!["halfA".into(), "albedo".into()],
        ..Params::default()
    };
    let card = Command::new(params).unwrap().card();
    let needs = [
        Need::Feature(FeatureId::Albedo),
        Need::FeatureVariance(FeatureId::Normal),
        Need::ColorVariance,
        Need::Feature(FeatureId::Extra("odd".into())),
        Need::ColorHalves,
    ];
    assert_eq!(card.needs, needs);
    assert_eq!((card.name.as_str(), card.named_features), ("filter", vec!["odd".to_owned()]));
    let error = guest("filter {caustics.pfm} {output}").denoise(&Input::new(&frame())).unwrap_err();
    assert!(matches!(error, DenoiseError::MissingInputs { .. }), "{error}");
}

#[test]
fn its_own_seconds_count_and_what_it_says_is_kept() {
    let output = shell("cp $1 $2; echo 0.25 > $3; echo hello; echo world >&2").unwrap();
    assert_eq!((output.seconds, output.log.as_str()), (Some(0.25), "hello\nworld\n"));
    let told = Params {
        run: "sh -c 'cp $1 $2; echo took msec=12.5 in all' sh {color.pfm} {output.pfm}".into(),
        seconds_after: "msec=".into(),
        seconds_unit: 1e-3,
        ..Params::default()
    };
    let output = Command::new(told).unwrap().denoise(&Input::new(&frame())).unwrap();
    assert_eq!(output.seconds, Some(0.0125));
    assert_eq!(shell("cp $1 $2; echo soon > $3").unwrap().seconds, None);
}

#[test]
fn crashes_and_lies_are_told_with_what_it_said() {
    for (script, part) in [
        ("echo before; echo cannot see >&2; exit 3", "ended with code 3; it said: cannot see"),
        ("kill -9 $$", "was ended by signal 9"),
        ("true", "wrote no output"),
        ("echo nonsense > $2", "cannot be read"),
        ("head -c 40 $1 > $2", "cannot be read"),
    ] {
        let error = shell(script).unwrap_err();
        assert!(matches!(error, DenoiseError::Program { .. }), "{error}");
        assert!(error.to_string().contains(part), "{script}: {error}");
    }
    let nan = r#"(printf "PF\n8 6\n-1\n"; head -c 576 /dev/zero | tr "\0" "\377") > $2"#;
    let error = shell(nan).unwrap_err();
    assert!(matches!(error, DenoiseError::Undefined { pixels: 48, .. }), "{error}");
    let small = r#"(printf "PF\n1 1\n-1\n"; head -c 12 /dev/zero) > $2"#;
    assert!(matches!(shell(small).unwrap_err(), DenoiseError::Frame(_)));
    let absent = guest("no-such-program-anywhere {output}").denoise(&Input::new(&frame())).unwrap_err();
    assert!(absent.to_string().contains("cannot be started"), "{absent}");
}

#[test]
fn what_hangs_is_stopped_with_all_that_it_started() {
    let marker = tempfile::tempdir().unwrap();
    let late = marker.path().join("late");
    let run = format!("sh -c '(sleep 3; echo > {}) & sleep 60' sh {{output}}", late.display());
    let hangs = Command::new(Params { run, limit_s: 0.3, ..Params::default() }).unwrap();
    let start = Instant::now();
    let error = hangs.denoise(&Input::new(&frame())).unwrap_err();
    assert!(error.to_string().contains("took more than 0.3 s and was stopped"), "{error}");
    assert!(start.elapsed() < Duration::from_secs(30));
    std::thread::sleep(Duration::from_secs(4));
    assert!(!late.exists(), "its child went on");
}

#[test]
fn its_version_is_that_of_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("mine.sh");
    let set = json!({ "run": format!("sh {} {{color.pfm}} {{output.pfm}}", script.display()) });
    let set: Map<_, _> = set.as_object().unwrap().clone();
    let version = || command().version(&set).unwrap();
    let absent = version();
    std::fs::write(&script, "cp $1 $2").unwrap();
    let first = version();
    std::fs::write(&script, "cp $1 $2 # again").unwrap();
    assert!(absent != first && first != version());
    std::fs::write(&script, "cp $1 $2").unwrap();
    assert_eq!(version(), first);
    assert!(!command().ready() && command().build(&Map::new()).is_err());
    assert!(command().build(&set).is_ok());
}

#[test]
fn the_example_in_python_runs_where_python_has_numpy() {
    let python = std::process::Command::new("python3").args(["-c", "import numpy"]).output();
    if !python.is_ok_and(|ran| ran.status.success()) {
        eprintln!("skipped: python3 with numpy is not here");
        return;
    }
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/box3.py");
    let run = format!("python3 '{script}' {{color.pfm}} {{output.pfm}} {{seconds}}");
    let noisy = frame();
    let output = guest(&run).denoise(&Input::new(&noisy)).unwrap();
    let mean = &noisy.color.mean;
    let expected: f32 = (0..9).map(|k| mean.get(1, 3 + k % 3, 2 + k / 3)).sum::<f32>() / 9.0;
    assert!((output.image.get(1, 4, 3) - expected).abs() < 1e-5 * expected.abs().max(1.0));
    assert!(output.seconds.is_some_and(|seconds| seconds > 0.0));
}
