//! Frames of another program, from a folder.

use std::path::Path;

use noisefloor_frame::{Estimate, Frame, Reference, Sampling};
use noisefloor_harness::HarnessError;
use noisefloor_harness::study_of_folder;
use noisefloor_study::summary::Source;
use noisefloor_study::{MethodRow, Study};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

use crate::common::{Place, Watch, records};

fn scene() -> SyntheticScene {
    let law = SampleLaw::Gaussian { sd: 0.5, relative: false };
    SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 96, 64).unwrap()
}

/// Frames at two levels, and a reference with a variance and no halves.
fn write(folder: &Path) {
    std::fs::create_dir_all(folder).unwrap();
    for (spp, seed) in [(4, 1), (16, 2)] {
        let frame = scene().render(spp, seed);
        noisefloor_io::write_frame(folder.join(format!("spp{spp:04}.exr")), &frame).unwrap();
    }
    let long = scene().render(1024, 3);
    let color = Estimate { halves: None, ..long.color };
    let frame = Frame::from_color(color, long.samples, Sampling::LowDiscrepancy);
    noisefloor_io::write_reference(folder.join("reference.exr"), &Reference { frame, parts: Vec::new() })
        .unwrap();
}

fn rows() -> Vec<MethodRow> {
    vec![
        MethodRow::new("mc"),
        MethodRow::new("blur"),
        MethodRow::new("blur").set("radius", 2).label("blur radius=2"),
        MethodRow::new("guarded(blur)"),
    ]
}

#[test]
fn a_folder_of_frames_is_a_study_with_intervals_from_within_the_image() {
    let place = Place::new();
    let folder = place.root.path().join("kitchen");
    write(&folder);
    let study = study_of_folder(&folder, None, rows()).unwrap();
    assert_eq!((study.name.as_str(), study.spp.as_slice()), ("kitchen", &[4, 16][..]));
    let summary = place.run(&study, &Watch::default()).unwrap();
    assert_eq!(summary.cells.len(), 8);
    let reference = &summary.scenes[0].reference;
    assert!(
        reference.correction.contains("variance of the reference subtracted"),
        "{}",
        reference.correction
    );
    assert_eq!((reference.spp, reference.ratio_to_top, reference.long_enough), (1024, 64.0, true));
    for cell in &summary.cells {
        for metric in ["mse", "relmse", "ssim"] {
            let interval = &cell.metrics[metric];
            assert_eq!(interval.source, Source::WithinImage, "{} {metric}", cell.label);
            assert!(interval.low.unwrap() < interval.value && interval.value < interval.high.unwrap());
        }
        if cell.label != "mc" {
            assert_eq!(cell.ratio_to_mc["mse"].source, Source::WithinImage);
        }
    }
    let wide = summary.coverage.iter().filter(|c| c.class == "all");
    for row in wide {
        assert_eq!(row.covered.source, Source::WithinImage);
        // 96×64 pixels of exact normal samples.
        assert!((row.covered.value - row.confidence).abs() < 0.02, "{row:?}");
    }
    assert!(
        summary.warnings.iter().any(|w| w.to_string().contains("one replicate per level")),
        "{:?}",
        summary.warnings
    );
    assert!(summary.comparisons.iter().all(|c| c.pairs.iter().all(|p| !p.distinguishable)));
    assert_eq!(summary.scenes[0].classes.keys().collect::<Vec<_>>(), ["edge", "flat"]);

    // Everything is kept: running again does nothing, and metrics come out of the images as before.
    let before = records(&place.out());
    let watch = Watch::default();
    place.run(&study, &watch).unwrap();
    assert_eq!(watch.cells(), 0);
    noisefloor_harness::reanalyse(&place.out(), true).unwrap();
    assert_eq!(records(&place.out()), before);
}

#[test]
fn a_folder_of_folders_is_a_study_of_several_scenes() {
    let place = Place::new();
    let folder = place.root.path().join("frames");
    write(&folder.join("kitchen"));
    write(&folder.join("garden"));
    let study = study_of_folder(&folder, None, rows()).unwrap();
    let ids: Vec<&str> = study.scenes.iter().map(|s| s.id.as_str()).collect();
    assert_eq!(ids, ["garden", "kitchen"]);
}

#[test]
fn a_study_file_finds_folders_relative_to_itself_and_may_choose_levels() {
    let place = Place::new();
    write(&place.root.path().join("frames/kitchen"));
    let text = |spp: &str| {
        format!(
            "name = \"mine\"\n[[scene]]\nid = \"k\"\nfolder = \"frames/kitchen\"\n{spp}\n[[method]]\nid = \"mc\"\n"
        )
    };
    let file = place.root.path().join("mine.toml");
    std::fs::write(&file, text("spp = [16]")).unwrap();
    let summary = place.run(&Study::from_file(&file).unwrap(), &Watch::default()).unwrap();
    assert_eq!(summary.study.spp, [16]);
    std::fs::write(&file, text("spp = [16, 64]")).unwrap();
    let error = place.run(&Study::from_file(&file).unwrap(), &Watch::default()).unwrap_err().to_string();
    assert!(error.contains("no frame of 64 samples per pixel"), "{error}");
    std::fs::write(&file, text("").replace("frames/", "")).unwrap();
    let error = Study::from_file(&file).unwrap_err().to_string();
    assert!(error.contains("mine.toml, line 2") && error.contains("a folder that exists"), "{error}");
}

#[test]
fn an_empty_or_missing_folder_is_an_error_that_names_it() {
    let place = Place::new();
    for name in ["absent", "empty"] {
        let folder = place.root.path().join(name);
        if name == "empty" {
            std::fs::create_dir(&folder).unwrap();
        }
        let error = study_of_folder(&folder, None, rows()).unwrap_err();
        assert!(matches!(error, HarnessError::Image(_)) && error.to_string().contains(name), "{error}");
    }
}
