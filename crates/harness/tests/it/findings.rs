//! What is found about frames stays with their numbers, and frames that cannot be right end their cells.

use std::path::{Path, PathBuf};

use noisefloor_frame::{Estimate, FeatureId, Finding, FindingKind, Frame, Image, Variance};
use noisefloor_harness::study_of_folder;
use noisefloor_study::MethodRow;
use noisefloor_study::record::Outcome;
use noisefloor_study::summary::Summary;
use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene};

use crate::common::{Place, Watch, records};

fn scene() -> SyntheticScene {
    let law = SampleLaw::Gaussian { sd: 0.5, relative: false };
    SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 40, 30).unwrap().with_guides(Guides::None)
}

/// A folder with one frame of 16 samples, edited, and the exact truth.
fn folder(place: &Place, edit: impl FnOnce(&mut Frame)) -> PathBuf {
    let folder = place.root.path().join("kitchen");
    std::fs::create_dir_all(&folder).unwrap();
    let mut frame = scene().render(16, 2);
    edit(&mut frame);
    noisefloor_io::write_frame(folder.join("spp0016.exr"), &frame).unwrap();
    noisefloor_io::write_reference(folder.join("reference.exr"), &scene().truth()).unwrap();
    folder
}

fn run(place: &Place, folder: &Path) -> Summary {
    let rows = vec![MethodRow::new("mc"), MethodRow::new("blur"), MethodRow::new("judge")];
    place.run(&study_of_folder(folder, None, rows).unwrap(), &Watch::default()).unwrap()
}

fn kinds(findings: &[Finding]) -> Vec<FindingKind> {
    findings.iter().map(|finding| finding.kind).collect()
}

fn edit_variance(frame: &mut Frame, edit: impl FnOnce(&mut Image)) {
    let mut image = frame.color.variance.take().unwrap().into_mean_variance();
    edit(&mut image);
    frame.color.variance = Some(Variance::of_mean(image));
}

#[test]
fn a_sound_folder_gives_no_finding_and_says_its_pixels() {
    let place = Place::new();
    let summary = run(&place, &folder(&place, |_| ()));
    assert_eq!(summary.findings, []);
    assert!(records(&place.out()).iter().all(|r| (r.pixels, r.pixels_of) == (1200, 1200)));
}

#[test]
fn a_variance_that_the_halves_contradict_is_found_in_every_run() {
    let place = Place::new();
    let folder = folder(&place, |frame| edit_variance(frame, |v| *v = v.map(|v| 16.0 * v)));
    for _ in 0..2 {
        let summary = run(&place, &folder);
        assert_eq!(kinds(&summary.findings), [FindingKind::VarianceAgainstHalves]);
        let finding = &summary.findings[0];
        assert_eq!(finding.subject, "kitchen: spp0016.exr");
        assert!(finding.text.contains("variance of one sample"), "{finding}");
        // 1200 ratios of variance at most 2, within five standard errors.
        assert!((16.0 / finding.value.unwrap() - 1.0).abs() < 5.0 * (2.0f64 / 1200.0).sqrt());
    }
    assert!(records(&place.out()).iter().all(|record| record.findings.len() == 1), "all rows of the frame");
    let again = noisefloor_harness::reanalyse(&place.out(), true).unwrap();
    assert_eq!(again.findings.len(), 1);
}

#[test]
fn frames_that_are_drawn_here_are_checked_too() {
    let place = Place::new();
    let summary = place.run(&crate::common::small(), &Watch::default()).unwrap();
    assert_eq!(summary.findings, [], "and are sound");
}

#[test]
fn halves_that_do_not_average_to_the_mean_fail_the_cells_of_their_frame() {
    let place = Place::new();
    let summary = run(
        &place,
        &folder(&place, |frame| {
            frame.color.halves.as_mut().unwrap()[1].data_mut().fill(0.0);
        }),
    );
    assert!(summary.cells.is_empty());
    for record in records(&place.out()) {
        let Outcome::Failed { reason } = &record.outcome else { panic!("{record:?}") };
        assert!(reason.contains("spp0016.exr") && reason.contains("do not average to the mean"), "{reason}");
        assert!(record.metrics.is_empty());
    }
}

