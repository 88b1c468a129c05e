//! An analysis says how far its study got, and ranks only what can be compared.

use std::path::Path;

use crate::common::{Place, Watch, records, small, study};
use noisefloor_frame::{Estimate, Frame};
use noisefloor_harness::analysis_of;
use noisefloor_harness::study_of_folder;
use noisefloor_study::summary::Summary;
use noisefloor_study::{MethodRow, Study};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

const TWO_SCENES: &str = r#"
name = "two"
spp = [4, 16]
replicates = 2
timing = { warmup = 0, runs = 1 }
metrics = ["mse", "rmse", "relmse", "psnr", "energy"]
[[scene]]
id = "steps"
synthetic = { image = "edges", law = "gaussian", sd = 0.5, width = 24, height = 16 }
[[scene]]
id = "ramp"
synthetic = { image = "ramps", law = "gaussian", sd = 0.5, width = 24, height = 16 }
[[method]]
id = "mc"
[[method]]
id = "blur"
"#;

fn stopped(place: &Place, study: &Study, cells: usize) -> Summary {
    assert!(place.run(study, &Watch::stopping_after(cells)).unwrap_err().is_cancelled());
    analysis_of(&place.out()).unwrap()
}

#[test]
fn a_stopped_study_says_what_is_missing() {
    let place = Place::new();
    let summary = stopped(&place, &study(TWO_SCENES), 5);
    let progress = summary.progress.unwrap();
    assert_eq!((progress.planned, progress.finished, progress.complete()), (16, 5, false));
    let told: Vec<String> = progress.missing.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "steps at 16 spp, blur (2 cells)",
            "steps at 16 spp, mc, replicate 2 (1 cell)",
            "all of scene ramp (8 cells)"
        ]
    );
    assert!(progress.complete_at("steps", 4) && !progress.complete_at("steps", 16));
    assert!(!progress.complete_at("ramp", 4));
    place.run(&study(TWO_SCENES), &Watch::default()).unwrap();
    let whole = analysis_of(&place.out()).unwrap().progress.unwrap();
    assert!(whole.complete() && whole.missing.is_empty(), "{whole}");
}

#[test]
fn rows_of_a_stopped_level_are_compared_over_the_replicates_that_all_have() {
    let place = Place::new();
    // At 16 spp plain Monte Carlo has both replicates, the filter one.
    let summary = stopped(&place, &small(), 7);
    let cell = |label: &str| summary.cells.iter().find(|c| c.spp == 16 && c.label == label).unwrap();
    for label in ["mc", "blur"] {
        assert_eq!((cell(label).replicates, cell(label).planned_replicates), (1, 2), "{label}");
        assert_eq!(cell(label).left_out, None);
    }
    let first = &records(&place.out())[4];
    assert_eq!((first.spp, first.label.as_str(), first.replicate), (16, "mc", 0));
    assert_eq!(Some(cell("mc").metrics["mse"].value), first.metrics["mse"]);
    assert_eq!(cell("mc").metrics["mse"].n, 1);
}

/// Frames of one level, the second noisier and without halves.
fn mixed_folder(folder: &Path) {
    std::fs::create_dir_all(folder).unwrap();
    let scene = |sd: f64| {
        let law = SampleLaw::Gaussian { sd, relative: false };
        SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 48, 32).unwrap()
    };
    let quiet = scene(0.2).render(16, 1);
    let loud = scene(2.0).render(16, 2);
    let loud = Frame { color: Estimate { halves: None, ..loud.color.clone() }, ..loud };
    noisefloor_io::write_frame(folder.join("spp0016-a.exr"), &quiet).unwrap();
    noisefloor_io::write_frame(folder.join("spp0016-b.exr"), &loud).unwrap();
    noisefloor_io::write_reference(folder.join("reference.exr"), &scene(0.2).truth()).unwrap();
}

