//! The command as a person uses it: one verb after the other on a small frame, and every way to be wrong.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn noisefloor(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_noisefloor")).args(args).current_dir(folder).output().unwrap()
}

fn done(folder: &Path, args: &[&str]) -> String {
    let output = noisefloor(folder, args);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{args:?}: {errors}");
    assert!(errors.is_empty(), "piped, so nothing but results: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

fn refused(folder: &Path, args: &[&str]) -> String {
    let output = noisefloor(folder, args);
    assert!(!output.status.success(), "{args:?} went through");
    assert!(output.stdout.is_empty(), "{args:?} printed a result");
    String::from_utf8(output.stderr).unwrap()
}

fn json(folder: &Path, args: &[&str]) -> Value {
    serde_json::from_str(&done(folder, args)).unwrap()
}

#[test]
fn a_frame_is_rendered_denoised_and_compared() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    done(at, &["render", "cornell", "--spp", "8", "--seed", "3", "--size", "32x24", "-o", "frame.exr"]);
    done(
        at,
        &["render", "cornell", "--spp", "256", "--parts", "8", "--size", "32x24", "-o", "reference.exr"],
    );
    let told = json(
        at,
        &["denoise", "frame.exr", "--method", "virtual-flash", "-o", "out.exr", "--json", "--diagnostics"],
    );
    assert!(told["seconds"]["denoise"].as_f64().unwrap() > 0.0);
    assert!(told["seconds"]["stages"]["step 1"].is_f64(), "{told}");
    let diagnostics = told["diagnostics"].as_array().unwrap();
    assert!(!diagnostics.is_empty());
    for diagnostic in diagnostics {
        assert!(at.join(diagnostic["path"].as_str().unwrap()).is_file(), "{diagnostic}");
    }

    let noisy = json(at, &["compare", "frame.exr", "reference.exr", "--json"]);
    let denoised = json(at, &["compare", "out.exr", "reference.exr", "--json"]);
    let relmse = |v: &Value| v["metrics"]["relmse"].as_f64().unwrap();
    assert!(relmse(&denoised) < 0.5 * relmse(&noisy), "{} {}", relmse(&denoised), relmse(&noisy));
    assert!(denoised["reference_standard_error"]["mse"].as_f64().unwrap() > 0.0);
}

#[test]
fn what_is_rendered_can_be_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let frame = |extra: &[&str]| {
        let start = ["render", "cornell", "--spp", "8", "--size", "24x18", "-o", "f.exr"];
        done(at, &[&start[..], extra].concat());
        noisefloor::io::read_frame(at.join("f.exr"), &noisefloor::io::ReadOptions::default()).unwrap()
    };
    let plain = frame(&[]);
    let through = frame(&["--feature-hit", "through-specular"]);
    assert_eq!(plain.color, through.color);
    assert_ne!(plain.features, through.features);
    assert_eq!(through.provenance.extra["feature_hit"], "through-specular");
    let later = frame(&["--start", "8"]);
    assert_ne!(plain.color.mean, later.color.mean);
    assert_eq!(later.provenance.extra["sample_start"], "8");
    let even = frame(&["--sampling", "low-discrepancy"]);
    assert_eq!(even.sampling.name(), "low-discrepancy");
    // The frame itself serves as a sky.
    done(
        at,
        &["render", "outdoor", "--spp", "2", "--size", "24x18", "--environment", "f.exr", "-o", "o.exr"],
    );
    let lit = noisefloor::io::read_frame(at.join("o.exr"), &noisefloor::io::ReadOptions::default()).unwrap();
    assert_eq!(lit.provenance.extra["environment"], "f.exr");
    assert!(
        refused(at, &["render", "cornell", "--spp", "2", "--environment", "no.exr", "-o", "x.exr"])
            .contains("no.exr")
    );
}

