//! Files are the user's: what an output may be, what is refused before any work, and pictures to look at.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::{FileTypeExt as _, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use noisefloor::io::{ReadOptions, read_color, read_frame};

fn noisefloor(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_noisefloor")).args(args).current_dir(folder).output().unwrap()
}

fn done(folder: &Path, args: &[&str]) -> String {
    let output = noisefloor(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Refused as wrong usage: nothing printed, no file made or changed.
fn refused(folder: &Path, args: &[&str]) -> String {
    let before = contents(folder);
    let output = noisefloor(folder, args);
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{args:?}: {told}");
    assert!(output.stdout.is_empty(), "{args:?} printed a result");
    assert!(contents(folder) == before, "{args:?} changed files");
    told
}

fn contents(folder: &Path) -> Vec<(String, Option<Vec<u8>>)> {
    let mut all: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| {
            let entry = entry.unwrap();
            let plain = fs::metadata(entry.path()).is_ok_and(|found| found.is_file());
            (entry.file_name().into_string().unwrap(), plain.then(|| fs::read(entry.path()).unwrap()))
        })
        .collect();
    all.sort();
    all
}

fn rendered() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    done(folder.path(), &["render", "cornell", "--spp", "4", "--size", "16x12", "-o", "f.exr"]);
    folder
}

const DENOISE: [&str; 5] = ["denoise", "f.exr", "-m", "mc", "-o"];

#[test]
fn a_fifo_and_standard_output_get_the_image_and_messages_do_not_mix_with_it() {
    let folder = rendered();
    let at = folder.path();
    assert!(Command::new("mkfifo").arg("pipe").current_dir(at).status().unwrap().success());
    let reader = Command::new("cat").arg("pipe").current_dir(at).stdout(Stdio::piped()).spawn().unwrap();
    let told = done(at, &[&DENOISE[..], &["pipe"]].concat());
    assert!(told.contains("wrote pipe"), "{told}");
    let through_pipe = reader.wait_with_output().unwrap().stdout;
    assert!(fs::symlink_metadata(at.join("pipe")).unwrap().file_type().is_fifo());

    let output = noisefloor(at, &[&DENOISE[..], &["-"]].concat());
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && told.contains("wrote standard output"), "{told}");
    assert_eq!(output.stdout, through_pipe, "equal bytes on every way");
    assert!(!at.join("-").exists());
    // Another name of the same.
    let output = noisefloor(at, &[&DENOISE[..], &["/dev/stdout"]].concat());
    assert!(output.status.success());
    assert_eq!(output.stdout, through_pipe);
    // JSON steps aside, too.
    let output = noisefloor(at, &[&DENOISE[..], &["-", "--json"]].concat());
    assert_eq!(output.stdout, through_pipe);
    assert!(serde_json::from_slice::<serde_json::Value>(&output.stderr).is_ok());

    let output = noisefloor(at, &["render", "cornell", "--spp", "2", "--size", "8x8", "-o", "-"]);
    fs::write(at.join("r.exr"), output.stdout).unwrap();
    assert_eq!(read_frame(at.join("r.exr"), &ReadOptions::default()).unwrap().width(), 8);
}

#[test]
fn a_link_is_kept_and_what_it_leads_to_is_replaced() {
    let folder = rendered();
    let at = folder.path();
    done(at, &[&DENOISE[..], &["target.exr"]].concat());
    let expected = fs::read(at.join("target.exr")).unwrap();
    fs::write(at.join("target.exr"), b"old").unwrap();
    symlink("target.exr", at.join("link.exr")).unwrap();
    done(at, &[&DENOISE[..], &["link.exr"]].concat());
    assert!(fs::symlink_metadata(at.join("link.exr")).unwrap().is_symlink());
    assert_eq!(fs::read(at.join("target.exr")).unwrap(), expected);
}

#[test]
fn an_output_that_is_an_input_is_refused_under_every_name() {
    let folder = rendered();
    let at = folder.path();
    fs::hard_link(at.join("f.exr"), at.join("hard.exr")).unwrap();
    symlink("f.exr", at.join("soft.exr")).unwrap();
    for name in ["f.exr", "./f.exr", "hard.exr", "soft.exr"] {
        let told = refused(at, &[&DENOISE[..], &[name]].concat());
        assert!(told.contains("same file"), "{told}");
        refused(at, &["convert", "f.exr", name]);
    }
    // A picture over its own input, by a hard link.
    fs::hard_link(at.join("f.exr"), at.join("f.png")).unwrap();
    refused(at, &["convert", "f.exr", "f.png"]);
    // Diagnostics have names of their own, which must not be the input's either.
    fs::rename(at.join("f.exr"), at.join("out.step-1.exr")).unwrap();
    let told = refused(at, &["denoise", "out.step-1.exr", "-m", "rdfc", "--diagnostics", "-o", "out.exr"]);
    assert!(told.contains("--diagnostics"), "{told}");
    // The sky of a scene, and one frame of a sequence of outputs.
    fs::rename(at.join("out.step-1.exr"), at.join("s.0001.exr")).unwrap();
    let render = ["render", "outdoor", "--spp", "2", "--size", "8x8", "--environment", "s.0001.exr", "-o"];
    refused(at, &[&render[..], &["s.0001.exr"]].concat());
    refused(at, &[&render[..], &["s.exr", "--frames", "3"]].concat());
    // Maps of the error.
    fs::hard_link(at.join("s.0001.exr"), at.join("a.error.png")).unwrap();
    fs::copy(at.join("s.0001.exr"), at.join("a.exr")).unwrap();
    let told = refused(at, &["compare", "a.exr", "s.0001.exr", "--maps", "."]);
    assert!(told.contains("a.error.png"), "{told}");
}

