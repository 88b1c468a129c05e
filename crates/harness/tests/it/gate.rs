//! Two results of the same inputs, and results of others.

use std::path::Path;

use crate::common::{Place, SMALL, Watch, records, small, study};
use noisefloor_harness::{GateFailure, gate, record_study};
use noisefloor_questions::{GateError, GateOutcome, Overall};
use noisefloor_stats::{Answer, Level, Terms};
use noisefloor_study::record::{Outcome, Record};

const TERMS: Terms = Terms { level: Level::TWO_SIDED_95, margin: 0.01 };

fn passed(old: &Path, new: &Path) -> GateOutcome {
    gate(old, new, Some("mse"), TERMS).unwrap_or_else(|e| panic!("{e}"))
}

fn refused(old: &Path, new: &Path) -> String {
    match gate(old, new, Some("mse"), TERMS) {
        Err(GateFailure::Gate(error @ GateError::NotComparable(_))) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

/// The records of a folder with some of them changed.
fn change(out: &Path, change: impl Fn(&mut Record)) {
    let mut all = records(out);
    all.iter_mut().for_each(change);
    let lines: Vec<String> = all.iter().map(|r| format!("{}\n", serde_json::to_string(r).unwrap())).collect();
    std::fs::write(out.join("results.jsonl"), lines.concat()).unwrap();
}

/// Two folders with the results of a study.
fn two(place: &Place) -> [std::path::PathBuf; 2] {
    ["old", "new"].map(|name| {
        let out = place.root.path().join(name);
        place.run_to(&out, &small(), &Watch::default()).unwrap();
        out
    })
}

#[test]
fn the_same_program_gives_the_same_numbers_whether_run_or_recorded() {
    let place = Place::new();
    let [old, new] = two(&place);
    let found = passed(&old, &new);
    assert_eq!(found.overall, Overall::Same);
    assert_eq!((found.rows.len(), found.cells.len()), (2, 4));
    let recorded = place.root.path().join("recorded");
    record_study(&old, &recorded).unwrap();
    assert_eq!(passed(&recorded, &new), found);
    // Earlier programs wrote no keys of frames into their records: the plan has them, and plain Monte Carlo tells.
    change(&old, |record| record.frames.clear());
    assert_eq!(passed(&old, &new), found);
    std::fs::remove_file(old.join("plan.jsonl")).unwrap();
    assert_eq!(passed(&old, &new), found);
    change(&old, |record| {
        if record.method == "mc" && record.spp == 4 {
            record.metrics.insert("mse".into(), Some(1.0));
        }
    });
    let told = refused(&old, &new);
    assert!(
        told.contains("frames of `blur` on `steps` differ: 4 spp, replicate 0; 4 spp, replicate 1"),
        "{told}"
    );
}

#[test]
fn a_row_with_larger_errors_is_worse_and_one_within_the_margin_is_not() {
    let place = Place::new();
    let [old, new] = two(&place);
    let by = |factor: f64| {
        let new = new.clone();
        change(&new, move |record| {
            if record.label == "blur" {
                // Two replicates: their ratios must agree well to be told.
                let factor = factor * (1.0 + 1e-5 * f64::from(record.replicate));
                let value = record.metrics["mse"].unwrap();
                record.metrics.insert("mse".into(), Some(factor * value));
            }
        });
    };
    by(1.5);
    let found = passed(&old, &new);
    assert_eq!(found.overall, Overall::Worse);
    let answers: Vec<Answer> = found.rows.iter().map(|row| row.judged.answer).collect();
    assert_eq!(answers, [Answer::Same, Answer::Worse]);
    assert_eq!(found.rows[1].worse, 2);
    assert_eq!(passed(&new, &old).overall, Overall::Passed);
    by(1.0 / 1.5 * 1.002);
    assert_eq!(passed(&old, &new).rows[1].judged.answer, Answer::WithinMargin);
}

#[test]
fn a_cell_that_does_not_run_any_more_is_worse_and_one_that_is_new_is_not_looked_at() {
    let place = Place::new();
    let [old, new] = two(&place);
    change(&new, |record| {
        if record.label == "blur" && record.spp == 16 {
            record.outcome = Outcome::Failed { reason: "no memory".into() };
        }
    });
    let found = passed(&old, &new);
    assert_eq!((found.overall, found.broken.len()), (Overall::Worse, 1));
    assert!(found.broken[0].reason.contains("no memory"), "{found:?}");
    let more = place.root.path().join("more");
    let study = study(&format!("{SMALL}[[method]]\nid = \"judge\"\n").replace("[4, 16]", "[4, 16, 64]"));
    place.run_to(&more, &study, &Watch::default()).unwrap();
    assert_eq!(passed(&old, &more).overall, Overall::Same);
    let told = refused(&more, &old);
    assert!(told.contains("no row `judge` on `steps`") && told.contains("lacks cells of `mc`"), "{told}");
}

#[test]
fn a_part_of_the_old_version_speaks_for_nothing() {
    let place = Place::new();
    let [old, new] = two(&place);
    let path = old.join("results.jsonl");
    let text = std::fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    // As a copy that ended in the middle of a line.
    let kept = lines[..lines.len() - 3].join("\n") + "\n" + &lines[lines.len() - 3][..40];
    std::fs::write(&path, kept).unwrap();
    let told = gate(&old, &new, Some("mse"), TERMS).unwrap_err();
    assert!(matches!(told, GateFailure::Unfinished { missing: 3, planned: 8, .. }), "{told:?}");
    std::fs::remove_file(old.join("plan.jsonl")).unwrap();
    let told = refused(&old, &new);
    assert!(told.contains("the old version is not finished, it lacks cells of `mc` on `steps`"), "{told}");
    assert!(gate(&new, &new, Some("mse"), TERMS).is_ok());
}

#[test]
fn a_cell_that_lost_its_number_is_worse() {
    let place = Place::new();
    let [old, new] = two(&place);
    change(&new, |record| {
        if record.label == "blur" && record.spp == 16 {
            record.metrics.insert("mse".into(), None);
        }
    });
    let found = passed(&old, &new);
    assert_eq!((found.overall, found.broken.len()), (Overall::Worse, 1));
    assert!(found.broken[0].reason.contains("no mse"), "{found:?}");
}

#[test]
fn other_inputs_are_refused_by_name() {
    let place = Place::new();
    let [old, new] = two(&place);
    let with = |from: &str, to: &str| {
        let out = place.root.path().join("other");
        let _ = std::fs::remove_dir_all(&out);
        place.run_to(&out, &study(&SMALL.replace(from, to)), &Watch::default()).unwrap();
        refused(&old, &out)
    };
    let told = with("replicates = 2", "replicates = 2\nseed = 7");
    assert!(told.contains("frames of `mc` on `steps` differ") && !told.contains("references"), "{told}");
    let told = with("sd = 0.5", "sd = 0.25");
    assert!(told.contains("frames of `blur`"), "{told}");
    assert!(with("\"steps\"", "\"stairs\"").contains("no scene `steps`"));
    assert!(with("replicates = 2", "replicates = 1").contains("replicate 1"));
    change(&new, |record| record.measuring = "other".into());
    assert!(refused(&old, &new).contains("not measured in the same way"));
    let told = gate(&old, &new, Some("psnr"), TERMS).unwrap_err().to_string();
    assert!(told.contains("`psnr`") && told.contains("relmse"), "{told}");
}
