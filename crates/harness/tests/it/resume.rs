//! A study can be stopped anywhere and continues.

use std::io::Write as _;

use crate::common::{Place, Watch, records, small, study, timeless};
use noisefloor_frame::FindingKind;
use noisefloor_harness::{HarnessError, reanalyse};

#[test]
fn a_stopped_study_continues_and_equals_an_undisturbed_one() {
    let place = Place::new();
    let whole = place.root.path().join("whole");
    place.run_to(&whole, &small(), &Watch::default()).unwrap();
    for stop in [1, 3, 7] {
        let out = place.root.path().join(format!("stopped-{stop}"));
        let first = Watch::stopping_after(stop);
        let error = place.run_to(&out, &small(), &first).unwrap_err();
        assert!(error.is_cancelled(), "{error}");
        let second = Watch::default();
        place.run_to(&out, &small(), &second).unwrap();
        assert_eq!((first.cells(), second.cells()), (stop, 8 - stop));
        assert_eq!(second.planned.lock().unwrap().kept, stop as u64);
        assert_eq!(timeless(&out), timeless(&whole));
    }
}

#[test]
fn a_finished_study_does_nothing_again() {
    let place = Place::new();
    let first = place.run(&small(), &Watch::default()).unwrap();
    let watch = Watch::default();
    let mut again = place.run(&small(), &watch).unwrap();
    assert_eq!(watch.cells(), 0);
    again.environment.date.clone_from(&first.environment.date);
    assert_eq!(again, first);
}

#[test]
fn a_torn_last_line_is_dropped_and_its_cell_runs_again() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    let path = place.out().join("results.jsonl");
    let text = std::fs::read_to_string(&path).unwrap();
    let last = text.lines().last().unwrap();
    // Torn anywhere in the line, also just before its end.
    for missing in [1, last.len() / 2, last.len()] {
        std::fs::write(&path, &text[..text.len() - missing]).unwrap();
        let watch = Watch::default();
        place.run(&small(), &watch).unwrap();
        assert_eq!(watch.cells(), 1, "{missing} bytes missing");
        assert_eq!(timeless(&place.out()), before);
    }
    // Something torn behind whole records costs nothing.
    let mut file = std::fs::OpenOptions::new().append(true).open(&path).unwrap();
    file.write_all(b"{\"schema\":1,\"cell\":\"12").unwrap();
    let watch = Watch::default();
    place.run(&small(), &watch).unwrap();
    assert_eq!((watch.cells(), timeless(&place.out())), (0, before));
}

#[test]
fn a_damaged_line_is_set_aside_and_told_and_its_cell_runs_again() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    let path = place.out().join("results.jsonl");
    let mut lines: Vec<String> = std::fs::read_to_string(&path).unwrap().lines().map(str::to_owned).collect();
    lines[2].truncate(100);
    std::fs::write(&path, lines.join("\n") + "\n").unwrap();

    // A report tells, and goes on with the rest.
    let summary = reanalyse(&place.out(), false).unwrap();
    // Its replicate is missing in one row, and so in no row that is compared with it.
    assert_eq!(summary.cells.iter().map(|cell| cell.replicates).sum::<u32>(), 6);
    assert_eq!(summary.progress.as_ref().map(|progress| progress.finished), Some(7));
    let [found] = summary.findings.as_slice() else { panic!("{:?}", summary.findings) };
    assert!(found.kind == FindingKind::DamagedFile && found.subject == "results.jsonl, line 3", "{found:?}");
    assert!(!place.out().join("results.damaged.jsonl").exists(), "a report changes nothing");

    let watch = Watch::default();
    let summary = place.run(&small(), &watch).unwrap();
    assert_eq!(watch.cells(), 1);
    assert!(watch.warnings()[0].contains("results.jsonl, line 3"), "{:?}", watch.warnings());
    assert_eq!(timeless(&place.out()), before);
    let aside = std::fs::read_to_string(place.out().join("results.damaged.jsonl")).unwrap();
    assert_eq!(aside.trim_end(), lines[2]);
    assert!(summary.findings.is_empty(), "{:?}", summary.findings);
}

#[test]
fn records_of_a_newer_program_stop_the_run_and_stay_as_they_are() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let path = place.out().join("results.jsonl");
    let text = std::fs::read_to_string(&path).unwrap().replacen("\"schema\":1", "\"schema\":99", 1);
    std::fs::write(&path, &text).unwrap();
    let error = place.run(&small(), &Watch::default()).unwrap_err().to_string();
    assert!(error.contains("results.jsonl, line 1") && error.contains("newer program"), "{error}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
}

#[test]
fn a_lost_image_makes_its_cell_run_again_in_its_old_place() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    std::fs::remove_file(place.out().join(before[2].image.as_ref().unwrap())).unwrap();
    let watch = Watch::default();
    place.run(&small(), &watch).unwrap();
    assert_eq!(watch.cells(), 1);
    assert_eq!(timeless(&place.out()), before);
}

#[test]
fn a_changed_row_runs_again_and_the_others_stay() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let changed =
        study(&crate::common::SMALL.replace("id = \"blur\"", "id = \"blur\"\nset = { radius = 2 }"));
    let watch = Watch::default();
    place.run(&changed, &watch).unwrap();
    assert_eq!(watch.cells(), 4);
    assert!(watch.warnings()[0].contains("4 records"), "{:?}", watch.warnings());
    assert_eq!(records(&place.out()).len(), 8);
}

