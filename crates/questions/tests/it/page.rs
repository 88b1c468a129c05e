//! The document as a whole.

use std::collections::BTreeSet;

use noisefloor_questions::document;
use noisefloor_study::FIGURES;
use noisefloor_study::exhibit::{Part, RowKind};

use crate::fixture::{ROWS, SPP, study, summary};
use crate::look::{exhibit, table, texts};

#[test]
fn every_section_is_there_in_order() {
    let shown = document(&study());
    let ids: Vec<&str> = shown.exhibits.iter().map(|exhibit| exhibit.id.as_str()).collect();
    assert_eq!(
        ids,
        [
            "paper",
            "tables",
            "convergence",
            "speed",
            "statistics",
            "coverage",
            "bounds",
            "estimates",
            "flicker",
            "slopes",
            "methods",
            "about"
        ]
    );
    // Per scene: convergence twice, speed twice, coverage, bounds, estimates.
    assert_eq!(shown.charts().len(), 2 * 7);
}

#[test]
fn nothing_that_was_found_is_lost() {
    let texts = texts(&document(&study()));
    for text in [
        "The references have only 8 times the samples of the top level.",
        "At 64 spp, virtual-flash is tied for the lowest rMSE",
        "The replicates cannot tell it from guarded(virtual-flash)",
        "needs albedo and normal, which this frame does not have",
        "< 0.00040",
        "Levels off at rMSE 0.00010",
        "the reference has only 8 times the samples",
        "unproven",
        "0.999998",
        "0.0082 to 0.36",
        "larger gain than the paper's",
        "`virtual-flash` did not run here",
        "rMSE of virtual-flash over rMSE of mc",
        "Sequence turning, 3 frames",
        "Over that of mc",
        "0.00012 was subtracted",
        "too optimistic",
        "3 values without a finite estimate are left out",
        "difference −0.0010",
        "all runs: 61.0 ms to 73.2 ms",
        "Paired comparisons of rMSE",
        "rMSE by pixel class",
        "inner.window: 31",
        "48×36 pixels",
        "2048, 8 times the top level (fewer than the 16 that the coverage correction assumes)",
        "How to read this page",
    ] {
        assert!(texts.contains(text), "{text:?} is said");
    }
}

#[test]
fn names_of_tables_and_charts_are_unique_and_fit_for_files() {
    let titles =
        [("rings", "Rings"), ("odd name/№2", "Lamps"), ("odd name.№2", "Other"), ("rings-classes", "More")];
    let shown = document(&summary(&titles, &ROWS, (48, 36)));
    let tables: Vec<&str> = shown.tables().iter().map(|table| table.id.as_str()).collect();
    let charts: Vec<&str> = shown.charts().iter().map(|chart| chart.id.as_str()).collect();
    for ids in [&tables, &charts] {
        assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len(), "{ids:?}");
        let plain = |id: &&str| id.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
        assert!(ids.iter().all(plain), "{ids:?}");
    }
    for chart in shown.charts() {
        assert!(FIGURES.contains(&chart.kind.as_str()) && chart.id.starts_with(&chart.kind));
    }
    assert!(tables.contains(&"errors-rings-16") && charts.contains(&"convergence-rings-relmse"));
}

#[test]
fn every_row_of_a_table_fits_its_columns() {
    for table in document(&study()).tables() {
        for row in &table.rows {
            let fits = (1..=table.columns.len()).contains(&row.cells.len());
            assert!(fits, "{}: {:?}", table.id, row.cells);
        }
    }
}

#[test]
fn the_first_screen_shows_the_first_scene_and_the_best_of_all() {
    let shown = document(&study());
    assert_eq!(shown.front.charts.len(), 1);
    assert_eq!(shown.front.charts[0].id, "convergence-rings-relmse");
    assert!(shown.charts().contains(&&shown.front.charts[0]), "the same chart as in its section");
    let board = table(&shown, "board");
    assert_eq!(board.rows.len(), 2);
    let chosen: Vec<bool> = board.columns.iter().map(|column| column.chosen).collect();
    assert_eq!(chosen, [false, false, false, true, false]);
    let cell = &board.rows[0].cells[3];
    assert_eq!((cell.text.as_str(), cell.aside.as_str()), ("virtual-flash", "7.80× lower · tied with 1"));
    assert!(cell.number.is_some_and(|number| (number.value - 7.8).abs() < 0.1));
    let card = &shown.front.cards[0];
    assert_eq!(
        (card.scene.as_str(), card.shown.clone()),
        ("rings", vec!["mc".into(), "virtual-flash".into()])
    );
    assert!(card.sentences[0].contains("(95 % interval"), "{card:?}");
}

#[test]
fn a_guarded_row_looks_like_the_row_that_it_guards() {
    let shown = document(&study());
    let kinds: Vec<RowKind> = shown.rows.iter().map(|row| row.kind).collect();
    assert_eq!(kinds, [RowKind::Baseline, RowKind::Plain, RowKind::Guarded(1), RowKind::Plain]);
}

#[test]
fn the_gallery_has_the_levels_that_the_study_chose() {
    let shown = document(&study());
    let scene = &shown.gallery[0];
    let levels: Vec<u32> = scene.levels.iter().map(|level| level.spp).collect();
    assert_eq!(levels, [16, 64]);
    assert_eq!(scene.reference, "images/0-reference.exr");
    let rows = &scene.levels[1].rows;
    assert_eq!(rows.iter().map(|row| row.label.as_str()).collect::<Vec<_>>(), ROWS.map(|row| row.0));
    assert_eq!((rows[0].value.as_str(), rows[0].image.as_str()), ("0.0312", "images/0-0-64.exr"));
    assert_eq!(rows[1].diagnostics.len(), 2);
    let mut recorded = study();
    for scene in &mut recorded.scenes {
        scene.images.clear();
        scene.diagnostics.clear();
        scene.reference_image.clear();
    }
    assert!(document(&recorded).gallery.is_empty(), "a recorded study has no images");
}

#[test]
fn every_level_of_every_scene_can_be_chosen() {
    let shown = document(&study());
    let parts = &exhibit(&shown, "tables").unwrap().parts;
    let levels: Vec<u32> = parts
        .iter()
        .filter_map(|part| match part {
            Part::Level { spp, .. } => Some(*spp),
            _ => None,
        })
        .collect();
    assert_eq!(levels, [SPP, SPP].concat());
    assert!(parts.contains(&Part::LevelSwitch));
    assert_eq!((shown.levels.as_slice(), shown.chosen), (&SPP[..], Some(64)));
}

#[test]
fn a_study_without_results_still_has_a_document() {
    let mut empty = study();
    empty.cells.clear();
    empty.scenes.clear();
    empty.methods.clear();
    empty.coverage.clear();
    empty.bounds.clear();
    empty.estimates.clear();
    empty.flicker.clear();
    empty.paper.clear();
    empty.slopes.clear();
    empty.comparisons.clear();
    empty.skipped.clear();
    empty.study.spp.clear();
    empty.study.viewer_spp.clear();
    let shown = document(&empty);
    assert!(shown.charts().is_empty() && shown.front.board.is_none());
    assert!(exhibit(&shown, "about").is_some());
}
