//! Files of a study that were damaged are found and made again, or named; a report changes nothing that it only reads.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use noisefloor_frame::{FindingKind, Image};
use noisefloor_harness::{HarnessError, reanalyse, reanalyse_into};
use noisefloor_study::summary::{Interval, Summary};

use crate::common::{Place, Watch, records, small, timeless};

type Harm = fn(&Path);

/// Cut to 100 bytes, emptied, of another size, gone.
const HARMS: [Harm; 4] = [
    |path| {
        let bytes = std::fs::read(path).unwrap();
        std::fs::write(path, &bytes[..100]).unwrap();
    },
    |path| std::fs::write(path, b"").unwrap(),
    |path| noisefloor_io::write_image(path, &Image::filled(3, 2, 3, 0.5), &BTreeMap::new()).unwrap(),
    |path| std::fs::remove_file(path).unwrap(),
];

fn told(summary: &Summary, path: &str) -> bool {
    summary.findings.iter().any(|f| f.kind == FindingKind::DamagedFile && f.subject == path)
}

/// Metrics of all cells; times are those of the last run.
fn numbers(summary: &Summary) -> Vec<&BTreeMap<String, Interval>> {
    summary.cells.iter().map(|cell| &cell.metrics).collect()
}

#[test]
fn a_damaged_image_is_named_by_a_report_and_made_again_by_a_run() {
    let place = Place::new();
    let first = place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    let blurred = before.iter().find(|record| !record.diagnostics.is_empty()).unwrap();
    for path in blurred.paths() {
        for harm in HARMS {
            let file = place.out().join(path);
            let good = std::fs::read(&file).unwrap();
            harm(&file);
            for recompute in [false, true] {
                let summary = reanalyse(&place.out(), recompute).unwrap();
                assert!(told(&summary, path), "{path}: {:?}", summary.findings);
                // The picture is left out, the numbers stay.
                let scene = serde_json::to_string(&summary.scenes).unwrap();
                assert!(!scene.contains(path), "{path}");
                assert_eq!(numbers(&summary), numbers(&first));
            }
            assert_eq!(timeless(&place.out()), before, "a report does not forget the file");
            let watch = Watch::default();
            let summary = place.run(&small(), &watch).unwrap();
            assert_eq!((watch.cells(), timeless(&place.out())), (1, before.clone()), "{path}");
            assert!(
                watch.warnings().iter().any(|w| w.to_string().starts_with(path)),
                "{:?}",
                watch.warnings()
            );
            assert!(std::fs::read(&file).unwrap() == good && summary.findings.is_empty());
        }
    }
}

#[test]
fn damaged_references_and_class_maps_are_named_by_a_report_and_written_again_by_a_run() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    for path in ["reference/steps.exr", "reference/steps.classes.exr"] {
        for harm in HARMS {
            let file = place.out().join(path);
            let good = std::fs::read(&file).unwrap();
            harm(&file);
            for recompute in [false, true] {
                let summary = reanalyse(&place.out(), recompute).unwrap();
                assert!(told(&summary, path), "{path}: {:?}", summary.findings);
                assert_eq!(summary.scenes[0].reference_image.is_empty(), path == "reference/steps.exr");
            }
            let watch = Watch::default();
            let summary = place.run(&small(), &watch).unwrap();
            assert_eq!((watch.cells(), timeless(&place.out())), (0, before.clone()));
            assert!(
                watch.warnings().iter().any(|w| w.to_string().starts_with(path)),
                "{:?}",
                watch.warnings()
            );
            assert!(std::fs::read(&file).unwrap() == good && summary.findings.is_empty(), "{path}");
        }
    }
}

#[test]
fn damaged_descriptions_are_written_again() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    for (path, say) in [("reference/steps.json", true), ("study.json", false), ("context.json", false)] {
        let file = place.out().join(path);
        let good = std::fs::read(&file).unwrap();
        std::fs::write(&file, &good[..good.len() / 2]).unwrap();
        match reanalyse(&place.out(), false) {
            Ok(summary) => assert!(say && told(&summary, path) && summary.scenes.is_empty()),
            Err(error) => {
                assert!(
                    !say && matches!(error, HarnessError::Kept { .. }) && error.to_string().contains(path)
                );
            }
        }
        let watch = Watch::default();
        place.run(&small(), &watch).unwrap();
        assert_eq!((watch.cells(), timeless(&place.out())), (0, before.clone()), "{path}");
        assert_eq!(
            watch.warnings().iter().any(|w| w.to_string().starts_with(path)),
            say,
            "{:?}",
            watch.warnings()
        );
        reanalyse(&place.out(), false).unwrap();
    }
    // The name of the study is known from its records: another one is still refused.
    std::fs::write(place.out().join("study.json"), "{").unwrap();
    let other = crate::common::study(&crate::common::SMALL.replace("name = \"small\"", "name = \"other\""));
    let error = place.run(&other, &Watch::default()).unwrap_err();
    assert!(matches!(error, HarnessError::OtherStudy { .. }), "{error}");
}

#[test]
fn files_that_killed_processes_left_half_written_are_swept() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let left =
        [".tmpAbC123", "reference/.tmp000000", "images/steps/blur/.tmpzzzzzz", "report/plots/.tmpQ1w2E3"];
    let others = [".tmp-notes", "notes.tmp", "images/.tmp.exr"];
    std::fs::create_dir_all(place.out().join("report/plots")).unwrap();
    for name in left.iter().chain(&others) {
        std::fs::write(place.out().join(name), "x").unwrap();
    }
    place.run(&small(), &Watch::default()).unwrap();
    assert!(left.iter().all(|name| !place.out().join(name).exists()));
    assert!(others.iter().all(|name| place.out().join(name).exists()));
}

/// Every file below a folder with its bytes and when it was last changed.
fn contents(folder: &Path) -> Vec<(PathBuf, std::time::SystemTime, Vec<u8>)> {
    let mut out = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            out.extend(contents(&path));
        } else {
            let changed = path.metadata().unwrap().modified().unwrap();
            let bytes = std::fs::read(&path).unwrap();
            out.push((path, changed, bytes));
        }
    }
    out.sort();
    out
}

#[test]
fn a_study_is_analysed_into_another_folder_without_touching_its_own_even_while_it_runs() {
    let place = Place::new();
    let first = place.run(&small(), &Watch::default()).unwrap();
    let lock = std::fs::File::open(place.out().join(".lock")).unwrap();
    lock.lock().unwrap();
    // A line that is being written.
    let path = place.out().join("results.jsonl");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, format!("{text}{}", &text[..200])).unwrap();
    let before = contents(&place.out());
    let other = place.root.path().join("some/where");
    for recompute in [false, true] {
        let mut summary = reanalyse_into(&place.out(), &other, recompute).unwrap();
        assert!(other.join("summary.json").exists() && contents(&other).len() == 1);
        summary.environment.date.clone_from(&first.environment.date);
        assert_eq!(summary, first, "recompute: {recompute}");
        assert!(contents(&place.out()) == before, "recompute: {recompute}");
    }
    // Reading needs no lock, replacing records does.
    reanalyse(&place.out(), false).unwrap();
    assert!(matches!(reanalyse(&place.out(), true), Err(HarnessError::Locked { .. })));
    let link = place.out().join("../out/.");
    assert!(matches!(reanalyse_into(&place.out(), &link, true), Err(HarnessError::Locked { .. })));
    drop(lock);
    reanalyse(&place.out(), true).unwrap();
    assert_eq!(records(&place.out()).len(), 8);
}