#[test]
fn a_frame_without_a_valid_pixel_has_no_numbers() {
    let place = Place::new();
    let summary = run(&place, &folder(&place, |frame| frame.color.mean.data_mut().fill(f32::NAN)));
    assert!(summary.cells.is_empty());
    assert!(records(&place.out()).iter().all(|r| matches!(r.outcome, Outcome::Failed { .. })));
}

#[test]
fn a_reference_without_a_valid_pixel_ends_the_run() {
    let place = Place::new();
    let folder = folder(&place, |_| ());
    let mut truth = scene().truth();
    truth.frame.color.mean.data_mut().fill(f32::NAN);
    noisefloor_io::write_reference(folder.join("reference.exr"), &truth).unwrap();
    let study = study_of_folder(&folder, None, vec![MethodRow::new("mc")]).unwrap();
    let error = place.run(&study, &Watch::default()).unwrap_err().to_string();
    assert!(error.contains("kitchen") && error.contains("no common pixel"), "{error}");
}

#[test]
fn pixels_that_were_not_read_are_in_no_number_of_any_row() {
    let place = Place::new();
    let summary = run(
        &place,
        &folder(&place, |frame| {
            for p in (0..1200).step_by(100) {
                frame.color.mean.plane_mut(0)[p] = f32::NAN;
            }
        }),
    );
    assert_eq!(kinds(&summary.findings), [FindingKind::InvalidPixels]);
    for record in records(&place.out()) {
        assert_eq!((record.pixels, record.pixels_of), (1188, 1200), "{}", record.label);
        assert_eq!((record.non_finite.input_pixels, record.non_finite.output_values), (12, 0));
    }
    let before = records(&place.out());
    noisefloor_harness::reanalyse(&place.out(), true).unwrap();
    assert_eq!(records(&place.out()), before, "the kept images say the same");
}

#[test]
fn unknown_variances_are_in_no_coverage() {
    let place = Place::new();
    // A third of the pixels, one channel each: a ninth of the variances.
    let spoil = |v: &mut Image| v.plane_mut(1).iter_mut().step_by(3).for_each(|v| *v = -1e-9);
    let summary = run(&place, &folder(&place, |frame| edit_variance(frame, spoil)));
    assert_eq!(kinds(&summary.findings), [FindingKind::NegativeVariance]);
    assert_eq!(summary.findings[0].value, Some(400.0));
    let row = summary.coverage.iter().find(|c| c.class == "all" && c.confidence == 0.95).unwrap();
    // 800 pixels of exact normal samples; a binomial standard error of the 2400 values is 0.0045.
    assert!((row.covered.value - 0.95).abs() < 4.0 * 0.0045, "{row:?}");
    assert_eq!(row.missed, 0.0);
}

#[test]
fn a_dropped_variance_is_the_reason_of_a_skipped_row() {
    let place = Place::new();
    let summary =
        run(&place, &folder(&place, |frame| edit_variance(frame, |v| v.data_mut().fill(f32::INFINITY))));
    assert!(kinds(&summary.findings).contains(&FindingKind::VarianceDropped));
    assert_eq!(summary.skipped.len(), 1);
    let reason = &summary.skipped[0].reason;
    assert!(reason.contains("variance of the colour mean") && reason.contains("was dropped"), "{reason}");
    assert!(summary.cells.iter().any(|cell| cell.label == "mc"), "the colour is kept");
}

#[test]
fn layers_that_were_not_used_are_told_once_per_scene() {
    let place = Place::new();
    let folder = folder(&place, |frame| {
        let albedo = Estimate::from_mean(Image::filled(40, 30, 3, 0.5));
        frame.features.insert(FeatureId::Extra("Albedo".into()), albedo);
    });
    let mut second = scene().render(64, 3);
    second.features.insert(FeatureId::Extra("Albedo".into()), Estimate::from_mean(Image::new(40, 30, 3)));
    noisefloor_io::write_frame(folder.join("spp0064.exr"), &second).unwrap();
    for _ in 0..2 {
        let summary = run(&place, &folder);
        let told: Vec<String> = summary.findings.iter().map(Finding::to_string).collect();
        assert_eq!(told, ["kitchen: Albedo: read by no method; did you mean `albedo`?"]);
    }
}
