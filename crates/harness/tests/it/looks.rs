//! A study remembers with how many replicates it was looked at.

use std::path::Path;

use crate::common::{Place, SMALL, Watch, small, study};
use noisefloor_harness::{analysis_of, reanalyse, record_study};
use noisefloor_study::Study;
use noisefloor_study::look::Look;
use noisefloor_study::summary::{Summary, WarningKind};

fn looks(out: &Path) -> Vec<Look> {
    let text = std::fs::read_to_string(out.join("looks.jsonl")).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn told(summary: &Summary) -> Vec<String> {
    let looked = summary.warnings.iter().filter(|w| w.kind == WarningKind::Looked);
    looked.map(ToString::to_string).collect()
}

fn with_replicates(count: u32) -> Study {
    study(&SMALL.replace("replicates = 2", &format!("replicates = {count}")))
}

#[test]
fn replicates_that_were_added_after_a_look_are_told_and_the_same_number_is_no_new_look() {
    let place = Place::new();
    let first = place.run(&small(), &Watch::default()).unwrap();
    reanalyse(&place.out(), false).unwrap();
    let one = looks(&place.out());
    assert_eq!(one.len(), 1);
    assert_eq!((one[0].cells, one[0].replicates["steps"][&16]), (8, 2));
    assert!(told(&first).is_empty());

    let grown = place.run(&with_replicates(3), &Watch::default()).unwrap();
    let sentences = told(&grown);
    assert_eq!(sentences.len(), 1);
    assert!(sentences[0].contains("grew after a look at 2 (") && sentences[0].contains("fixed beforehand"));
    assert_eq!(looks(&place.out()).len(), 2);

    // A recording carries the looks.
    let to = place.root.path().join("to");
    record_study(&place.out(), &to).unwrap();
    assert_eq!(told(&analysis_of(&to).unwrap()), sentences);
    assert!(!to.join("looks.jsonl").exists());
}

#[test]
fn a_study_that_was_stopped_and_looked_at_may_end_with_the_number_that_it_had_planned() {
    let place = Place::new();
    assert!(place.run(&with_replicates(3), &Watch::stopping_after(4)).unwrap_err().is_cancelled());
    reanalyse(&place.out(), false).unwrap();
    let finished = place.run(&with_replicates(3), &Watch::default()).unwrap();
    assert_eq!(looks(&place.out()).len(), 2);
    assert_eq!(told(&finished), Vec::<String>::new());
    let more = place.run(&with_replicates(4), &Watch::default()).unwrap();
    assert_eq!(told(&more).len(), 1);
}

#[test]
fn who_only_reads_a_folder_leaves_no_look() {
    let place = Place::new();
    place.run(&small(), &Watch::default()).unwrap();
    std::fs::remove_file(place.out().join("looks.jsonl")).unwrap();
    analysis_of(&place.out()).unwrap();
    let other = place.root.path().join("other");
    noisefloor_harness::reanalyse_into(&place.out(), &other, false).unwrap();
    assert!(!place.out().join("looks.jsonl").exists() && !other.join("looks.jsonl").exists());
}
