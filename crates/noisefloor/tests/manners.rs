//! The command's manners: pipes, full disks, exit codes, what is told and what is not.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use serde_json::Value;

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_noisefloor"));
    command.args(args).current_dir(folder);
    command
}

fn noisefloor(folder: &Path, args: &[&str]) -> Output {
    command(folder, args).output().unwrap()
}

fn done(folder: &Path, args: &[&str]) -> String {
    let output = noisefloor(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn refused(folder: &Path, args: &[&str], code: i32) -> String {
    let output = noisefloor(folder, args);
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{args:?}: {told}");
    assert!(output.stdout.is_empty(), "{args:?} printed a result");
    told
}

const STUDY: &str = "name = \"tiny\"\nspp = [4]\nwidth = 8\nheight = 6\ntiming = { warmup = 0, runs = 1 }\n\
    [[scene]]\nid = \"ramp\"\nsynthetic = { image = \"ramps\", law = \"gaussian\", width = 8, height = 6 }\n\
    [[method]]\nid = \"mc\"\n";

#[test]
fn a_reader_that_has_seen_enough_ends_nothing_badly() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    done(at, &["render", "cornell", "--spp", "2", "--size", "8x8", "-o", "f.exr"]);
    done(at, &["render", "cornell", "--spp", "1", "--seed", "7", "--size", "8x8", "-o", "h.exr"]);
    for args in [
        &["scenes"][..],
        &["scenes", "--json"],
        &["methods"],
        &["methods", "rdfc"],
        &["check", "mc"],
        &["--help"],
        &["denoise", "f.exr", "-m", "mc", "-o", "o.exr"],
        &["denoise", "f.exr", "-m", "mc", "-o", "-"],
        &["compare", "h.exr", "f.exr"],
        &["render", "cornell", "--spp", "1", "--size", "8x8", "-o", "g.exr"],
        &["render", "cornell", "--spp", "1", "--size", "8x8", "-o", "-"],
    ] {
        let mut child = command(at, args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take()); // closed before anything is written
        let output = child.wait_with_output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{args:?}: {told}");
        assert!(!told.contains("panicked") && !told.contains("Broken pipe"), "{args:?}: {told}");
    }
    assert!(at.join("o.exr").is_file() && at.join("g.exr").is_file(), "the work is done all the same");
}

#[test]
fn results_that_cannot_be_told_are_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    // A twin of /dev/full; where it may not be made or used there is nothing to test.
    let node = at.join("full");
    let made = Command::new("mknod").args(["full", "c", "1", "7"]).current_dir(at).output();
    let full = || fs::OpenOptions::new().write(true).open(&node);
    if !made.is_ok_and(|made| made.status.success()) || full().is_err() {
        return;
    }
    fs::write(at.join("study.toml"), STUDY).unwrap();
    done(at, &["render", "cornell", "--spp", "2", "--size", "8x8", "-o", "f.exr"]);
    done(at, &["run", "study.toml", "--quiet", "--out", "results", "--cache", "cache"]);
    for args in [
        &["scenes"][..],
        &["methods"],
        &["methods", "--json"],
        &["check", "mc"],
        &["--help"],
        &["--version"],
        &["denoise", "f.exr", "-m", "mc", "-o", "o.exr"],
        &["denoise", "f.exr", "-m", "mc", "-o", "-"],
        &["convert", "f.exr", "f.png"],
        &["render", "cornell", "--spp", "1", "--size", "8x8", "-o", "g.exr"],
        &["run", "study.toml", "--out", "results", "--cache", "cache"],
        &["report", "results"],
    ] {
        let output = command(at, args).stdout(full().unwrap()).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{args:?}: {told}");
        assert!(told.contains("standard output") && !told.contains("panicked"), "{args:?}: {told}");
        // Nobody can be told on a full standard error either; that alone is no reason to panic.
        let output = command(at, args).stderr(full().unwrap()).output().unwrap();
        assert!(output.status.code().is_some_and(|code| code <= 1), "{args:?}");
    }
    let output = command(at, &["denoise", "f.exr", "-m", "mc", "-o", "full"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(node.exists(), "a full device is not taken away");
}

#[test]
fn an_option_that_a_kind_of_study_has_no_use_for_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("study.toml"), STUDY).unwrap();
    fs::create_dir(at.join("frames")).unwrap();
    done(at, &["render", "cornell", "--spp", "4", "--size", "8x8", "-o", "frames/spp0004.exr"]);
    let reference = ["render", "cornell", "--spp", "16", "--parts", "8", "--size", "8x8", "-o"];
    done(at, &[&reference[..], &["frames/reference.exr"]].concat());
    let scene_only: [&[&str]; 6] = [
        &["--maps", "fixed"],
        &["--frame", "0"],
        &["--orbit", "0"],
        &["--integrator", "path-tracing"],
        &["--photons", "100"],
        &["--photon-radius", "1"],
    ];
    for study in ["quick", "study.toml", "frames"] {
        for option in scene_only {
            let told = refused(at, &[&["run", study][..], option].concat(), 2);
            assert!(told.contains(option[0]) && told.contains(study), "{told}");
        }
    }
    for study in ["quick", "study.toml", "cornell", "frames"] {
        let told = refused(at, &["run", study, "--spp", "4"], 2);
        assert!(told.contains("--spp") && told.contains("samples per pixel"), "{told}");
    }
    assert!(refused(at, &["run", "frames", "--size", "8x8"], 2).contains("--size"));
    assert!(refused(at, &["run", "cornell", "--maps", "fresh"], 2).contains("photon maps"));
    let told = refused(at, &["denoise", "frames/spp0004.exr", "-m", "mc", "--spp", "9", "-o", "x.exr"], 2);
    assert!(told.contains("--spp 9") && told.contains("says 4"), "{told}");
    let render = ["render", "cornell", "--spp", "1", "--size", "8x8", "--map-seed", "3", "-o", "x.exr"];
    assert!(refused(at, &render, 2).contains("--map-seed"));
    // A study of folders alone has nothing to render.
    let text = "name = \"theirs\"\n[[scene]]\nid = \"a\"\nfolder = \"frames\"\n[[method]]\nid = \"mc\"\n";
    fs::write(at.join("theirs.toml"), text).unwrap();
    let told = refused(at, &["run", "theirs.toml", "--size", "8x8"], 2);
    assert!(told.contains("folders of frames"), "{told}");
    assert!(!at.join("noisefloor-results").exists(), "refused before any work");
}

