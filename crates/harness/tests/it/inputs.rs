//! What inputs are found to be, held against each other: refused where headers prove it, told where data show it.

use std::path::Path;

use noisefloor_frame::{Estimate, FindingKind, Frame, Reference, Variance};
use noisefloor_harness::HarnessError;
use noisefloor_harness::study_of_folder;
use noisefloor_study::{MethodRow, Study};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

use crate::common::{Place, Watch, study};

fn scene() -> SyntheticScene {
    let law = SampleLaw::Gaussian { sd: 0.5, relative: true };
    SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 64, 48).unwrap()
}

fn anonymous(mut frame: Frame) -> Frame {
    frame.provenance = Default::default();
    frame
}

fn write(folder: &Path, name: &str, frame: &Frame) {
    std::fs::create_dir_all(folder).unwrap();
    noisefloor_io::write_frame(folder.join(name), frame).unwrap();
}

/// A long frame in 8 parts of 64 samples.
fn reference(folder: &Path) {
    let parts = (0..8).map(|k| scene().render(64, 100 + k).color.mean).collect();
    let reference = Reference::from_parts(parts, 64, noisefloor_frame::Sampling::Independent).unwrap();
    std::fs::create_dir_all(folder).unwrap();
    noisefloor_io::write_reference(folder.join("reference.exr"), &reference).unwrap();
}

fn of_folder(folder: &Path) -> Study {
    study_of_folder(folder, None, vec![MethodRow::new("mc")]).unwrap()
}

#[test]
fn equal_seeds_in_the_headers_are_refused_with_both_files() {
    for (reference_seed, levels) in
        [(7, [(16, 7), (64, 1)]), (9, [(16, 3), (64, 3)]), (9, [(16, 4), (16, 4)])]
    {
        let place = Place::new();
        let folder = place.root.path().join("f");
        write(&folder, "reference.exr", &scene().render(256, reference_seed));
        for (k, (spp, seed)) in levels.into_iter().enumerate() {
            write(&folder, &format!("{k}-spp{spp}.exr"), &scene().render(spp, seed));
        }
        let error = place.run(&of_folder(&folder), &Watch::default()).unwrap_err();
        assert!(matches!(error, HarnessError::SharedSeed { .. }), "{error}");
        let text = error.to_string();
        assert!(text.contains("spp16.exr") && text.contains("seed"), "{text}");
    }
}

#[test]
fn shared_samples_are_the_first_finding_where_headers_say_nothing_and_stay_found() {
    let place = Place::new();
    let folder = place.root.path().join("f");
    write(&folder, "reference.exr", &anonymous(scene().render(256, 7)));
    for spp in [16, 64] {
        write(&folder, &format!("spp{spp}.exr"), &anonymous(scene().render(spp, 7)));
    }
    let study = of_folder(&folder);
    let summary = place.run(&study, &Watch::default()).unwrap();
    let kinds: Vec<FindingKind> = summary.findings.iter().map(|f| f.kind).collect();
    assert_eq!(kinds, [FindingKind::Dependent; 3], "{:?}", summary.findings);
    assert_eq!(summary.findings[0].subject, "f: 16 spp, replicate 0 and 64 spp, replicate 0");
    assert!(summary.findings[1].subject.contains("16 spp"), "{:?}", summary.findings);
    // A second run does nothing and says the same, and so does an analysis alone.
    let again = place.run(&study, &Watch::default()).unwrap();
    assert_eq!(again.findings, summary.findings);
    assert_eq!(noisefloor_harness::reanalyse(&place.out(), false).unwrap().findings, summary.findings);
}

#[test]
fn a_lost_factor_is_told_without_half_buffers_and_equal_replicates_are_told() {
    let place = Place::new();
    let folder = place.root.path().join("f");
    reference(&folder);
    let mut frame = anonymous(scene().render(16, 1));
    frame.color.halves = None;
    let variance = frame.color.variance.take().unwrap().into_mean_variance().map(|v| v * 16.0);
    frame.color.variance = Some(Variance::of_mean(variance));
    write(&folder, "a-spp16.exr", &frame);
    write(&folder, "b-spp16.exr", &frame);
    let found = place.run(&of_folder(&folder), &Watch::default()).unwrap().findings;
    let kinds: Vec<FindingKind> = found.iter().map(|f| f.kind).collect();
    let factor = FindingKind::VarianceAgainstReference;
    assert_eq!(kinds, [FindingKind::EqualData, factor, factor], "{found:?}");
    // v·16/v; 3072 pixels and channels of (x−r)² with relative error √2 each.
    assert!(
        (found[1].value.unwrap() / 16.0 - 1.0).abs() < 5.0 * (2.0f64 / 9216.0).sqrt() + 0.02,
        "{found:?}"
    );
}

#[test]
fn an_interrupted_run_still_holds_all_its_frames_against_each_other() {
    let place = Place::new();
    let folder = place.root.path().join("f");
    reference(&folder);
    write(&folder, "a-spp16.exr", &anonymous(scene().render(16, 1)));
    let first = place.run(&of_folder(&folder), &Watch::default()).unwrap();
    assert!(first.findings.is_empty(), "{:?}", first.findings);
    // The second frame comes later; the first is not read again, because its cells are finished.
    write(&folder, "b-spp64.exr", &anonymous(scene().render(64, 1)));
    let found = place.run(&of_folder(&folder), &Watch::default()).unwrap().findings;
    assert_eq!(found.iter().map(|f| f.kind).collect::<Vec<_>>(), [FindingKind::Dependent], "{found:?}");
}

#[test]
fn another_picture_is_told_with_what_fits() {
    let place = Place::new();
    let folder = place.root.path().join("f");
    let twice = |image: noisefloor_frame::Image| image.map(|v| 2.0 * v);
    let long = scene().render(512, 9);
    let color = Estimate {
        mean: twice(long.color.mean),
        variance: long.color.variance.map(|v| Variance::of_mean(v.into_mean_variance().map(|v| 4.0 * v))),
        halves: long.color.halves.map(|halves| halves.map(twice)),
    };
    write(&folder, "reference.exr", &Frame::from_color(color, long.samples, long.sampling));
    write(&folder, "spp16.exr", &scene().render(16, 1));
    let found = place.run(&of_folder(&folder), &Watch::default()).unwrap().findings;
    assert_eq!(found[0].kind, FindingKind::DifferentPicture, "{found:?}");
    let text = found[0].to_string();
    assert!(text.contains("ratio 0.50; fits after exposure −1 stop"), "{text}");
}

#[test]
fn rendered_and_synthetic_scenes_are_silent() {
    let place = Place::new();
    let study = study(
        r#"
name = "sound"
spp = [4, 16]
replicates = 2
width = 48
height = 36
reference = { spp = 512 }
timing = { warmup = 0, runs = 1 }
[[scene]]
id = "cornell"
[[scene]]
id = "drawn"
synthetic = { image = "mixed", law = "exponential", width = 48, height = 36 }
[[method]]
id = "mc"
"#,
    );
    let summary = place.run(&study, &Watch::default()).unwrap();
    assert!(summary.findings.is_empty(), "{:?}", summary.findings);
}
