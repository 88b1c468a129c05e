//! Frame and reference must be the same picture and independent: refused where headers prove the contrary, told where
//! the data show it.

use std::path::Path;
use std::process::{Command, Output};

use noisefloor::io::{Area, ReadOptions, Window, read_frame, write_frame, write_image, write_image_at};
use noisefloor::{Frame, Image};
use serde_json::Value;

fn noisefloor(folder: &Path, args: &[&str]) -> Output {
    let cache = folder.join("cache");
    Command::new(env!("CARGO_BIN_EXE_noisefloor"))
        .args(args)
        .env("XDG_CACHE_HOME", cache)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn done(folder: &Path, args: &[&str]) -> String {
    let output = noisefloor(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn refused(folder: &Path, args: &[&str]) -> String {
    let output = noisefloor(folder, args);
    assert_eq!(output.status.code(), Some(1), "{args:?}");
    String::from_utf8(output.stderr).unwrap()
}

const SIZE: [&str; 2] = ["--size", "64x48"];

fn render(folder: &Path, spp: &str, file: &str, more: &[&str]) -> String {
    let start = ["render", "cornell", "--spp", spp, "--record", "none", "-o", file];
    done(folder, &[&start[..], &SIZE, more].concat())
}

fn frame(path: impl AsRef<Path>) -> Frame {
    read_frame(path, &ReadOptions::default()).unwrap()
}

#[test]
fn frames_of_the_usual_seed_are_independent_and_of_one_seed_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::create_dir(at.join("sound")).unwrap();
    let told = render(at, "16", "sound/a16.exr", &[]);
    render(at, "64", "sound/a64.exr", &[]);
    render(at, "256", "sound/reference.exr", &[]);
    let seed = frame(at.join("sound/a16.exr")).provenance.seed.unwrap();
    assert!(told.contains(&format!("seed {seed}")), "{told}");
    assert_ne!(frame(at.join("sound/a64.exr")).provenance.seed, Some(seed));
    let told = done(at, &["compare", "sound/a64.exr", "sound/reference.exr"]);
    assert!(!told.contains("! "), "{told}");

    // One seed for all, as it was said.
    std::fs::create_dir(at.join("shared")).unwrap();
    for (spp, name) in [("16", "a16.exr"), ("64", "a64.exr"), ("256", "reference.exr")] {
        render(at, spp, &format!("shared/{name}"), &["--seed", "5"]);
    }
    let run = ["run", "shared", "--out", "out", "--cache", "cache", "-q"];
    let told = refused(at, &run);
    assert!(told.contains("a16.exr") && told.contains("reference.exr") && told.contains("seed 5"), "{told}");
    assert!(!at.join("out/results.jsonl").exists(), "nothing was run");
    let told = refused(at, &["compare", "shared/a64.exr", "shared/reference.exr"]);
    assert!(told.contains("not independent") && told.contains("seed 5"), "{told}");

    // Without seeds in the headers the data show it.
    for name in ["a16.exr", "a64.exr", "reference.exr"] {
        let path = at.join("shared").join(name);
        let mut frame = frame(&path);
        frame.provenance.seed = None;
        write_frame(&path, &frame).unwrap();
    }
    let output = noisefloor(at, &run);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(7), "a fault of the instrument: {told}");
    assert!(told.contains("I5 (independence) on shared at 64 spp"), "{told}");
    let summary: Value =
        serde_json::from_slice(&std::fs::read(at.join("out/summary.json")).unwrap()).unwrap();
    assert_eq!(summary["findings"][0]["kind"], "dependent", "{}", summary["findings"]);
    let told = done(at, &["compare", "shared/a64.exr", "shared/reference.exr"]);
    assert!(told.starts_with("! ") && told.contains("they share samples"), "{told}");
}

#[test]
fn a_file_compared_with_itself_or_with_a_file_made_of_it_is_not_independent() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    render(at, "16", "f.exr", &[]);
    assert!(refused(at, &["compare", "f.exr", "f.exr"]).contains("test and reference are not independent"));
    // The colour alone, without a word about its origin.
    write_image(at.join("bare.exr"), &frame(at.join("f.exr")).color.mean, &Default::default()).unwrap();
    let told = refused(at, &["compare", "bare.exr", "f.exr", "--json"]);
    assert!(told.contains("not independent") && told.contains("bit for bit"), "{told}");
    // A reference of which the image is nearly half: its squared error comes out below zero.
    let mut half = frame(at.join("f.exr"));
    let [a, b] = half.color.halves.clone().unwrap();
    half.color.mean = Image::from_fn(64, 48, 3, |c, x, y| 0.5001 * a.get(c, x, y) + 0.4999 * b.get(c, x, y));
    write_image(at.join("near.exr"), &half.color.mean, &Default::default()).unwrap();
    let told = done(at, &["compare", "near.exr", "f.exr"]);
    assert!(told.starts_with("! ") && told.contains("standard errors below zero"), "{told}");
    // Images without noise may be equal: an error of nothing.
    write_image(at.join("again.exr"), &frame(at.join("f.exr")).color.mean, &Default::default()).unwrap();
    let told = done(at, &["compare", "bare.exr", "again.exr"]);
    assert!(told.contains("bit for bit"), "{told}");
}

#[test]
fn windows_at_different_places_are_refused_before_decoding_and_kept_by_denoising() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let image = Image::from_fn(16, 12, 3, |c, x, y| (c + x * y) as f32);
    let window = |x: i32| {
        let area = Area { origin: (x, 0), size: (16, 12) };
        Window { data: area, display: area }
    };
    for (name, x) in [("a.exr", 0), ("b.exr", 1)] {
        write_image_at(at.join(name), &image, &Default::default(), &window(x)).unwrap();
    }
    let told = refused(at, &["compare", "a.exr", "b.exr"]);
    assert!(told.contains("16×12 at (0, 0)") && told.contains("16×12 at (1, 0)"), "{told}");
    // Sizes come from headers: the pixels of this one are gone.
    write_image(at.join("small.exr"), &Image::new(3, 3, 3), &Default::default()).unwrap();
    let bytes = std::fs::read(at.join("small.exr")).unwrap();
    std::fs::write(at.join("small.exr"), &bytes[..bytes.len() - 20]).unwrap();
    let told = refused(at, &["compare", "small.exr", "b.exr"]);
    assert!(told.contains("3×3") && told.contains("16×12"), "{told}");
    done(at, &["denoise", "b.exr", "--spp", "4", "--method", "mc", "-o", "out.exr"]);
    assert_eq!(noisefloor::io::read_origin(at.join("out.exr")).unwrap().window, window(1));
}

#[test]
fn a_reference_of_another_exposure_or_curve_is_told_with_what_fits() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    render(at, "64", "frame.exr", &[]);
    render(at, "512", "reference.exr", &["--parts", "8"]);
    let encode = |v: f32| if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
    let linear = frame(at.join("reference.exr")).color.mean;
    for (image, words) in [
        (linear.map(|v| 2.0 * v), "ratio 0.50; fits after exposure −1 stop"),
        (linear.map(encode), "undoing the sRGB curve"),
    ] {
        write_image(at.join("other.exr"), &image, &Default::default()).unwrap();
        let told = done(at, &["compare", "frame.exr", "other.exr"]);
        assert!(told.starts_with("! ") && told.contains(words), "{told}");
    }
}
