//! Nothing that a study computed is lost when study, size, methods or metrics change: going back finds it.

use std::path::Path;

use noisefloor_denoiser::{Denoiser, Input, MethodCard, NoParams, Output, Registry, mc, method};
use noisefloor_harness::{HarnessError, StudyRun, reanalyse, run};
use noisefloor_study::Study;
use noisefloor_study::record::Record;

use crate::common::{Place, SMALL, Watch, records, small, study, superseded, timeless};

fn lines(out: &Path) -> String {
    std::fs::read_to_string(out.join("results.jsonl")).unwrap()
}

fn changed() -> Study {
    study(&SMALL.replace("id = \"blur\"", "id = \"blur\"\nset = { radius = 2 }"))
}

fn of<'a>(all: &'a [Record], label: &str) -> Vec<&'a Record> {
    all.iter().filter(|record| record.label == label).collect()
}

#[test]
fn a_study_that_goes_back_finds_every_cell_and_image_as_it_was() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = lines(&place.out());
    let images: Vec<(String, Vec<u8>)> = records(&place.out())
        .iter()
        .flat_map(|record| record.paths().map(str::to_owned).collect::<Vec<_>>())
        .map(|path| (path.clone(), std::fs::read(place.out().join(path)).unwrap()))
        .collect();

    place.run(&changed(), &Watch::default()).unwrap();
    assert_eq!((records(&place.out()).len(), superseded(&place.out()).len()), (8, 4));
    // Every image is still the one of its record.
    for (path, bytes) in &images {
        assert!(std::fs::read(place.out().join(path)).unwrap() == *bytes, "{path}");
    }
    let between = lines(&place.out());

    // To and fro, again and again: nothing runs, nothing grows.
    for (study, text) in
        [(small(), &before), (changed(), &between), (small(), &before), (changed(), &between)]
    {
        let watch = Watch::default();
        place.run(&study, &watch).unwrap();
        assert_eq!((watch.cells(), &lines(&place.out())), (0, text));
        assert!(
            watch
                .warnings()
                .iter()
                .any(|w| w.to_string().contains("4 records that were set aside are in use again"))
        );
    }
    assert_eq!(superseded(&place.out()).len(), 8);
}

#[test]
fn another_size_that_is_stopped_at_once_costs_nothing() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = lines(&place.out());
    for stop in [0, 1, 5] {
        let watch = Watch::stopping_after(stop);
        let wider = |request: StudyRun<'_>| run(&StudyRun { size: Some((25, 16)), ..request });
        assert!(place.run_with(&small(), &watch, wider).unwrap_err().is_cancelled());
        let watch = Watch::default();
        place.run(&small(), &watch).unwrap();
        assert_eq!((watch.cells(), lines(&place.out())), (0, before.clone()), "stopped after {stop}");
    }
    // The one and the five cells of the other size are there as well.
    let watch = Watch::default();
    place.run_with(&small(), &watch, |request| run(&StudyRun { size: Some((25, 16)), ..request })).unwrap();
    assert_eq!(watch.cells(), 2);
}

#[test]
fn a_process_that_dies_between_the_two_files_leaves_a_copy_and_loses_nothing() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = lines(&place.out());
    // Set aside, and not yet removed; the last line was being written.
    let torn = &before[..before.len() - 40];
    std::fs::write(place.out().join("results.superseded.jsonl"), torn).unwrap();
    place.run(&changed(), &Watch::default()).unwrap();
    let watch = Watch::default();
    place.run(&small(), &watch).unwrap();
    assert_eq!((watch.cells(), lines(&place.out())), (0, before));
}

#[test]
fn a_row_that_is_taken_out_and_put_back_is_there_again() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = lines(&place.out());
    let without = study(&SMALL.replace("[[method]]\nid = \"blur\"\n", ""));
    let summary = place.run(&without, &Watch::default()).unwrap();
    assert_eq!((summary.methods.len(), records(&place.out()).len()), (1, 4));
    let watch = Watch::default();
    place.run(&small(), &watch).unwrap();
    assert_eq!((watch.cells(), lines(&place.out())), (0, before));
}

/// The input times a factor.
struct Scaled(f32);