#[test]
fn an_error_before_any_work_promises_nothing_and_names_its_cause_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("bad.toml"), STUDY.replace("\"mc\"", "\"virtual-flash\"\nset = { kapa = 2 }")).unwrap();
    let run = |study: &str| refused(at, &["run", study, "--out", "results", "--cache", "cache"], 1);
    let told = run("bad.toml");
    assert!(told.contains("kapa") && !told.contains("continues"), "{told}");
    assert_eq!(told.matches("has no parameter").count(), 1, "{told}");

    fs::write(at.join("study.toml"), STUDY).unwrap();
    fs::create_dir(at.join("results")).unwrap();
    let lock = fs::File::create(at.join("results/.lock")).unwrap();
    lock.lock().unwrap();
    let told = run("study.toml");
    assert!(told.contains("in use") && !told.contains("continues"), "{told}");
    assert_eq!(told.matches("in use").count(), 1, "{told}");
    drop(lock);

    done(at, &["run", "study.toml", "--quiet", "--out", "results", "--cache", "cache"]);
    fs::write(at.join("other.toml"), STUDY.replace("tiny", "other")).unwrap();
    let told = run("other.toml");
    assert!(told.contains("another output folder") && !told.contains("continues"), "{told}");

    let told = refused(at, &["compare", "no.exr", "no.exr"], 1);
    assert_eq!(told.matches("No such file").count(), 1, "{told}");
    let told = refused(at, &["report", "nowhere"], 1);
    assert_eq!(told.matches("No such file").count(), 1, "{told}");
}

