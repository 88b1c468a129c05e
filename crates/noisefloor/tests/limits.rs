//! Inputs that ask for more than there is: each ends at once in one line that names value and limit.

use std::path::Path;
use std::process::{Command, Output};

fn noisefloor(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_noisefloor")).args(args).current_dir(folder).output().unwrap()
}

fn refused(folder: &Path, args: &[&str]) -> String {
    let output = noisefloor(folder, args);
    let told = String::from_utf8(output.stderr).unwrap();
    // 1: an error; 2: wrong usage. Not 101, a panic, nor a signal, which has no code.
    assert!(matches!(output.status.code(), Some(1 | 2)), "{:?}: {:?}", args.first(), output.status);
    assert!(output.stdout.is_empty(), "printed a result");
    assert!(!told.contains("panicked") && told.len() < 3000, "{told}");
    told
}

/// An environment map of one row.
fn write_map(path: &Path, texels: &[f32]) {
    let image = noisefloor::Image::from_fn(texels.len(), 1, 3, |_, x, _| texels[x]);
    noisefloor::io::write_image(path, &image, &std::collections::BTreeMap::new()).unwrap();
}

#[test]
fn images_that_do_not_fit_into_memory_are_refused_with_the_estimate() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let render = ["render", "cornell", "--spp", "1", "-o", "f.exr", "--size"];
    let told = refused(at, &[&render[..], &["16384x16384", "--max-memory", "6"]].concat());
    assert!(told.contains("16384×16384") && told.contains("allowed are 6442450944"), "{told}");
    let told = refused(at, &["run", "cornell", "--size", "16384x16384", "--max-memory", "6", "--out", "o"]);
    assert!(told.contains("16384×16384") && told.contains("allowed are 6442450944"), "{told}");
    assert!(!at.join("f.exr").exists() && !at.join("o").exists());
    for bad in ["0x0", "0x5", "99999999999999999999x1", "16385x1"] {
        assert!(refused(at, &[&render[..], &[bad]].concat()).contains(bad), "{bad}");
    }
    refused(at, &["render", "cornell", "--size", "4x4", "--spp", "1", "-o", "f.exr", "--max-memory", "0"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_limit_on_the_address_space_is_seen_before_it_is_hit() {
    let folder = tempfile::tempdir().unwrap();
    // 6 GB, as `ulimit -v` counts: KiB.
    let script = format!(
        "ulimit -v 6000000; exec {} render cornell --spp 1 --size 16384x16384 -o f.exr --threads 2",
        env!("CARGO_BIN_EXE_noisefloor")
    );
    let output = Command::new("sh").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("16384×16384") && told.contains("allowed are"), "{told}");
}

#[test]
fn environments_without_meaning_name_their_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let render =
        ["render", "outdoor", "--spp", "4", "--size", "16x12", "-o", "f.exr", "--environment", "sky.exr"];
    for bad in [3e38, f32::INFINITY, f32::NAN, -1.0] {
        write_map(&at.join("sky.exr"), &[1.0, 1.0, bad, 1.0]);
        let told = refused(at, &render);
        assert!(told.contains("texel (2, 0)") && told.contains("at most 1e15"), "{bad}: {told}");
    }
    write_map(&at.join("sky.exr"), &[1.0]);
    assert!(noisefloor(at, &render).status.success(), "one texel is a sky");
    write_map(&at.join("sky.exr"), &[0.0]);
    let output = noisefloor(at, &render);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && !told.contains("black") || told.contains("the picture is black"),
        "{told}"
    );
}

#[test]
fn nesting_of_combinators_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    noisefloor(
        at,
        &["render", "two-quads", "--spp", "2", "--size", "8x6", "-o", "f.exr", "--record", "none"],
    );
    for method in ["guarded(".repeat(2000), format!("{}mc{}", "guarded(".repeat(2000), ")".repeat(2000))] {
        let told = refused(at, &["denoise", "f.exr", "-m", &method, "-o", "o.exr"]);
        assert!(told.contains("guarded 2000 times; allowed: at most 8"), "{told}");
    }
    let value = format!("steps={}1{}", "[".repeat(20_000), "]".repeat(20_000));
    let told = refused(at, &["denoise", "f.exr", "-m", "virtual-flash", "--set", &value, "-o", "o.exr"]);
    assert!(told.contains("steps"), "{told}");
}

#[test]
fn numbers_out_of_range_are_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let render = |extra: &[&str]| {
        let start = ["render", "rings", "--size", "8x6", "-o", "f.exr"];
        refused(at, &[&start[..], extra].concat())
    };
    for extra in [
        &["--spp", "4294967296"][..],
        &["--spp", "0"],
        &["--spp", "4294967295", "--start", "1"],
        &["--spp", "4294967288", "--parts", "8"],
        &["--spp", "4", "--threads", "1000000"],
        &["--spp", "4", "--photons", "1000000000000"],
        &["--spp", "4", "--photons", "1000", "--photon-radius", "nan"],
        &["--spp", "4", "--photons", "1000", "--photon-radius", "1e30"],
        &["--spp", "4", "--orbit", "nan"],
        &["--spp", "4", "--orbit", "inf", "--frame", "1"],
        &["--spp", "4", "--orbit", "1e30"],
        &["--spp", "4", "--depth", "4294967295"],
        &["--spp", "4", "--frames", "4294967295"],
        &["--spp", "4", "--feature-hit", "last"],
    ] {
        render(extra);
    }
    assert!(!at.join("f.exr").exists());
}

#[test]
fn studies_that_would_never_end_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for (top, scene, value) in
        [("", "replicates = 1000000000", "1000000000"), ("timing = { runs = 1000000000 }", "", "1000000000")]
    {
        let text = format!(
            "name = \"s\"\nspp = [4]\n{top}\n[[scene]]\nid = \"two-quads\"\n{scene}\n[[method]]\nid = \"mc\"\n"
        );
        std::fs::write(at.join("s.toml"), text).unwrap();
        let told = refused(at, &["run", "s.toml", "--out", "o", "--cache", "c"]);
        assert!(told.contains(value) && told.contains("allowed"), "{told}");
    }
    assert!(!at.join("o").exists());
}