#[test]
fn photon_maps_and_sequences_can_be_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let read = |name: &str| {
        noisefloor::io::read_frame(at.join(name), &noisefloor::io::ReadOptions::default()).unwrap()
    };
    let start = ["render", "cornell", "--spp", "4", "--size", "24x18"];
    let with = |extra: &[&str]| done(at, &[&start[..], extra].concat());
    let told =
        with(&["--integrator", "photon-mapping", "--photons", "2000", "--map-seed", "9", "-o", "p.exr"]);
    assert!(told.contains("caustic and"), "{told}");
    let mapped = read("p.exr");
    assert!(mapped.provenance.integrator.as_ref().unwrap().starts_with("photon-mapping"));
    assert_eq!(mapped.provenance.extra["photon_map_seed"], "9");
    assert!(mapped.provenance.extra["photon_paths"].starts_with("2000 global, 10000 caustic"));
    with(&["--photons", "2000", "--record", "caustics,brdf", "-o", "c.exr"]);
    let caustics = read("c.exr");
    assert_eq!(caustics.features.keys().map(|k| k.name()).collect::<Vec<_>>(), ["caustics", "brdf"]);
    assert!(caustics.features.values().all(|f| f.variance.is_some() && f.halves.is_some()));
    // Without maps there is no such feature.
    let error = refused(at, &[&start[..], &["--record", "caustics", "-o", "x.exr"]].concat());
    assert!(error.contains("caustics"), "{error}");

    with(&["--frames", "2", "--orbit", "10", "--record", "depth,motion", "-o", "s.exr"]);
    let (first, second) = (read("s.0000.exr"), read("s.0001.exr"));
    assert_ne!(first.color.mean, second.color.mean);
    assert_eq!(second.provenance.extra["sequence_frame"], "1");
    assert_ne!(first.provenance.seed, second.provenance.seed);
    let motion = first.features.iter().find(|(id, _)| id.name() == "motion").unwrap().1;
    assert!(motion.mean.data().iter().any(|v| v.abs() > 0.5), "the camera turns by 10°");
    with(&["--frame", "1", "--orbit", "10", "--record", "depth,motion", "-o", "one.exr"]);
    assert_eq!(read("one.exr").color, second.color);
}

#[test]
fn a_gltf_file_is_a_scene_and_what_it_lacks_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let corners = [[-9.0f32, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]];
    let bytes: Vec<u8> = corners.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
    std::fs::write(at.join("one.bin"), bytes).unwrap();
    let text = r#"{
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"name": "glow", "emissiveFactor": [1.0, 0.5, 0.25]}],
        "buffers": [{"uri": "one.bin", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [-9, -9, 0], "max": [9, 9, 0]}]
    }"#;
    std::fs::write(at.join("one.gltf"), text).unwrap();
    let args = ["render", "one.gltf", "--spp", "4", "--size", "9x7", "--depth", "1", "-o", "one.exr"];
    let output = noisefloor(at, &args);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && told.contains("no perspective camera"), "{told}");
    let frame =
        noisefloor::io::read_frame(at.join("one.exr"), &noisefloor::io::ReadOptions::default()).unwrap();
    assert_eq!(frame.provenance.scene.as_deref(), Some("one"));
    let middle = 3 * 9 + 4;
    let color: Vec<f32> = (0..3).map(|c| frame.color.mean.plane(c)[middle]).collect();
    assert_eq!(color, [1.0, 0.5, 0.25]);

    std::fs::remove_file(at.join("one.bin")).unwrap();
    let error = refused(at, &args);
    assert!(error.contains("one.bin") && error.matches("No such file").count() == 1, "{error}");
}

#[test]
fn equal_seeds_give_equal_files_for_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let image = |threads: &str, name: &str| {
        let args = ["render", "toaster", "--spp", "4", "--size", "24x18", "--threads", threads, "-o", name];
        done(at, &args);
        std::fs::read(at.join(name)).unwrap()
    };
    // Byte for byte: neither threads nor seconds are in the file.
    assert!(image("1", "one.exr") == image("3", "three.exr"));
}

#[test]
fn lists_are_arrays_of_objects_with_an_id() {
    let folder = tempfile::tempdir().unwrap();
    for (verb, expected) in [("methods", "virtual-flash"), ("scenes", "outdoor")] {
        let list = json(folder.path(), &[verb, "--json"]);
        let ids: Vec<&str> = list.as_array().unwrap().iter().map(|o| o["id"].as_str().unwrap()).collect();
        assert!(ids.contains(&expected), "{ids:?}");
        assert!(done(folder.path(), &[verb]).contains(expected));
    }
}