#[test]
fn a_method_has_a_page_and_a_misspelt_one_is_answered_with_the_nearest() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let page = done(at, &["methods", "rdfc"]);
    assert!(
        page.starts_with("rdfc\n") && page.contains("# Idea") && page.contains("window_radius"),
        "{page}"
    );
    assert!(!page.contains("virtual-flash\n"), "one method alone");
    let guarded: Value =
        serde_json::from_str(&done(at, &["methods", "guarded(virtual-flash)", "--json"])).unwrap();
    assert_eq!(guarded["id"], "guarded(virtual-flash)");
    let names: Vec<&str> =
        guarded["params"].as_array().unwrap().iter().map(|p| p["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"guard_level") && names.contains(&"kappa"), "{names:?}");
    assert!(guarded["readme"].as_str().unwrap().contains("# Requires"));
    assert!(done(at, &["methods", "mc"]).starts_with("mc\n"));
    assert!(refused(at, &["methods", "rdfd"], 2).contains("rdfc"));
    let all = done(at, &["methods", "--bibtex"]);
    assert_eq!(all.matches("@article{rousselle2013rdfc,").count(), 1, "each source once: {all}");
    assert_eq!(all.matches('{').count(), all.matches('}').count(), "{all}");
    assert!(done(at, &["methods", "guarded(rdfc)", "--bibtex"]).starts_with("@article{rousselle2013rdfc,"));
    assert!(done(at, &["methods", "command", "--bibtex"]).is_empty(), "a guest's source is its program");
    assert!(refused(at, &["methods", "rdfd", "--bibtex"], 2).contains("rdfc"));
}

#[test]
fn exit_codes_are_in_the_help() {
    let folder = tempfile::tempdir().unwrap();
    let help = done(folder.path(), &["--help"]);
    for line in ["  0  done", "  1  an error", "  2  wrong usage", "  3  ", "130  stopped by Ctrl-C"] {
        assert!(help.contains(line), "{help}");
    }
    assert_eq!(noisefloor(folder.path(), &["nonsense"]).status.code(), Some(2));
    refused(folder.path(), &["run", "nonsense"], 2);
    refused(folder.path(), &["render", "nonsense", "--spp", "1", "-o", "x.exr"], 2);
}

#[test]
fn a_log_hears_of_every_scene_and_nothing_with_quiet() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let second = "[[scene]]\nid = \"second\"\nsynthetic = { image = \"edges\", law = \"gaussian\", width = 8, height = 6 }\n";
    fs::write(at.join("study.toml"), format!("{STUDY}{second}")).unwrap();
    let output = noisefloor(at, &["run", "study.toml", "--out", "one", "--cache", "cache"]);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{told}");
    for scene in ["ramp: ", "second: "] {
        assert_eq!(
            told.lines().filter(|line| line.contains(scene) && line.contains(" %")).count(),
            1,
            "{told}"
        );
    }
    let results = String::from_utf8(output.stdout).unwrap();
    assert!(results.contains("report: ") && !results.contains(" %"), "{results}");
    let output = noisefloor(at, &["run", "study.toml", "--quiet", "--out", "two", "--cache", "cache"]);
    assert!(output.stderr.is_empty() && output.stdout.is_empty());
}

/// Cells enough that the run is still going when the first is finished.
fn long_run(at: &Path) -> Child {
    let study = STUDY.replace("spp = [4]", "spp = [4]\nreplicates = 400");
    fs::write(at.join("long.toml"), study).unwrap();
    let mut child = command(at, &["run", "long.toml", "--out", "results", "--cache", "cache"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while fs::read_to_string(at.join("results/results.jsonl")).map_or(0, |text| text.lines().count()) < 2 {
        assert!(child.try_wait().unwrap().is_none(), "ended before it could be interrupted");
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

fn interrupt(child: &Child) {
    let kill = format!("kill -INT {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
}

#[test]
fn ctrl_c_keeps_what_is_finished_and_says_how_to_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let child = long_run(at);
    interrupt(&child);
    let output = child.wait_with_output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{told}");
    assert!(output.stdout.is_empty());
    let kept = fs::read_to_string(at.join("results/results.jsonl")).unwrap().lines().count();
    let said = format!("{kept} of 400 cells are finished and kept in results");
    assert!(told.contains(&said) && told.contains("continues"), "{told}");
    let again = noisefloor(at, &["run", "long.toml", "--out", "results", "--cache", "cache"]);
    let told = String::from_utf8(again.stderr).unwrap();
    assert!(again.status.success() && told.contains(&format!("continuing: {kept} cells")), "{told}");
}

#[test]
fn a_second_ctrl_c_ends_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = long_run(folder.path());
    interrupt(&child);
    let mut told = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    while !line.contains("again stops at once") {
        line.clear();
        assert!(told.read_line(&mut line).unwrap() > 0, "the first is not answered");
    }
    interrupt(&child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let mut rest = String::new();
    told.read_to_string(&mut rest).unwrap();
    assert!(!rest.contains("panicked"), "{rest}");
}
