//! What `denoise` says about the frame that it is given, and what it refuses.

use std::path::Path;
use std::process::{Command, Output};

use noisefloor::io::{read_color, write_frame};
use noisefloor::{Estimate, FeatureId, Frame, Image, Samples, Sampling, Variance};
use noisefloor_kernels::InstructionSet;
use serde_json::Value;

const SIZE: (usize, usize) = (40, 30);

/// Independent samples around a picture, eight in each half.
fn sound() -> Frame {
    drawn(7, 16)
}

fn drawn(seed: u64, count: usize) -> Frame {
    let mut state = seed;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as f64 + 0.5) / (1u64 << 31) as f64
    };
    let blank = Image::new(SIZE.0, SIZE.1, 3);
    let mut planes = [blank.clone(), blank.clone(), blank.clone(), blank];
    for i in 0..planes[0].data().len() {
        let samples: Vec<f64> = (0..count).map(|_| (1.0 + (i % 7) as f64) * -uniform().ln()).collect();
        let half = |first: usize| samples.iter().skip(first).step_by(2).sum::<f64>() / (count / 2) as f64;
        let (a, b) = (half(0), half(1));
        let all = 0.5 * (a + b);
        let variance = samples.iter().map(|x| (x - all).powi(2)).sum::<f64>() / ((count - 1) * count) as f64;
        for (plane, value) in planes.iter_mut().zip([all, variance, a, b]) {
            plane.data_mut()[i] = value as f32;
        }
    }
    let [mean, variance, a, b] = planes;
    let color = Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: Some([a, b]) };
    let mut frame = Frame::from_color(color, Samples::uniform(count as u32), Sampling::Independent);
    let flat = |channels: usize| Estimate::from_mean(Image::filled(SIZE.0, SIZE.1, channels, 0.5));
    for (id, channels) in [(FeatureId::Albedo, 3), (FeatureId::Normal, 3), (FeatureId::Depth, 1)] {
        frame.features.insert(id, flat(channels));
    }
    frame
}

fn edit_variance(frame: &mut Frame, edit: impl FnOnce(&mut Image)) {
    let mut image = frame.color.variance.take().unwrap().into_mean_variance();
    edit(&mut image);
    frame.color.variance = Some(Variance::of_mean(image));
}

struct Place(tempfile::TempDir);

impl Place {
    fn with(frame: &Frame) -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        write_frame(place.at("f.exr"), frame).unwrap();
        place
    }

    fn at(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    fn denoise(&self, method: &str, more: &[&str]) -> Output {
        let args = ["denoise", "f.exr", "--method", method, "-o", "out.exr"];
        command(self.0.path(), &[&args[..], more].concat())
    }

    fn image(&self) -> Image {
        read_color(self.at("out.exr")).unwrap()
    }
}

fn command(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_noisefloor")).args(args).current_dir(folder).output().unwrap()
}

#[track_caller]
fn done(output: &Output) -> String {
    let errors = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(output.status.success(), "{errors}");
    errors
}

#[track_caller]
fn refused(output: &Output) -> String {
    assert!(!output.status.success());
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn a_sound_frame_is_denoised_without_a_word() {
    let place = Place::with(&sound());
    assert_eq!(done(&place.denoise("rdfc", &[])), "");
    let json: Value = serde_json::from_slice(&place.denoise("mc", &["--json"]).stdout).unwrap();
    assert_eq!(json["findings"], Value::Array(Vec::new()));
}

#[test]
fn every_instruction_set_gives_the_same_image() {
    let place = Place::with(&sound());
    for method in ["rdfc", "geometric-corrected"] {
        done(&place.denoise(method, &[]));
        let best = place.image();
        assert_ne!(best, sound().color.mean);
        for level in InstructionSet::ALL {
            let output = place.denoise(method, &["--instruction-set", level.name()]);
            if level.is_available() {
                done(&output);
                assert_eq!(place.image(), best, "{method} with {level}");
            } else {
                assert!(refused(&output).contains("does not have the instruction set"));
            }
        }
    }
    assert!(
        refused(&place.denoise("mc", &["--instruction-set", "sse"])).contains("portable, avx2 and avx512")
    );
}

#[test]
fn every_finding_is_a_line_of_text_and_a_record() {
    let mut frame = sound();
    edit_variance(&mut frame, |v| v.data_mut()[..576].fill(-1e-9));
    frame.features.get_mut(&FeatureId::Albedo).unwrap().mean.data_mut().fill(f32::NAN);
    let place = Place::with(&frame);
    let told = done(&place.denoise("mc", &[]));
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines.len(), 2, "{told}");
    assert!(lines[0].contains("f.exr: 576 of 3600 variances are unknown (576 are negative"), "{told}");
    assert!(lines[1].contains("f.exr: albedo: no value is finite"), "{told}");
    let json: Value = serde_json::from_slice(&place.denoise("mc", &["--json"]).stdout).unwrap();
    assert_eq!(json["findings"][0]["kind"], "negative-variance");
    assert_eq!(json["findings"][0]["value"], 576.0);
    assert_eq!(json["findings"][1]["kind"], "invalid-feature");
}