#[test]
fn misspelt_names_are_answered_with_the_nearest_and_the_range() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    done(at, &["render", "cornell", "--spp", "2", "--size", "8x8", "-o", "frame.exr", "--record", "none"]);
    let denoise = |more: &[&str]| {
        let mut args = vec!["denoise", "frame.exr", "-o", "out.exr", "--method"];
        args.extend(more);
        refused(at, &args)
    };
    assert!(denoise(&["virtual-flsh"]).contains("virtual-flash"));
    let told = denoise(&["virtual-flash", "--set", "kapa=2"]);
    assert!(told.contains("kapa") && told.contains("kappa ("), "{told}");
    let told = denoise(&["virtual-flash", "--set", "steps=7"]);
    assert!(told.contains("steps") && told.contains('7'), "{told}");
    // The frame has no flash image: refused before any work, naming what is missing.
    let told = denoise(&["virtual-flash"]);
    assert!(told.contains("virtual flash image"), "{told}");
    assert!(!at.join("out.exr").exists());
    assert!(refused(at, &["run", "quik"]).contains("quick"));
    assert!(refused(at, &["render", "cornel", "--spp", "1", "-o", "x.exr"]).contains("cornell"));
    let told = refused(at, &["render", "cornell", "--spp", "1", "--record", "fog", "-o", "x.exr"]);
    assert!(told.contains("fog") && told.contains("albedo"), "{told}");
}

#[test]
fn an_output_that_cannot_be_written_is_an_error_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let args = ["render", "cornell", "--spp", "1", "--size", "8x8", "-o", "no/such/folder/frame.exr"];
    assert!(refused(folder.path(), &args).contains("frame.exr"));
    std::fs::write(folder.path().join("file"), "not a folder").unwrap();
    let told = refused(folder.path(), &["run", "quick", "--quiet", "--out", "file/results"]);
    assert!(told.contains("file"), "{told}");
}

#[test]
fn a_report_can_be_made_again_from_what_was_kept() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(
        at.join("study.toml"),
        "name = \"tiny\"\nspp = [4, 8]\nreplicates = 2\nwidth = 16\nheight = 12\ntiming = { warmup = 0, runs = 1 }\n\
         [[scene]]\nid = \"ramp\"\nsynthetic = { image = \"ramps\", law = \"gaussian\", width = 16, height = 12 }\n\
         [[method]]\nid = \"mc\"\n[[method]]\nid = \"virtual-flash\"\n",
    )
    .unwrap();
    done(at, &["run", "study.toml", "--quiet", "--out", "results", "--cache", "cache"]);
    let page = at.join("results/report/index.html");
    let summary = |name: &str| -> Value {
        serde_json::from_slice(&std::fs::read(at.join("results").join(name)).unwrap()).unwrap()
    };
    let first = summary("summary.json");
    std::fs::remove_dir_all(at.join("results/report")).unwrap();
    std::fs::remove_dir_all(at.join("cache")).unwrap();
    done(at, &["report", "results", "--recompute"]);
    assert!(page.is_file());
    assert_eq!(
        first["cells"],
        summary("summary.json")["cells"],
        "kept images give the recorded metrics again"
    );
}

#[test]
fn a_study_that_is_only_read_is_reported_into_another_folder_and_rows_run_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(
        at.join("study.toml"),
        "name = \"tiny\"\nspp = [4]\nreplicates = 2\nwidth = 16\nheight = 12\ntiming = { warmup = 0, runs = 1 }\n\
         [[scene]]\nid = \"ramp\"\nsynthetic = { image = \"ramps\", law = \"gaussian\" }\n\
         [[method]]\nid = \"mc\"\n[[method]]\nid = \"virtual-flash\"\n",
    )
    .unwrap();
    let run = ["run", "study.toml", "--quiet", "--out", "results", "--cache", "cache"];
    done(at, &run);
    let records = || std::fs::read_to_string(at.join("results/results.jsonl")).unwrap();
    let summary = std::fs::read(at.join("results/summary.json")).unwrap();
    let first = records();
    std::fs::remove_dir_all(at.join("results/report")).unwrap();
    done(at, &["report", "results", "--out", "elsewhere"]);
    assert!(at.join("elsewhere/report/index.html").is_file() && at.join("elsewhere/summary.json").is_file());
    assert!(!at.join("results/report").exists());
    assert_eq!(std::fs::read(at.join("results/summary.json")).unwrap(), summary);

    done(at, &[&run[..], &["--again", "virtual-flash"]].concat());
    let second = records();
    let same: Vec<bool> = first.lines().zip(second.lines()).map(|(a, b)| a == b).collect();
    assert_eq!(same, [true, false, true, false]);
    let told = refused(at, &[&run[..], &["--again", "virtual-flsh"]].concat());
    assert!(told.contains("virtual-flsh") && told.contains("mc, virtual-flash"), "{told}");
}