#[test]
fn a_folder_of_another_study_is_refused_and_stays_as_it_is() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    let other = study(&crate::common::SMALL.replace("name = \"small\"", "name = \"other\""));
    let error = place.run(&other, &Watch::default()).unwrap_err();
    assert!(matches!(&error, HarnessError::OtherStudy { found, .. } if found == "small"), "{error}");
    assert_eq!(timeless(&place.out()), before);
}

#[test]
fn two_runs_in_one_folder_are_kept_apart() {
    let place = Place::new();
    std::fs::create_dir_all(place.out()).unwrap();
    let lock = std::fs::File::create(place.out().join(".lock")).unwrap();
    lock.lock().unwrap();
    let error = place.run(&small(), &Watch::default()).unwrap_err();
    assert!(matches!(error, HarnessError::Locked { .. }), "{error}");
    drop(lock);
    place.run(&small(), &Watch::default()).unwrap();
}

#[test]
fn an_unusable_folder_is_an_error_that_names_it() {
    let place = Place::new();
    let file = place.root.path().join("file");
    std::fs::write(&file, "").unwrap();
    let error = place.run_to(&file.join("out"), &small(), &Watch::default()).unwrap_err();
    assert!(matches!(error, HarnessError::Io { .. }), "{error}");
    assert!(error.to_string().contains("file/out"), "{error}");
}

#[test]
fn a_disk_that_fails_midway_leaves_finished_cells_intact() {
    let place = Place::new();
    let reference = place.root.path().join("whole");
    place.run_to(&reference, &small(), &Watch::default()).unwrap();
    place.run(&small(), &Watch::stopping_after(4)).unwrap_err();
    // A file where the next images' folder should be stands for a disk that refuses to write.
    let blocked = place.out().join("images/steps/blur");
    std::fs::rename(&blocked, place.root.path().join("aside")).unwrap();
    std::fs::write(&blocked, "").unwrap();
    let error = place.run(&small(), &Watch::default()).unwrap_err();
    assert!(error.to_string().contains("images/steps/blur"), "{error}");
    assert!(records(&place.out()).len() >= 2);
    std::fs::remove_file(&blocked).unwrap();
    std::fs::rename(place.root.path().join("aside"), &blocked).unwrap();
    place.run(&small(), &Watch::default()).unwrap();
    assert_eq!(timeless(&place.out()), timeless(&reference));
}

#[test]
fn analysis_and_metrics_can_be_made_again_from_what_is_kept() {
    let place = Place::new();
    let mut first = place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    std::fs::remove_dir_all(place.cache()).unwrap();
    for recompute in [false, true] {
        let again = reanalyse(&place.out(), recompute).unwrap();
        first.environment.date.clone_from(&again.environment.date);
        assert_eq!(again, first, "recompute: {recompute}");
        assert_eq!(timeless(&place.out()), before);
    }
    assert!(crate::common::superseded(&place.out()).is_empty(), "equal numbers supersede nothing");
    let nothing = reanalyse(&place.root.path().join("absent"), false).unwrap_err();
    assert!(matches!(nothing, HarnessError::Io { .. }), "{nothing}");
    assert!(!place.root.path().join("absent").exists());
}

#[test]
fn a_stopped_study_is_analysed_as_far_as_it_went() {
    let place = Place::new();
    place.run(&small(), &Watch::stopping_after(5)).unwrap_err();
    let summary = reanalyse(&place.out(), false).unwrap();
    let shape: Vec<(u32, &str, u32)> =
        summary.cells.iter().map(|c| (c.spp, c.label.as_str(), c.replicates)).collect();
    assert_eq!(shape, [(4, "mc", 2), (4, "blur", 2), (16, "mc", 1)]);
}

#[test]
fn a_metric_on_request_has_cells_of_its_own_and_leaves_those_of_others() {
    let place = Place::new();
    let cells = |study: &noisefloor_study::Study| {
        let watch = Watch::default();
        let summary = place.run(study, &watch).unwrap();
        (watch.cells(), summary)
    };
    let (_, plain) = cells(&small());
    assert!(records(&place.out()).iter().all(|record| !record.metrics.contains_key("hdr_flip")));
    let mut asking = small();
    asking.metrics = vec!["relmse".into(), "hdr_flip".into()];
    let (run, mut first) = cells(&asking);
    assert_eq!(run, 8);
    let flips = records(&place.out()).iter().filter(|record| record.metrics["hdr_flip"].is_some()).count();
    assert_eq!(flips, 8);
    assert!(first.cells.iter().all(|cell| cell.metrics.contains_key("hdr_flip")));
    assert!(first.study.metrics.iter().any(|metric| metric.formula.contains("ACES")));
    let again = reanalyse(&place.out(), true).unwrap();
    first.environment.date.clone_from(&again.environment.date);
    assert_eq!(again, first);
    // Without it everything is there already.
    let (run, mut back) = cells(&small());
    back.environment.clone_from(&plain.environment);
    assert_eq!((run, back), (0, plain));
}