#[test]
fn a_row_that_was_skipped_on_the_noisier_frame_is_never_the_best() {
    let place = Place::new();
    let folder = place.root.path().join("mixed");
    mixed_folder(&folder);
    let rows = vec![
        MethodRow::new("mc"),
        MethodRow::new("blur").label("wide").set("radius", 2),
        MethodRow::new("blur").label("choosy").set("halves", true),
    ];
    let summary = place.run(&study_of_folder(&folder, None, rows).unwrap(), &Watch::default()).unwrap();
    let cell = |label: &str| summary.cells.iter().find(|c| c.label == label).unwrap();
    let choosy = cell("choosy");
    // Over the quiet frame alone its mean is below those of the others.
    for other in ["mc", "wide"] {
        assert!(choosy.metrics["mse"].value < cell(other).metrics["mse"].value, "{other}");
    }
    assert!(choosy.left_out.as_ref().unwrap().contains("ran on 1 of 2 replicates"), "{choosy:?}");
    assert!(choosy.equal_error.is_empty(), "no multiplier over other frames: {:?}", choosy.equal_error);
    assert!(cell("wide").equal_error.contains_key("mse") && cell("wide").left_out.is_none());
    assert_eq!(cell("wide").replicates, 2);
    for comparison in &summary.comparisons {
        assert!(!comparison.ranking.contains(&"choosy".to_owned()), "{comparison:?}");
        assert!(!comparison.best_group.contains(&"choosy".to_owned()));
        assert!(comparison.pairs.iter().all(|p| p.a != "choosy" && p.b != "choosy"));
    }
    let warned =
        summary.warnings.iter().any(|w| w.to_string().contains("choosy on mixed at 16 spp is not ranked"));
    assert!(warned, "{:?}", summary.warnings);
    assert!(summary.slopes.iter().all(|slope| slope.label != "choosy"));
}

#[test]
fn an_output_with_values_that_are_not_finite_is_never_ranked() {
    let place = Place::new();
    let text = crate::common::SMALL.replace("id = \"blur\"", "id = \"nan\"");
    let summary = place.run(&study(&text), &Watch::default()).unwrap();
    for cell in &summary.cells {
        let left_out = cell.label == "nan";
        assert_eq!((cell.pixels_of, cell.pixels), (384, if left_out { 383 } else { 384 }));
        assert_eq!(cell.left_out.is_some(), left_out, "{}: {:?}", cell.label, cell.left_out);
        assert_eq!(cell.equal_error.is_empty(), left_out, "{}", cell.label);
    }
    let reason = summary.cells.iter().find_map(|cell| cell.left_out.as_ref()).unwrap();
    assert!(reason.contains("2 output values are no numbers") && reason.contains("fewer pixels"), "{reason}");
    assert!(summary.comparisons.is_empty(), "nothing is left to compare: {:?}", summary.comparisons);
}

#[test]
fn the_multiplier_of_a_root_is_that_of_its_squared_error() {
    let place = Place::new();
    let summary = place.run(&study(TWO_SCENES), &Watch::default()).unwrap();
    for cell in &summary.cells {
        assert_eq!(cell.equal_error["rmse"], cell.equal_error["mse"], "{} {}", cell.label, cell.spp);
        assert_eq!(cell.equal_error_extrapolated["rmse"], cell.equal_error_extrapolated["mse"]);
        assert!(!cell.equal_error.contains_key("psnr"), "no rate, no multiplier");
        // A balance has a value and nothing that takes a better and a worse.
        assert!((cell.metrics["energy"].value - 1.0).abs() < 0.2, "{}", cell.label);
        assert!(!cell.equal_error.contains_key("energy") && !cell.ratio_to_mc.contains_key("energy"));
    }
    assert!(summary.comparisons.iter().any(|c| c.metric == "psnr"));
    assert!(summary.comparisons.iter().all(|c| c.metric != "energy"));
    assert!(summary.slopes.iter().all(|slope| slope.metric != "energy"));
    assert_eq!(summary.study.metrics.last().and_then(|metric| metric.ideal), Some(1.0));
    // Also where the squared error itself is not among the study's metrics.
    let text = TWO_SCENES.replace("[\"mse\", \"rmse\", \"relmse\", \"psnr\", \"energy\"]", "[\"rmse\"]");
    let alone = Place::new().run(&study(&text), &Watch::default()).unwrap();
    for (a, b) in alone.cells.iter().zip(&summary.cells) {
        assert_eq!(a.equal_error["rmse"], b.equal_error["rmse"]);
    }
}