const TWO_ROWS: &str = "name = \"tiny\"\nspp = [4, 8]\nreplicates = 2\nwidth = 16\nheight = 12\ntiming = { warmup = 0, runs = 1 }\n\
    [[scene]]\nid = \"ramp\"\nsynthetic = { image = \"ramps\", law = \"gaussian\", width = 16, height = 12 }\n\
    [[scene]]\nid = \"steps\"\nsynthetic = { image = \"edges\", law = \"gaussian\", width = 16, height = 12 }\n\
    [[method]]\nid = \"mc\"\n[[method]]\nid = \"guarded(mc)\"\n";

#[test]
fn the_table_of_a_run_names_exact_truth_and_shows_both_ends_of_ratios() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("study.toml"), TWO_ROWS.replace("guarded(mc)", "virtual-flash")).unwrap();
    let output = noisefloor(at, &["run", "study.toml", "--out", "results", "--cache", "cache"]);
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{told}");
    assert!(told.contains("ramp, 16×12, exact truth\n"), "{told}");
    assert!(!told.contains("0 samples per pixel") && !told.contains("unfinished"), "{told}");
    let row = told.lines().find(|line| line.starts_with("virtual-flash")).unwrap();
    // Errors may be cut at zero and have both ends, too.
    assert!(row.matches('[').count() >= 2, "two ratios, each with both ends: {row}");
}

#[test]
fn a_report_of_an_unfinished_study_says_so_and_ends_with_a_code_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("study.toml"), TWO_ROWS).unwrap();
    done(at, &["run", "study.toml", "--quiet", "--out", "results", "--cache", "cache"]);
    // As if the run had been stopped in the first scene.
    let records = at.join("results/results.jsonl");
    let text = std::fs::read_to_string(&records).unwrap();
    let kept: Vec<&str> = text.lines().take(6).collect();
    std::fs::write(&records, kept.join("\n") + "\n").unwrap();
    std::fs::remove_file(at.join("results/reference/steps.json")).unwrap();
    let output = noisefloor(at, &["report", "results"]);
    assert_eq!(output.status.code(), Some(3));
    let told = String::from_utf8(output.stderr).unwrap();
    for part in
        ["unfinished: 6 of 16 cells", "all of scene steps (8 cells)", "ramp at 8 spp, replicate 2 (2 cells)"]
    {
        assert!(told.contains(part), "{part:?} is missing: {told}");
    }
    let page = std::fs::read_to_string(at.join("results/report/index.html")).unwrap();
    assert!(page.contains("Unfinished: 6 of 16 cells") && !page.contains("Every method ran on every frame"));
    let summary: Value =
        serde_json::from_slice(&std::fs::read(at.join("results/summary.json")).unwrap()).unwrap();
    assert_eq!((&summary["progress"]["planned"], &summary["progress"]["finished"]), (&16.into(), &6.into()));
    done(at, &["run", "study.toml", "--quiet", "--out", "results", "--cache", "cache"]);
    done(at, &["report", "results"]);
}

#[test]
fn a_study_is_recorded_and_opens_again_without_its_images() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("study.toml"), TWO_ROWS).unwrap();
    done(at, &["run", "study.toml", "--quiet", "--out", "results", "--cache", "cache"]);
    let told = done(at, &["record", "results", "recorded"]);
    assert!(told.contains("recorded: recorded ("), "{told}");
    let readme = std::fs::read_to_string(at.join("recorded/README.md")).unwrap();
    assert!(readme.contains("| `guarded(mc)` |") && readme.contains("All 16 cells"), "{readme}");
    std::fs::remove_dir_all(at.join("results")).unwrap();
    let told = done(at, &["report", "recorded", "--out", "again"]);
    assert!(told.contains("images are not kept"), "{told}");
    assert!(at.join("again/summary.json").is_file());
    let page = std::fs::read_to_string(at.join("again/report/index.html")).unwrap();
    assert!(page.contains("Made from a recorded study") && !page.contains("Not readable"));
    let kept: Vec<_> =
        std::fs::read_dir(at.join("recorded")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(kept.len(), 5, "{kept:?}");
    assert!(refused(at, &["report", "again"]).contains("study.json"), "a report is no study");
}
