//! A document says how far a study got, what is not comparable, and what the replicates cannot tell.

use noisefloor_frame::{Finding, FindingKind};
use noisefloor_questions::document;
use noisefloor_study::exhibit::{RowState, Tone};
use noisefloor_study::summary::{Completion, Missing, Warning, WarningKind};

use crate::fixture::{SPP, study};
use crate::look::{row, table, tags, texts, told};

#[test]
fn an_unfinished_study_is_marked_and_calls_nothing_best() {
    let mut study = study();
    // The second scene never began.
    study.scenes.truncate(1);
    study.cells.retain(|cell| cell.scene == "rings");
    study.comparisons.retain(|c| c.scene == "rings");
    study.skipped.clear();
    let missing = Missing {
        scene: "lamps".into(),
        spp: SPP.to_vec(),
        all_levels: true,
        rows: Vec::new(),
        replicates: Vec::new(),
        cells: 48,
    };
    study.progress = Some(Completion { planned: 96, finished: 48, missing: vec![missing] });
    let shown = document(&study);
    let texts = texts(&shown);
    for text in [
        "Unfinished: 48 of 96 cells",
        "all of scene lamps (48 cells)",
        "So far, at 64 spp,",
        "48 of 96 cells ended",
    ] {
        assert!(texts.contains(text), "{text:?} is said");
    }
    for text in ["Every method ran on every frame", "on all", "All outputs are finite."] {
        assert!(!texts.contains(text), "{text:?} is not true of it");
    }
    assert_eq!(shown.banners[0].tone, Tone::Bad);
    let green = shown.front.answers.iter().filter(|a| a.tone == Tone::Good).count();
    assert_eq!(green, 0, "nothing is shown as kept");
    let whole = self::texts(&document(&crate::fixture::study()));
    assert!(!whole.contains("Unfinished") && !whole.contains("So far"));
}

#[test]
fn a_level_with_missing_cells_has_a_first_so_far_and_no_best() {
    let mut study = study();
    let missing = Missing {
        scene: "rings".into(),
        spp: vec![16],
        all_levels: false,
        rows: Vec::new(),
        replicates: vec![3],
        cells: 3,
    };
    study.progress = Some(Completion { planned: 96, finished: 93, missing: vec![missing] });
    for cell in study.cells.iter_mut().filter(|cell| cell.scene == "rings" && cell.spp == 16) {
        cell.replicates = 3;
    }
    let shown = document(&study);
    let unfinished = table(&shown, "errors-rings-16");
    assert_eq!(tags(&unfinished)[0], "first so far");
    assert!(unfinished.notes.iter().any(|n| n.contains("Numbers are over 3 of 4 replicates")));
    assert_eq!(tags(&table(&shown, "errors-lamps-16"))[0], "best", "one level of many is unfinished");
    let board = table(&shown, "board");
    let asides: Vec<&str> = row(&board, "Rings").cells[1..].iter().map(|c| c.aside.as_str()).collect();
    assert!(asides[1].starts_with("so far · ") && !asides[0].contains("so far"), "{asides:?}");
}

#[test]
fn a_row_that_is_left_out_is_shown_below_with_its_reason_and_wins_nothing() {
    let mut study = study();
    let reason = "ran on 1 of 4 replicates, skipped on the others (needs half buffers)";
    for cell in study.cells.iter_mut().filter(|cell| cell.label == "virtual-flash") {
        cell.left_out = Some(reason.into());
        cell.equal_error.clear();
        cell.replicates = 1;
    }
    for comparison in &mut study.comparisons {
        comparison.ranking.retain(|label| label != "virtual-flash");
        comparison.best_group = comparison.ranking[..1].to_vec();
        comparison.pairs.clear();
    }
    let lead = told(&study, "closest to the truth");
    assert!(lead.contains("guarded(virtual-flash) has the lowest rMSE on all 2 scenes"), "{lead}");
    assert!(lead.contains("Not ranked, for the reasons below the tables: virtual-flash on Rings"), "{lead}");
    let shown = document(&study);
    let errors = table(&shown, "errors-rings-64");
    let last = row(&errors, "virtual-flash");
    assert_eq!(last.cells[0].tag.as_ref().map(|tag| tag.word.as_str()), Some("not ranked"));
    assert_eq!(last.state, RowState::Plain);
    assert!(errors.notes.iter().any(|n| n.contains("virtual-flash is not ranked: ran on 1 of 4 replicates")));
    let doubtful = |id: &str| {
        let chart = crate::look::chart(&shown, id);
        let series = chart.panels[0].series.iter().find(|s| s.name == "virtual-flash").unwrap();
        series.points.iter().all(|point| point.doubtful)
    };
    assert!(doubtful("convergence-rings-relmse") && doubtful("speed-rings-total"));
}

#[test]
fn a_single_replicate_calls_no_row_best_or_tied() {
    let mut study = study();
    study.scenes.iter_mut().for_each(|s| s.replicates.values_mut().for_each(|n| *n = 1));
    study.cells.iter_mut().for_each(|cell| cell.replicates = 1);
    let shown = document(&study);
    for spp in SPP {
        let errors = table(&shown, &format!("errors-rings-{spp}"));
        assert!(tags(&errors).iter().all(|tag| tag.is_empty()), "{:?}", tags(&errors));
        assert!(errors.notes[0].starts_with("One replicate: rows cannot be told apart"));
    }
    assert!(!texts(&shown).contains("tied with"));
}

#[test]
fn findings_come_before_warnings_and_stand_out() {
    let mut study = study();
    study.findings = vec![Finding::new(FindingKind::SharedSeed, "rings", "frame and reference share a seed")];
    let banner = document(&study).banners.into_iter().find(|b| b.title == "Read this first").unwrap();
    assert_eq!((banner.strong, banner.lines.len()), (1, 2));
    assert_eq!(banner.lines[0], "rings: frame and reference share a seed");
    assert!(banner.lines[1].contains("The references have only 8 times"));
}

#[test]
fn the_same_warning_about_two_scenes_is_one_line() {
    let mut study = study();
    study.warnings =
        ["rings", "lamps"].map(|scene| Warning::about(WarningKind::ShortReference, scene, "short")).to_vec();
    assert_eq!(document(&study).banners[0].lines, ["rings and lamps: short"]);
}

#[test]
fn a_recorded_study_says_where_its_images_are() {
    let mut study = study();
    assert!(document(&study).banners.iter().all(|banner| !banner.lead.contains("recorded")));
    study.recorded = true;
    let banners = document(&study).banners;
    let told = &banners.last().unwrap().lead;
    assert!(told.contains("no images: the command noisefloor run fixture --size 160x120 makes them"));
}

#[test]
fn exact_truth_and_an_unknown_reference_have_their_names() {
    let mut study = study();
    study.scenes[0].reference.spp = 0;
    study.scenes[0].reference.exact = true;
    study.scenes[1].reference.spp = 0;
    let shown = document(&study);
    assert!(table(&shown, "errors-rings-16").caption.ends_with("exact truth"));
    let unknown = table(&shown, "errors-lamps-16").caption;
    assert!(unknown.ends_with("reference of an unknown number of samples per pixel"), "{unknown}");
    assert!(!texts(&shown).contains("\nreference of 0 samples") && !unknown.contains(" 0 samples"));
}
