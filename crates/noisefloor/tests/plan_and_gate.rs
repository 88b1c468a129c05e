//! `noisefloor plan` and `noisefloor gate` as a person and as a script use them.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn noisefloor(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_noisefloor"))
        .args(args)
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .current_dir(folder)
        .output()
        .unwrap()
}

fn ended(folder: &Path, args: &[&str], code: i32) -> (String, String) {
    let output = noisefloor(folder, args);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, errors) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{args:?}: {out}{errors}");
    (out, errors)
}

fn json(folder: &Path, args: &[&str]) -> Value {
    serde_json::from_str(&ended(folder, args, 0).0).unwrap()
}

const STUDY: &str = r#"
name = "tiny"
spp = [4, 16]
replicates = 4
timing = { warmup = 0, runs = 1 }
[[scene]]
id = "steps"
synthetic = { image = "edges", law = "gaussian", sd = 0.5, width = 24, height = 16 }
[[method]]
id = "mc"
[[method]]
id = "virtual-flash"
set = { guide = "color" }
"#;

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).unwrap();
}

#[test]
fn a_plan_says_what_replicates_can_tell_before_and_after_they_were_made() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write(at, "tiny.toml", STUDY);
    let before = json(at, &["plan", "tiny.toml", "--json"]);
    assert_eq!(
        (&before["cells"], &before["finished_cells"], &before["pairs"]),
        (&16.into(), &0.into(), &1.into())
    );
    assert!(
        before["spread_from"].is_null() && before["samples"] == 0 && before["samples_per_second"].is_null()
    );
    let usual = &before["levels"][0]["told"][1];
    // One pair, four replicates: t/√4 = 1.591.
    let told = usual["ratio_told_by_half"].as_f64().unwrap();
    assert!((told - (-1.591f64 * 0.025).exp()).abs() < 1e-5, "{usual}");
    assert!(usual["ratio_told_with_power"].as_f64().unwrap() < told);
    assert!(!at.join("noisefloor-results").exists() && !at.join("cache").exists(), "nothing is written");
    // With more replicates smaller differences are told.
    let more = json(at, &["plan", "tiny.toml", "--replicates", "16", "--json"]);
    assert_eq!(more["cells"], 64);
    assert!(more["levels"][0]["told"][1]["ratio_told_by_half"].as_f64().unwrap() > told);

    ended(at, &["run", "tiny.toml", "--out", "out", "-q"], 0);
    let after = json(at, &["plan", "tiny.toml", "--out", "out", "--json", "--ratio", "0.9"]);
    assert_eq!((&after["finished_cells"], &after["spread_from"]), (&16.into(), &"out".into()));
    let levels = after["levels"].as_array().unwrap();
    assert_eq!(levels.len(), 2);
    assert!(levels.iter().all(|level| level["told"][0]["spread"].as_f64().unwrap() > 0.0), "{after}");
    let (text, _) = ended(at, &["plan", "tiny.toml", "--from", "out"], 0);
    assert!(text.contains("half would tell") && text.contains("steps") && text.contains("minutes"), "{text}");
    let (_, told) = ended(at, &["plan", "tiny.toml", "--ratio", "1"], 2);
    assert!(told.contains("--ratio"), "{told}");
    let (_, told) = ended(at, &["plan", "tiny.toml", "--from", "nowhere"], 1);
    assert!(told.contains("nowhere"), "{told}");
}

#[test]
fn a_plan_of_a_rendered_scene_says_what_rendering_takes_here() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let frames = "synthetic = { image = \"edges\", law = \"gaussian\", sd = 0.5, width = 24, height = 16 }";
    let study = STUDY.replace(frames, "").replace("steps\"", "cornell\"");
    write(at, "tiny.toml", &study);
    let plan = json(at, &["plan", "tiny.toml", "--size", "24x16", "--json"]);
    assert!(plan["samples"].as_u64().unwrap() > 0, "{plan}");
    assert!(plan["samples_per_second"].as_f64().unwrap() > 0.0);
    let [low, high] = [0, 1].map(|k| plan["render_minutes"][k].as_f64().unwrap());
    assert!(0.0 < low && low < high);
}

#[test]
fn a_gate_ends_with_a_code_for_each_answer() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write(at, "tiny.toml", STUDY);
    write(at, "worse.toml", &STUDY.replace("guide = \"color\"", "guide = \"color\", steps = 1"));
    write(at, "seed.toml", &STUDY.replace("replicates = 4", "replicates = 4\nseed = 3"));
    for (file, out) in
        [("tiny.toml", "old"), ("tiny.toml", "new"), ("worse.toml", "other"), ("seed.toml", "seed")]
    {
        ended(at, &["run", file, "--out", out, "-q"], 0);
    }
    let (text, errors) = ended(at, &["gate", "old", "new", "--strict"], 0);
    assert!(text.contains("same: all numbers are equal, bit by bit") && errors.is_empty(), "{text}{errors}");
    assert_eq!(json(at, &["gate", "old", "new", "--json"])["overall"], "same");

    // Another number of steps is a change; which of the two is worse the errors say.
    let [there, back] = [["old", "other"], ["other", "old"]]
        .map(|[old, new]| noisefloor(at, &["gate", old, new, "--metric", "mse"]).status.code().unwrap());
    assert!([(4, 0), (0, 4), (4, 4)].contains(&(there, back)), "{there} {back}");
    let wide = noisefloor(at, &["gate", "old", "other", "--metric", "mse", "--margin", "0.99", "--strict"]);
    assert!([0, 4, 6].contains(&wide.status.code().unwrap()));

    let (out, errors) = ended(at, &["gate", "old", "seed"], 5);
    assert!(out.is_empty() && errors.contains("frames of `mc` on `steps` differ"), "{errors}");
    let (_, errors) = ended(at, &["gate", "old", "new", "--metric", "psnr"], 2);
    assert!(errors.contains("psnr") && errors.contains("relmse"), "{errors}");
    let (_, errors) = ended(at, &["gate", "old", "nowhere"], 1);
    assert!(errors.contains("nowhere"), "{errors}");
    let (_, errors) = ended(at, &["gate", "old", "new", "--alpha", "1"], 2);
    assert!(errors.contains("--alpha"), "{errors}");
}