#[test]
fn the_image_of_a_gltf_scene_is_an_input_too() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let corners = [[-9.0f32, -9.0, 0.0], [9.0, -9.0, 0.0], [0.0, 9.0, 0.0]];
    let bytes: Vec<u8> = corners.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
    fs::write(at.join("one.bin"), bytes).unwrap();
    fs::write(at.join("bark.png"), b"whatever").unwrap();
    let text = r#"{
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "images": [{"uri": "bark.png"}],
        "buffers": [{"uri": "one.bin", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [-9, -9, 0], "max": [9, 9, 0]}]
    }"#;
    fs::write(at.join("one.gltf"), text).unwrap();
    let render = ["render", "one.gltf", "--spp", "1", "--size", "8x8", "-o"];
    let output = noisefloor(at, &[&render[..], &["bark.png"]].concat());
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read(at.join("bark.png")).unwrap(), b"whatever");
    symlink("one.bin", at.join("one.exr")).unwrap();
    assert!(!noisefloor(at, &[&render[..], &["one.exr"]].concat()).status.success());
    assert_eq!(fs::read(at.join("one.bin")).unwrap().len(), 36);
}

#[test]
fn a_name_of_another_kind_of_file_is_refused_with_the_kinds_that_there_are() {
    let folder = rendered();
    let at = folder.path();
    for name in ["x", "x.jpg", "x.exr.gz", "x.tif"] {
        let told = refused(at, &[&DENOISE[..], &[name]].concat());
        assert!(told.contains(".exr") && told.contains(".png"), "{told}");
        refused(at, &["render", "cornell", "--spp", "1", "--size", "8x8", "-o", name]);
        refused(at, &["convert", "f.exr", name]);
    }
    refused(at, &["scenes", "--sheet", "x.exr"]);
    refused(at, &[&DENOISE[..], &["x.exr", "--exposure", "1"]].concat());
    // Several files need a file name.
    refused(at, &[&DENOISE[..], &["-", "--diagnostics"]].concat());
    refused(at, &["render", "cornell", "--spp", "1", "--size", "8x8", "--frames", "2", "-o", "-"]);
    assert!(Command::new("mkfifo").arg("p.exr").current_dir(at).status().unwrap().success());
    refused(at, &[&DENOISE[..], &["p.exr", "--diagnostics"]].concat());
    refused(at, &["render", "cornell", "--spp", "1", "--size", "8x8", "--frames", "2", "-o", "p.exr"]);
}

#[test]
fn what_cannot_be_written_is_told_before_the_work_and_without_temporary_names() {
    let folder = rendered();
    let at = folder.path();
    fs::create_dir(at.join("d.exr")).unwrap();
    for name in ["d.exr", "no/such/x.exr", "f.exr/x.exr"] {
        // So many samples that the test would never end if they were taken first.
        let args = ["render", "cornell", "--spp", "1000000", "--size", "64x64", "-o", name];
        let output = noisefloor(at, &args);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{told}");
        assert!(told.contains(name) && !told.contains(".tmp"), "{told}");
    }
}

