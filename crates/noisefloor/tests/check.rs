//! `noisefloor check`: a line for each recipe, and what a script can tell from it.

use std::process::{Command, Output};

use noisefloor::conformance::recipes;
use serde_json::Value;

fn check(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_noisefloor")).arg("check").args(args).output().unwrap()
}

fn told(output: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_method_that_keeps_every_recipe_gets_a_line_for_each_and_ends_well() {
    let output = check(&["guarded(mc)", "--set", "guard_level=0.95"]);
    let (lines, errors) = told(&output);
    assert!(output.status.success() && errors.is_empty(), "{errors}");
    assert_eq!(lines.lines().count(), 1 + recipes().len(), "{lines}");
    assert!(lines.starts_with("guarded(mc)\n  pass "), "{lines}");
    let sizes = lines.lines().find(|line| line.contains("sizes")).unwrap();
    assert_eq!(sizes, "  pass      sizes         takes images of any size, down to one pixel (13 frames)");
    assert!(lines.contains("(it looks at one frame)"), "{lines}");
}

#[cfg(unix)]
#[test]
fn a_broken_recipe_is_told_and_fails() {
    let guest = ["command", "--set", "run=sh -c 'head -c 999 $0 > $1' {color.pfm} {output.pfm}"];
    let output = check(&guest);
    let (lines, errors) = told(&output);
    assert_eq!(output.status.code(), Some(1), "{lines}{errors}");
    assert!(lines.contains("  FAIL      runs "), "{lines}");
    assert!(lines.contains("; every method denoises a frame that has everything"), "{lines}");
    assert!(errors.contains("1 of 1 methods broke a recipe: command"), "{errors}");
    let json = check(&[&guest[..], &["--json"]].concat());
    assert_eq!(json.status.code(), Some(1));
    let list: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!((&list[0]["id"], &list[0]["conforms"]), (&"command".into(), &false.into()));
    assert_eq!(list[0]["recipes"].as_array().unwrap().len(), recipes().len());
}

#[test]
fn what_there_is_not_is_wrong_usage() {
    for (args, part) in [
        (&["rdfd"][..], "rdfc"),
        (&["mc", "--set", "radius=1"], "radius"),
        (&[], "METHOD"),
        (&["mc", "--all"], "--all"),
        (&["--all", "--set", "a=1"], "--set"),
    ] {
        let output = check(args);
        let (lines, errors) = told(&output);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {errors}");
        assert!(lines.is_empty() && errors.contains(part), "{args:?}: {errors}");
    }
}