impl Denoiser for Scaled {
    fn card(&self) -> MethodCard {
        MethodCard::new("blur", "Scaled", noisefloor_denoiser::Citation::new("none", "none"))
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, noisefloor_denoiser::DenoiseError> {
        Ok(Output::from_image(input.target.color.mean.map(|v| self.0 * v)))
    }
}

/// Two versions of one method: the same id and parameters, other numbers.
fn version(second: bool) -> Registry {
    let factor = if second { 0.95 } else { 0.9 };
    Registry::new([mc(), method("blur", "a test", None, move |_: NoParams| Ok(Scaled(factor)))])
}

#[test]
fn another_version_of_a_method_runs_its_own_rows_alone_and_the_first_one_is_found_again() {
    let place = Place::new();
    let with = |second: bool, watch: &Watch| {
        let registry = version(second);
        place.run_with(&small(), watch, |request| run(&StudyRun { registry: &registry, ..request })).unwrap();
    };
    with(false, &Watch::default());
    let before = records(&place.out());
    let watch = Watch::default();
    with(true, &watch);
    assert_eq!(watch.cells(), 4);
    let after = records(&place.out());
    assert_eq!(of(&after, "mc"), of(&before, "mc"));
    assert_ne!(of(&after, "blur")[0].metrics, of(&before, "blur")[0].metrics);
    let watch = Watch::default();
    with(false, &watch);
    assert_eq!((watch.cells(), records(&place.out())), (0, before));
}

#[test]
fn rows_run_again_by_label_or_method_and_their_first_records_are_kept() {
    let place = Place::new();
    let two =
        study(&(SMALL.to_owned() + "[[method]]\nid = \"blur\"\nlabel = \"wide\"\nset = { radius = 3 }\n"));
    place.run(&two, &Watch::default()).unwrap();
    let before = records(&place.out());
    for (name, cells) in [("wide", 4), ("blur", 8), ("mc", 4)] {
        let watch = Watch::default();
        let again = [name.to_owned()];
        place.run_with(&two, &watch, |request| run(&StudyRun { again: &again, ..request })).unwrap();
        assert_eq!(watch.cells(), cells, "{name}");
    }
    let old = superseded(&place.out());
    assert!(before.iter().all(|record| old.contains(record)));
    assert_eq!(timeless(&place.out()).len(), 12);
    let watch = Watch::default();
    place.run(&two, &watch).unwrap();
    assert_eq!(watch.cells(), 0);

    let now = lines(&place.out());
    let again = ["blurr".to_owned()];
    let watch = Watch::default();
    let error =
        place.run_with(&two, &watch, |request| run(&StudyRun { again: &again, ..request })).unwrap_err();
    assert!(matches!(&error, HarnessError::NoRow { rows, .. } if rows.len() == 3), "{error}");
    assert!(error.to_string().contains("`blurr`") && error.to_string().contains("mc, blur, wide"), "{error}");
    assert_eq!(lines(&place.out()), now);
}

#[test]
fn numbers_of_another_measuring_are_never_taken_for_those_of_this_one() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let before = timeless(&place.out());
    let path = place.out().join("results.jsonl");
    let first: Record = serde_json::from_str(lines(&place.out()).lines().next().unwrap()).unwrap();
    // As a program with other metrics leaves them that has computed them again.
    let foreign = lines(&place.out()).replace(&first.measuring, "another");
    std::fs::write(&path, &foreign).unwrap();
    let watch = Watch::default();
    place.run(&small(), &watch).unwrap();
    assert_eq!((watch.cells(), timeless(&place.out())), (8, before));
    assert_eq!(superseded(&place.out()).len(), 8);

    // What a scene's description says of its reference is made again as well, not taken over.
    let description = place.out().join("reference/steps.json");
    let text = std::fs::read_to_string(&description).unwrap();
    let foreign_scene =
        text.replace(&first.measuring, "another").replace("\"title\": \"steps\"", "\"title\": \"old\"");
    std::fs::write(&description, &foreign_scene).unwrap();
    let summary = place.run(&small(), &Watch::default()).unwrap();
    assert!(text != foreign_scene && summary.scenes[0].title == "steps", "{}", summary.scenes[0].title);

    // Computed again here, they are of this program; the others are set aside.
    std::fs::write(&path, &foreign).unwrap();
    reanalyse(&place.out(), true).unwrap();
    assert!(records(&place.out()).iter().all(|record| record.measuring == first.measuring));
    let watch = Watch::default();
    place.run(&small(), &watch).unwrap();
    assert_eq!(watch.cells(), 0);
}

#[test]
fn a_report_says_when_rows_come_from_several_builds_and_a_run_keeps_them() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    let first = records(&place.out()).remove(0);
    assert_eq!(first.build.len(), 16);
    let summary = reanalyse(&place.out(), false).unwrap();
    assert!(!summary.warnings.iter().any(|w| w.to_string().contains("builds")), "{:?}", summary.warnings);
    // The baseline's cells by another executable.
    let text: Vec<String> = lines(&place.out())
        .lines()
        .map(|line| {
            if line.contains("\"label\":\"mc\"") {
                line.replace(&first.build, "fedcba9876543210")
            } else {
                line.into()
            }
        })
        .collect();
    std::fs::write(place.out().join("results.jsonl"), text.join("\n") + "\n").unwrap();
    let watch = Watch::default();
    let summary = place.run(&small(), &watch).unwrap();
    assert_eq!(watch.cells(), 0);
    let told = summary
        .warnings
        .iter()
        .find(|w| w.to_string().contains("2 builds"))
        .unwrap_or_else(|| panic!("{:?}", summary.warnings))
        .to_string();
    assert!(
        told.contains("fedcba9876543210 (mc)") && told.contains(&format!("{} (blur)", first.build)),
        "{told}"
    );
}

#[test]
fn two_scenes_with_equal_frames_keep_their_cells_apart() {
    let place = Place::new();
    let scene = SMALL.lines().find(|line| line.starts_with("synthetic")).unwrap();
    let twice = study(&SMALL.replace(
        "[[method]]\nid = \"mc\"",
        &format!("[[scene]]\nid = \"twin\"\n{scene}\n[[method]]\nid = \"mc\""),
    ));
    place.run(&twice, &Watch::default()).unwrap();
    let before = lines(&place.out());
    let watch = Watch::default();
    place.run(&twice, &watch).unwrap();
    assert_eq!((watch.cells(), before.lines().count()), (0, 16));
    assert_eq!(lines(&place.out()), before);
}