#[test]
fn contradictory_buffers_are_refused() {
    let mut doubled = sound();
    doubled.color.halves.as_mut().unwrap().iter_mut().for_each(|half| *half = half.map(|v| 2.0 * v));
    let mut black_half = sound();
    black_half.color.halves.as_mut().unwrap()[1].data_mut().fill(0.0);
    let mut black = sound();
    black.color.mean.data_mut().fill(0.0);
    for frame in [doubled, black_half, black] {
        let place = Place::with(&frame);
        let told = refused(&place.denoise("rdfc", &[]));
        assert!(told.contains("halves do not average to the mean"), "{told}");
        assert!(!told.contains("twice") && !place.at("out.exr").exists());
    }
}

#[test]
fn an_overflowed_variance_costs_the_variance_and_not_the_colour() {
    let mut frame = sound();
    let half = |v: f32| f32::from_bits((v.to_bits() + 0x1000) & !0x1FFF);
    frame.color.mean = frame.color.mean.map(half);
    edit_variance(&mut frame, |v| v.data_mut().fill(f32::INFINITY));
    let place = Place::with(&frame);
    assert!(done(&place.denoise("mc", &[])).contains("overflowed half precision"));
    assert_eq!(place.image(), frame.color.mean, "what was read");
    let told = refused(&place.denoise("rdfc", &[]));
    assert!(told.contains("needs variance of the colour mean"), "{told}");
    assert!(
        told.contains("the variance was dropped") && told.contains("overflowed half precision"),
        "{told}"
    );
}

#[test]
fn plain_monte_carlo_gives_back_what_was_read() {
    let mut frame = sound();
    frame.color.mean.set(1, 4, 4, f32::NAN);
    frame.color.halves.as_mut().unwrap()[0].set(2, 9, 9, f32::NAN);
    let place = Place::with(&frame);
    done(&place.denoise("mc", &[]));
    let bits = |image: &Image| -> Vec<u32> { image.data().iter().map(|v| v.to_bits()).collect() };
    assert_eq!(bits(&place.image()), bits(&frame.color.mean));
    done(&place.denoise("rdfc", &[]));
    assert_eq!(place.image().count_non_finite(), 0, "a small hole is filled");
    frame.color.mean.plane_mut(0)[..600].fill(f32::NAN);
    let place = Place::with(&frame);
    assert!(done(&place.denoise("rdfc", &[])).contains("no part of the image"));
    assert_eq!(place.image().count_non_finite(), 3 * 600, "half an image is not made up");
    frame.color.mean.data_mut().fill(f32::NAN);
    assert!(refused(&Place::with(&frame).denoise("mc", &[])).contains("there is no image"));
}

#[test]
fn a_refusal_names_the_way_out() {
    let place = Place::with(&sound());
    let told = refused(&place.denoise("virtual-flash", &[]));
    assert!(told.contains("virtual flash image") && told.contains("or --set guide=color"), "{told}");
    done(&place.denoise("virtual-flash", &["--set", "guide=color"]));
    let told = refused(&place.denoise("guarded(geometric-corrected)", &["--set", "material=ids"]));
    assert!(told.contains("feature `material`, or --set material=albedo"), "{told}");
    done(&place.denoise("geometric-corrected", &[]));
}