#[test]
fn pictures_are_png_and_say_their_exposure() {
    let folder = rendered();
    let at = folder.path();
    let pixel = |name: &str| -> Vec<u8> {
        let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(at.join(name)).unwrap()))
            .read_info()
            .unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        data
    };
    let told = done(at, &["convert", "f.exr", "f.png"]);
    assert!(told.contains("exposure +0 stops") && told.contains("sRGB"), "{told}");
    let told = done(at, &["convert", "f.exr", "dark.png", "--exposure", "-2.5"]);
    assert!(told.contains("exposure -2.5 stops"), "{told}");
    let sum = |name: &str| pixel(name).iter().map(|v| u64::from(*v)).sum::<u64>();
    assert!(sum("dark.png") < sum("f.png"));
    done(at, &[&DENOISE[..], &["d.png", "--exposure", "1"]].concat());
    done(at, &["convert", "f.exr", "bright.png", "--exposure", "1"]);
    assert_eq!(pixel("d.png"), pixel("bright.png"), "plain Monte Carlo is the frame itself");
    let told = done(at, &["render", "cornell", "--spp", "4", "--size", "16x12", "-o", "r.png"]);
    assert!(told.contains("picture"), "{told}");
    assert_eq!(pixel("r.png"), pixel("f.png"), "one frame, one picture");

    // Pixels that are not finite are seen and counted; the colour alone goes from OpenEXR to OpenEXR.
    let mut image = read_color(at.join("f.exr")).unwrap();
    image.set(1, 3, 2, f32::NAN);
    noisefloor::io::write_image(at.join("nan.exr"), &image, &Default::default()).unwrap();
    let told = done(at, &["convert", "nan.exr", "nan.png"]);
    assert!(told.contains("1 pixel not finite (magenta)"), "{told}");
    assert_eq!(pixel("nan.png")[3 * (2 * 16 + 3)..][..3], [255, 0, 255]);
    done(at, &["convert", "f.exr", "color.exr"]);
    assert_eq!(read_color(at.join("color.exr")).unwrap(), read_color(at.join("f.exr")).unwrap());
    assert!(
        fs::metadata(at.join("color.exr")).unwrap().len() < fs::metadata(at.join("f.exr")).unwrap().len()
    );
}

#[test]
fn results_of_a_study_do_not_go_into_the_folder_of_its_frames() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::create_dir(at.join("frames")).unwrap();
    done(at, &["render", "cornell", "--spp", "4", "--size", "8x8", "-o", "frames/spp0004.exr"]);
    done(
        at,
        &["render", "cornell", "--spp", "16", "--parts", "8", "--size", "8x8", "-o", "frames/reference.exr"],
    );
    let told = refused(at, &["run", "frames", "--out", "./frames", "--cache", "cache"]);
    assert!(told.contains("folder of the frames"), "{told}");
}

#[test]
fn a_file_that_a_study_locks_by_is_not_emptied() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let study = "name = \"tiny\"\nspp = [4]\nwidth = 8\nheight = 6\ntiming = { warmup = 0, runs = 1 }\n\
        [[scene]]\nid = \"ramp\"\nsynthetic = { image = \"ramps\", law = \"gaussian\", width = 8, height = 6 }\n\
        [[method]]\nid = \"mc\"\n";
    fs::write(at.join("study.toml"), study).unwrap();
    fs::write(at.join("notes"), "mine").unwrap();
    fs::create_dir(at.join("results")).unwrap();
    symlink("../notes", at.join("results/.lock")).unwrap();
    done(at, &["run", "study.toml", "--quiet", "--out", "results", "--cache", "cache"]);
    assert_eq!(fs::read_to_string(at.join("notes")).unwrap(), "mine");
}

#[test]
fn several_images_stand_beside_each_other_over_counted_pixels_with_maps_of_their_errors() {
    let folder = rendered();
    let at = folder.path();
    let reference = ["render", "cornell", "--spp", "64", "--parts", "8", "--size", "16x12", "-o", "r.exr"];
    done(at, &reference);
    let mut image = read_color(at.join("f.exr")).unwrap();
    image.set(0, 0, 0, f32::NAN);
    fs::create_dir(at.join("other")).unwrap();
    noisefloor::io::write_image(at.join("other/f.exr"), &image, &Default::default()).unwrap();
    let compare = ["compare", "f.exr", "other/f.exr", "r.exr"];
    let told = done(at, &[&compare[..], &["--maps", "maps"]].concat());
    for words in ["192 of 192", "191 of 192", "different pixels", "1 value is not finite", "bias of relmse"] {
        assert!(told.contains(words), "{words}: {told}");
    }
    assert!(told.contains("viridis from 0 to") && told.contains("1 pixel not finite (magenta)"), "{told}");
    for map in ["maps/f.error.png", "maps/f-2.error.png"] {
        assert!(fs::read(at.join(map)).unwrap().starts_with(b"\x89PNG"), "{map}");
    }
    let json: serde_json::Value =
        serde_json::from_str(&done(at, &[&compare[..], &["--json"]].concat())).unwrap();
    let pixels: Vec<u64> =
        json.as_array().unwrap().iter().map(|one| one["pixels"]["mse"].as_u64().unwrap()).collect();
    assert_eq!(pixels, [192, 191]);
    // One image is one object, and has the same numbers.
    let one: serde_json::Value =
        serde_json::from_str(&done(at, &["compare", "f.exr", "r.exr", "--json"])).unwrap();
    assert_eq!(one, json[0]);
    assert!(one["reference_bias_removed"]["relmse"].is_f64() && one["bias_correction"].is_string(), "{one}");
}
