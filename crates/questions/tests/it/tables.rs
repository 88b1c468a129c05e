//! Tables: texts for people, numbers for programs.

use noisefloor_questions::document;
use noisefloor_study::exhibit::{RowState, TableCell, Tone};
use noisefloor_study::summary::Interval;

use crate::fixture::{metric, study};
use crate::look::{row, table, tags};

#[test]
fn the_table_of_a_level_has_the_best_row_first_and_says_who_is_tied() {
    let shown = document(&study());
    let errors = table(&shown, "errors-rings-64");
    assert_eq!(tags(&errors), ["tied", "tied", "", ""]);
    let states: Vec<RowState> = errors.rows.iter().map(|row| row.state).collect();
    assert_eq!(states, [RowState::Best, RowState::Best, RowState::Plain, RowState::Absent]);
    assert_eq!(tags(&table(&shown, "errors-rings-16"))[..2], ["best", ""]);
    assert_eq!(
        errors.caption,
        "64 spp · 4 replicates · rendering takes 704 ms · reference of 2048 samples per pixel"
    );
}

#[test]
fn a_row_that_did_not_run_says_why_across_the_columns() {
    let errors = table(&document(&study()), "errors-rings-16");
    let skipped = row(&errors, "oidn");
    assert_eq!(skipped.cells.len(), 2, "the last cell spans the rest");
    assert_eq!(skipped.cells[1].text, "needs albedo and normal, which this frame does not have");
    assert_eq!(skipped.cells[1].tag.as_ref().map(|tag| tag.word.as_str()), Some("skipped"));
    let all = table(&document(&study()), "failures");
    assert_eq!(all.rows.len(), 1);
    assert_eq!(all.rows[0].cells[2].text, "4, 16, 64 and 256");
}

#[test]
fn the_baseline_has_no_ratio_to_itself() {
    let errors = table(&document(&study()), "errors-rings-16");
    let baseline = row(&errors, "mc");
    let texts: Vec<&str> = baseline.cells.iter().map(|cell| cell.text.as_str()).collect();
    assert_eq!(texts[2..5], ["", "", "–"]);
    let other = row(&errors, "virtual-flash");
    assert!(other.cells[2].forest.is_some() && other.cells[3].tag.is_none(), "{other:?}");
    let beyond = table(&document(&study()), "errors-rings-64");
    let word = row(&beyond, "virtual-flash").cells[3].tag.as_ref().map(|tag| tag.word.as_str());
    assert_eq!(word, Some("ext."), "eight times the samples were not rendered");
}

#[test]
fn an_error_below_the_floor_is_an_upper_limit() {
    let errors = table(&document(&study()), "errors-rings-256");
    let hidden = &row(&errors, "guarded(virtual-flash)").cells[1];
    assert_eq!(hidden.text, "< 0.00040");
    assert_eq!(hidden.number.and_then(|number| number.below), Some(4e-4));
}

#[test]
fn fewer_pixels_are_said_beside_the_value() {
    let mut study = study();
    study.cells.iter_mut().for_each(|cell| cell.pixels -= 5);
    let errors = table(&document(&study), "errors-rings-16");
    assert!(errors.rows[0].cells[1].aside.ends_with(", over 1723 of 1728 pixels"));
}

#[test]
fn a_balance_stands_in_the_full_table_where_it_was_measured_and_is_explained() {
    let mut balanced = study();
    balanced.study.metrics.push(metric("energy", "energy", "mean x / mean r", false, ""));
    let heads = |shown: &noisefloor_study::exhibit::Document| -> Vec<String> {
        table(shown, "metrics-rings-16").columns.into_iter().map(|column| column.head).collect()
    };
    let shown = document(&balanced);
    assert!(!heads(&shown).contains(&"energy".to_owned()), "records without it have no column");
    assert_eq!(row(&table(&shown, "metrics"), "energy").cells[2].text, "closer to 1");
    for cell in &mut balanced.cells {
        let value = cell.metrics["relmse"].clone();
        cell.metrics.insert("energy".into(), Interval { value: 0.9, ..value });
    }
    assert!(heads(&document(&balanced)).contains(&"energy".to_owned()));
}