#[test]
fn a_feature_under_another_name_is_pointed_out_and_a_name_that_fits_nothing_is_an_error() {
    let place = Place::with(&sound());
    let told = refused(&place.denoise("rdfc", &["--set", "features=[\"Albedo\"]"]));
    assert!(told.contains("no feature `Albedo`; nearest: albedo"), "{told}");
    let mut frame = sound();
    let albedo = frame.features.remove(&FeatureId::Albedo).unwrap();
    frame.features.insert(FeatureId::Extra("Albedo".into()), albedo);
    let place = Place::with(&frame);
    let told = done(&place.denoise("rdfc", &[]));
    assert!(told.contains("Albedo: read by no method; did you mean `albedo`?"), "{told}");
    assert_eq!(done(&place.denoise("rdfc", &["--set", "features=[\"Albedo\"]"])), "", "it is there");
}

#[test]
fn a_study_that_names_a_feature_which_fits_nothing_is_refused_before_work() {
    let place = Place::with(&sound());
    let study = |features: &str| {
        let text = format!(
            "name = \"tiny\"\nspp = [4]\ntiming = {{ warmup = 0, runs = 1 }}\n[[scene]]\nid = \"ramp\"\n\
             synthetic = {{ image = \"ramps\", law = \"gaussian\", width = 16, height = 12 }}\n\
             [[method]]\nid = \"rdfc\"\nset = {{ features = [{features}] }}\n"
        );
        std::fs::write(place.at("study.toml"), text).unwrap();
        command(place.0.path(), &["run", "study.toml", "-q", "--out", "results", "--cache", "cache"])
    };
    let told = refused(&study("\"Albedo\""));
    assert!(told.contains("`Albedo`") && told.contains("nearest: albedo"), "{told}");
    assert!(!place.at("results").exists(), "before any work");
    done(&study("\"albedo\""));
}

#[test]
fn a_reference_that_contradicts_itself_or_has_no_number_is_refused() {
    let place = Place::with(&sound());
    let compare = |frame: &Frame| {
        write_frame(place.at("r.exr"), frame).unwrap();
        command(place.0.path(), &["compare", "f.exr", "r.exr"])
    };
    let mut nan = sound();
    nan.color.mean.data_mut().fill(f32::NAN);
    assert!(refused(&compare(&nan)).contains("no common pixel"));
    let mut black_half = sound();
    black_half.color.halves.as_mut().unwrap()[0].data_mut().fill(0.0);
    assert!(refused(&compare(&black_half)).contains("halves do not average to the mean"));
}

/// Two replicates and a reference with noise of their own.
fn study_of(first: &Frame) -> Place {
    let place = Place(tempfile::tempdir().unwrap());
    std::fs::create_dir(place.at("frames")).unwrap();
    write_frame(place.at("frames/spp0016_0.exr"), first).unwrap();
    write_frame(place.at("frames/spp0016_1.exr"), &drawn(8, 16)).unwrap();
    write_frame(place.at("frames/reference.exr"), &drawn(9, 1024)).unwrap();
    place
}

#[test]
fn a_frame_that_contradicts_itself_is_told_once_and_leaves_the_others_ranked() {
    let mut doubled = sound();
    doubled.color.halves.as_mut().unwrap().iter_mut().for_each(|half| *half = half.map(|v| 2.0 * v));
    let place = study_of(&doubled);
    for quiet in [&[][..], &["-q"]] {
        let run = [&["run", "frames", "--out", "results", "--cache", "cache"], quiet].concat();
        let output = command(place.0.path(), &run);
        assert_eq!(output.status.code(), Some(3), "cells failed");
        let errors = String::from_utf8(output.stderr).unwrap();
        let told = errors.lines().filter(|line| line.contains("rows failed")).count();
        assert_eq!(told, 1, "{errors}");
        let table = String::from_utf8(output.stdout).unwrap();
        let cause = "spp0016_0.exr: `color`: its halves do not average to the mean";
        assert_eq!(table.matches(cause).count(), usize::from(quiet.is_empty()), "{table}");
        assert!(errors.contains(cause) && !table.contains("not ranked"), "{errors}{table}");
    }
    let summary: Value =
        serde_json::from_str(&std::fs::read_to_string(place.at("results/summary.json")).unwrap()).unwrap();
    assert_eq!(summary["findings"][0]["kind"], "refused-frame");
    assert_eq!(summary["findings"].as_array().unwrap().len(), 1, "one frame, told once");
    for cell in summary["cells"].as_array().unwrap() {
        assert_eq!((&cell["replicates"], &cell["left_out"]), (&Value::from(1), &Value::Null));
    }
    assert_eq!(done(&command(study_of(&drawn(3, 16)).0.path(), &["run", "frames", "-q"])), "");
}
