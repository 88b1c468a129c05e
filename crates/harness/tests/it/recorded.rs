//! Recorded studies open again: those of this program without images, and those that earlier programs wrote.

use std::io::Read;
use std::path::{Path, PathBuf};

use crate::common::{Place, Watch, small};
use noisefloor_harness::{HarnessError, analysis_of, record_study};
use noisefloor_study::record::Record;

fn reports() -> Vec<PathBuf> {
    let reports = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reports");
    std::fs::read_dir(reports).unwrap().map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn a_recording_has_the_numbers_of_its_study_and_equal_bytes_each_time() {
    let place = Place::new();
    let summary = place.run(&small(), &Watch::default()).unwrap();
    let to = [place.root.path().join("a"), place.root.path().join("b")];
    for to in &to {
        record_study(&place.out(), to).unwrap();
    }
    let names = ["context.json", "levels.jsonl.gz", "results.jsonl.gz", "study.json"];
    let mut found: Vec<_> = std::fs::read_dir(&to[0]).unwrap().map(|e| e.unwrap().file_name()).collect();
    found.sort();
    assert_eq!(found, names);
    for name in names {
        assert_eq!(
            std::fs::read(to[0].join(name)).unwrap(),
            std::fs::read(to[1].join(name)).unwrap(),
            "{name}"
        );
    }
    let again = analysis_of(&to[0]).unwrap();
    assert!(again.recorded && again.scenes.iter().all(|scene| scene.images.is_empty()));
    assert_eq!(
        (&again.cells, &again.coverage, &again.comparisons, &again.slopes),
        (&summary.cells, &summary.coverage, &summary.comparisons, &summary.slopes)
    );
    assert_eq!(again.progress, summary.progress);
    assert!(!summary.answers.is_empty());
    assert_eq!((&again.answers, &again.claims), (&summary.answers, &summary.claims));
    // A recording can be recorded.
    let third = place.root.path().join("c");
    record_study(&to[0], &third).unwrap();
    for name in names {
        assert_eq!(
            std::fs::read(to[0].join(name)).unwrap(),
            std::fs::read(third.join(name)).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn every_recorded_study_of_the_repository_opens() {
    let (mut opened, mut bytes) = (0, 0);
    for folder in reports() {
        let kept = ["results.jsonl.gz", "results.jsonl"].iter().any(|name| folder.join(name).is_file());
        if !kept {
            continue;
        }
        let summary = analysis_of(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        let progress = summary.progress.unwrap_or_else(|| panic!("{}: how far?", folder.display()));
        assert!(progress.complete(), "{}: {progress}", folder.display());
        assert!(!summary.cells.is_empty() && summary.recorded);
        opened += 1;
        if folder.join("results.jsonl.gz").is_file() {
            let files = std::fs::read_dir(&folder)
                .unwrap()
                .chain(std::fs::read_dir(folder.join("plots")).into_iter().flatten());
            let size: u64 =
                files.map(|e| e.unwrap().metadata().unwrap()).filter(|m| m.is_file()).map(|m| m.len()).sum();
            assert!(size <= 800_000, "{} takes {size} bytes", folder.display());
            bytes += size;
        }
    }
    assert!(opened >= 4, "{opened} recordings, {bytes} bytes");
}

#[test]
fn every_record_of_earlier_programs_is_still_readable() {
    let mut records = 0;
    for folder in reports() {
        let Ok(file) = std::fs::File::open(folder.join("results.jsonl.gz")) else { continue };
        let mut text = String::new();
        flate2::read::GzDecoder::new(file).read_to_string(&mut text).unwrap();
        for line in text.lines() {
            let read: Result<Record, _> = serde_json::from_str(line);
            read.unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
            records += 1;
        }
    }
    assert!(records > 1000, "{records} records");
}

#[test]
fn a_folder_without_a_study_is_told_what_it_lacks_and_what_to_do() {
    let place = Place::new();
    let empty = place.root.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    let error = analysis_of(&empty).unwrap_err();
    assert!(matches!(error, HarnessError::NotAStudy { .. }));
    let told = error.to_string();
    assert!(told.contains("study.json") && told.contains("noisefloor run"), "{told}");

    // A recording of an earlier program, of a study that is not built in.
    let mut summary = place.run(&small(), &Watch::default()).unwrap();
    summary.study.name = "somebodys".into();
    let text = serde_json::to_string(&summary).unwrap();
    std::fs::write(empty.join("summary.json"), text).unwrap();
    std::fs::copy(place.out().join("results.jsonl"), empty.join("results.jsonl")).unwrap();
    let told = analysis_of(&empty).unwrap_err().to_string();
    assert!(told.contains("`somebodys`") && told.contains("noisefloor record"), "{told}");
}

#[test]
fn damaged_records_are_an_error_that_names_the_file() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let to = place.root.path().join("to");
    record_study(&place.out(), &to).unwrap();
    let path = to.join("results.jsonl.gz");
    let bytes = std::fs::read(&path).unwrap();
    for damaged in [&bytes[..bytes.len() / 2], b"not gzip".as_slice()] {
        std::fs::write(&path, damaged).unwrap();
        let told = analysis_of(&to).unwrap_err().to_string();
        assert!(told.contains("results.jsonl.gz"), "{told}");
    }
}