#[test]
fn trimmed_and_whole_values_are_marked_as_not_comparable() {
    let all = table(&document(&study()), "metrics-rings-16");
    assert!(all.columns.iter().any(|column| column.head == "rMSE trimmed †"));
    assert!(all.notes[0].starts_with("† rMSE trimmed and rMSE cannot be compared"));
    let mut alone = study();
    alone.study.metrics = vec![metric("relmse", "rMSE", "a formula", true, "")];
    assert!(table(&document(&alone), "metrics-rings-16").notes.is_empty());
}

#[test]
fn a_cell_with_digits_carries_the_number_behind_them() {
    let shown = document(&study());
    let of_numbers = |cell: &&TableCell| {
        let first = cell.text.trim_start_matches(['−', '<', ' ']).chars().next();
        first.is_some_and(|c| c.is_ascii_digit())
    };
    for table in shown.tables() {
        for row in table.rows.iter().filter(|row| row.state != RowState::Absent) {
            let numbers = row.cells.iter().zip(&table.columns).filter(|(_, column)| !column.text);
            for (cell, column) in numbers {
                let range = cell.text.contains(" to ");
                assert!(
                    range || !of_numbers(&cell) || cell.number.is_some(),
                    "{} of {}: {}",
                    column.head,
                    table.id,
                    cell.text
                );
                assert!(cell.number.is_none_or(|number| !number.value.is_nan()));
            }
        }
    }
}

#[test]
fn columns_say_their_units() {
    let mut study = study();
    study.study.primary_metric = "psnr".into();
    let shown = document(&study);
    let unit = |id: &str, head: &str| {
        let table = table(&shown, id);
        table.columns.into_iter().find(|column| column.head.starts_with(head)).unwrap().unit
    };
    assert_eq!(unit("errors-rings-16", "PSNR"), "dB");
    assert_eq!(unit("errors-rings-16", "Denoise"), "s");
    assert_eq!(unit("metrics-rings-16", "PSNR"), "dB");
    assert_eq!(unit("coverage-rings", "spp"), "spp");
}

#[test]
fn what_is_said_of_a_promise_is_in_the_tone_of_its_cell() {
    let mut study = study();
    // Words that say something else decide nothing.
    study.slopes.iter_mut().for_each(|slope| slope.sentence = "fails plateaus holds".into());
    let shown = document(&study);
    let tones = |id: &str, column: usize| -> Vec<(String, Tone)> {
        let table = table(&shown, id);
        table.rows.iter().map(|row| (row.cells[column].text.clone(), row.cells[column].tone)).collect()
    };
    assert_eq!(
        tones("slopes-rings-relmse", 2),
        [
            ("consistent".to_owned(), Tone::Plain),
            ("plateaus".to_owned(), Tone::Bad),
            ("consistent".to_owned(), Tone::Plain)
        ]
    );
    let (calibrated, optimistic) =
        (("shown".to_owned(), Tone::Good), ("refuted: too optimistic".to_owned(), Tone::Bad));
    assert_eq!(tones("estimates-rings", 5)[..2], [calibrated, optimistic]);
    assert_eq!(tones("paper", 6)[0], ("shown".to_owned(), Tone::Good));
    assert_eq!(tones("paper", 7)[0], ("agrees".to_owned(), Tone::Plain));
    assert_eq!(tones("enclosures", 1), [("0.999998".to_owned(), Tone::Plain)]);
    let bounds = table(&shown, "bounds-rings");
    let printed = bounds.rows.iter().find(|row| row.cells[1].text.contains("two steps")).unwrap();
    assert_eq!(
        (printed.cells[3].tone, printed.cells[1].tag.as_ref().unwrap().word.as_str()),
        (Tone::Bad, "unproven")
    );
}

#[test]
fn marked_numbers_have_a_star_and_its_meaning() {
    let coverage = table(&document(&study()), "coverage-rings");
    assert!(row(&coverage, "256").cells[1].text.ends_with(" *"));
    assert_eq!(coverage.notes, ["* the reference has only 8 times the samples"]);
    assert!(
        row(&coverage, "4").cells[1].about.starts_with("Without the allowance for the reference's noise: ")
    );
}

#[test]
fn a_difference_that_stands_for_a_ratio_says_so() {
    let estimates = table(&document(&study()), "estimates-rings");
    assert!(row(&estimates, "256").cells[4].text.starts_with("difference −0.0010"));
    let left_out = &row(&estimates, "16").cells[5].aside;
    assert_eq!(left_out, "3 values without a finite estimate are left out");
}
