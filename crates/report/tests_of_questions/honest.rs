//! The page says how far a study got, what is not comparable, and what the replicates cannot tell.

mod fixture;

use std::fs;
use std::path::Path;

use fixture::{ROWS, metric, summary};
use noisefloor_frame::{Finding, FindingKind};
use noisefloor_harness::summary::{Missing, Progress, Summary};
use noisefloor_report::{ReportError, ReportOptions, write_recording, write_report_with};

const TITLES: [(&str, &str); 2] = [("rings", "Rings"), ("lamps", "Lamps")];

fn study() -> Summary {
    summary(&TITLES, &ROWS, (48, 36))
}

fn page(summary: &Summary) -> String {
    let dir = tempfile::tempdir().unwrap();
    let options = ReportOptions { png: false, ..ReportOptions::default() };
    let files = write_report_with(dir.path(), summary, &options).unwrap();
    fs::read_to_string(files.index).unwrap()
}

/// The answer boxes of the first screen, one line each.
fn answers(html: &str) -> Vec<String> {
    html.split("<div class=\"answer ")
        .skip(1)
        .map(|rest| rest.split("</div>").next().unwrap().to_owned())
        .collect()
}

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
        spp: fixture::SPP.to_vec(),
        all_levels: true,
        rows: Vec::new(),
        replicates: Vec::new(),
        cells: 48,
    };
    study.progress = Some(Progress { planned: 96, finished: 48, missing: vec![missing] });
    let html = page(&study);
    for text in [
        "Unfinished: 48 of 96 cells",
        "all of scene lamps (48 cells)",
        "So far, at 64 spp,",
        "48 of 96 cells ended",
    ] {
        assert!(html.contains(text), "{text:?} is in the page");
    }
    for text in ["Every method ran on every frame", "on all", "All outputs are finite."] {
        assert!(!html.contains(text), "{text:?} is not true of it");
    }
    let green = answers(&html).into_iter().filter(|a| a.starts_with("good")).collect::<Vec<_>>();
    assert!(green.is_empty(), "nothing is shown as kept: {green:?}");
    let whole = page(&self::study());
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
    study.progress = Some(Progress { planned: 96, finished: 93, missing: vec![missing] });
    for cell in study.cells.iter_mut().filter(|cell| cell.scene == "rings" && cell.spp == 16) {
        cell.replicates = 3;
    }
    let html = page(&study);
    assert!(html.contains(">first so far<") && html.contains(">best<"), "one level of many is unfinished");
    assert!(html.contains("Numbers are over 3 of 4 replicates"));
}

#[test]
fn a_tie_is_in_the_headline() {
    let mut study = study();
    for comparison in study.comparisons.iter_mut().filter(|c| c.spp == 64) {
        comparison.best_group = comparison.ranking[..2].to_vec();
    }
    let html = page(&study);
    let lead = &answers(&html)[0];
    assert!(
        lead.contains(
            "virtual-flash and guarded(virtual-flash) are tied for the lowest rMSE on all 2 scenes"
        ),
        "{lead}"
    );
    assert!(lead.contains("cannot tell them apart") && !lead.contains("has the lowest"), "{lead}");
    // One scene with a clear winner, one with a tie.
    study.comparisons.iter_mut().filter(|c| c.scene == "lamps").for_each(|c| c.best_group.truncate(1));
    let first =
        study.comparisons.iter().find(|c| c.scene == "lamps" && c.spp == 64).unwrap().ranking[0].clone();
    let lead = answers(&page(&study)).remove(0);
    assert!(lead.contains(&format!("{first} has the lowest rMSE on 1 of 2 scenes and is tied")), "{lead}");
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
    let html = page(&study);
    let lead = &answers(&html)[0];
    assert!(lead.contains("guarded(virtual-flash) has the lowest rMSE on all 2 scenes"), "{lead}");
    assert!(lead.contains("Not ranked, for the reasons below the tables: virtual-flash on Rings"), "{lead}");
    assert!(html.contains(">not ranked<") && html.contains("is not ranked: ran on 1 of 4 replicates"));
    assert!(html.contains("other frames or fewer pixels"), "plots mark its points");
}

#[test]
fn a_rate_is_drawn_for_metrics_that_have_one_only() {
    let law = |study: &Summary| {
        let html = page(study);
        (
            html.contains("c / n, fitted to mc") || html.contains("c / √n, fitted to mc"),
            html.contains("Equal error,"),
        )
    };
    assert_eq!(law(&study()), (true, true));
    let mut scored = study();
    scored.study.primary_metric = "psnr".into();
    assert_eq!(law(&scored), (false, false), "a score has no rate");
    let mut trimmed = study();
    trimmed.study.primary_metric = "relmse_trimmed".into();
    assert_eq!(law(&trimmed), (false, false), "nor has a trimmed mean");
    // Frames that are not independent samples: the analysis fitted no constant.
    let mut even = study();
    even.cells.iter_mut().for_each(|cell| cell.equal_error.clear());
    assert!(!law(&even).0);
}

#[test]
fn a_balance_stands_in_the_full_table_where_it_was_measured_and_is_explained() {
    let mut balanced = study();
    balanced.study.metrics.push(metric("energy", "energy", "mean x / mean r", false, ""));
    let column = "<th scope=\"col\">energy</th>";
    let html = page(&balanced);
    assert!(html.contains("closer to 1") && !html.contains(column), "records without it have no column");
    for cell in &mut balanced.cells {
        let value = cell.metrics["relmse"].clone();
        cell.metrics.insert("energy".into(), noisefloor_harness::summary::Interval { value: 0.9, ..value });
    }
    assert!(page(&balanced).contains(column));
}

#[test]
fn trimmed_and_whole_values_are_marked_as_not_comparable() {
    let html = page(&study());
    assert!(html.contains("rMSE trimmed †") && html.contains("† rMSE trimmed and rMSE cannot be compared"));
    let mut alone = study();
    alone.study.metrics = vec![metric("relmse", "rMSE", "a formula", true, "")];
    assert!(!page(&alone).contains('†'));
}

#[test]
fn costs_of_frames_of_different_sizes_are_told_apart() {
    let mut study = study();
    let cost = |study: &Summary| {
        answers(&page(study)).into_iter().find(|a| a.contains("What does it cost?")).unwrap()
    };
    assert_eq!(cost(&study).matches("a frame of 48×36").count(), 1);
    study.scenes[1].width = 480;
    study.scenes[1].height = 360;
    for cell in study.cells.iter_mut().filter(|cell| cell.scene == "lamps") {
        cell.denoise_seconds = cell.denoise_seconds.map(|s| 100.0 * s);
    }
    let told = cost(&study);
    assert!(
        told.contains("61.0 ms (virtual-flash) to 64.0 ms (guarded(virtual-flash)) a frame of 48×36"),
        "{told}"
    );
    assert!(
        told.contains("6.71 s (virtual-flash) to 7.04 s (guarded(virtual-flash)) a frame of 480×360"),
        "{told}"
    );
}

#[test]
fn exact_truth_and_an_unknown_reference_have_their_names() {
    let mut study = study();
    study.scenes[0].reference.spp = 0;
    study.scenes[0].reference.exact = true;
    study.scenes[1].reference.spp = 0;
    let html = page(&study);
    assert!(
        html.contains("exact truth") && html.contains("reference of an unknown number of samples per pixel")
    );
    assert!(!html.contains("0 samples per pixel") && !html.contains("0 spp ·"));
}

#[test]
fn findings_come_before_warnings() {
    let mut study = study();
    study.findings = vec![Finding::new(FindingKind::SharedSeed, "rings", "frame and reference share a seed")];
    let html = page(&study);
    let at = |text: &str| html.find(text).unwrap_or_else(|| panic!("{text:?} is in the page"));
    assert!(at("Read this first") < at("rings: frame and reference share a seed"));
    assert!(at("rings: frame and reference share a seed") < at("The references have only 8 times"));
}

#[test]
fn what_was_not_tested_is_never_green() {
    let mut study = study();
    study.bounds.clear();
    study.cells.iter_mut().for_each(|cell| cell.enclosure_worst_ratio = None);
    let green = |study: &Summary| {
        let all = answers(&page(study));
        all.into_iter().filter(|a| a.starts_with("good")).collect::<Vec<_>>()
    };
    assert!(
        green(&study).iter().all(|a| !a.contains("statistical claims")),
        "coverage alone is no promise kept"
    );
    study.cells.clear();
    study.skipped.clear();
    study.progress = None;
    assert!(green(&study).is_empty(), "nothing ran");
}

fn recording(dir: &Path, readme: &str) -> Result<String, ReportError> {
    fs::write(dir.join("README.md"), readme).unwrap();
    write_recording(dir, &study(), (dir, &study()))?;
    Ok(fs::read_to_string(dir.join("README.md")).unwrap())
}

#[test]
fn tables_of_a_readme_are_made_from_the_summary() {
    let dir = tempfile::tempdir().unwrap();
    let text = "# Title\n\nMine.\n\n<!-- noisefloor:table levels scenes=rings spp=\"4; 64\" rows=\"mc; virtual-flash\" -->\nold\n\
                <!-- /noisefloor -->\n\n![a](plots/convergence-rings-relmse.svg)\n\n\
                <!-- noisefloor:table machine -->\n<!-- /noisefloor -->\nEnd.\n";
    let made = recording(dir.path(), text).unwrap();
    assert!(made.starts_with("# Title\n\nMine.\n") && made.ends_with("\nEnd.\n") && !made.contains("old"));
    assert!(
        made.contains("| samples per pixel | `mc` | `virtual-flash` |\n| --- | ---: | ---: |\n| 4 | "),
        "{made}"
    );
    assert!(made.contains("| 64 | 0.0312") && !made.contains("| 16 |"), "{made}");
    assert!(made.contains("All 96 cells of the study ended."), "{made}");
    // Only the plot that it shows, and the same again.
    let plots: Vec<_> =
        fs::read_dir(dir.path().join("plots")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(plots, ["convergence-rings-relmse.svg"]);
    assert_eq!(recording(dir.path(), &made).unwrap(), made);
}

#[test]
fn a_marker_that_cannot_be_obeyed_is_an_error_with_its_line() {
    let dir = tempfile::tempdir().unwrap();
    let end = "<!-- /noisefloor -->";
    for (marker, part) in [
        ("<!-- noisefloor:table pie -->", "no table `pie`"),
        ("<!-- noisefloor:table levels scenes=nowhere -->", "no scene `nowhere`"),
        ("<!-- noisefloor:table levels color=red -->", "no key `color`"),
        ("<!-- noisefloor:table levels spp=5 -->", "no level `5`"),
    ] {
        let told = recording(dir.path(), &format!("a\nb\n{marker}\n{end}\n")).unwrap_err().to_string();
        assert!(told.contains("line 3") && told.contains(part), "{told}");
    }
    let told = recording(dir.path(), "<!-- noisefloor:table machine -->\n").unwrap_err().to_string();
    assert!(told.contains("line 1"), "{told}");
}

#[test]
fn without_a_readme_one_is_begun() {
    let dir = tempfile::tempdir().unwrap();
    let made = write_recording(dir.path(), &study(), (dir.path(), &study())).unwrap();
    let text = fs::read_to_string(made.readme).unwrap();
    assert!(text.contains("Rings & lamps") && text.contains("| row | rings, 4 spp |"), "{text}");
}

#[test]
fn a_panel_is_made_from_the_images_of_the_run_and_stays_without_them() {
    let (run, to) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    fixture::write_images(run.path(), &study());
    let text = "<!-- noisefloor:panel scenes=rings spp=64 show=\"mc; virtual-flash; reference\" shrink=2 -->\n\
                <!-- /noisefloor -->\n";
    fs::write(to.path().join("README.md"), text).unwrap();
    write_recording(to.path(), &study(), (run.path(), &study())).unwrap();
    let readme = fs::read_to_string(to.path().join("README.md")).unwrap();
    assert!(readme.contains("](panel.png)"), "{readme}");
    let first = fs::read(to.path().join("panel.png")).unwrap();
    let decoder = png::Decoder::new(std::io::Cursor::new(first.clone())).read_info().unwrap();
    // Three pictures of 24×18 with 4 pixels between them, below a line of 22.
    assert_eq!((decoder.info().width, decoder.info().height), (3 * 28, 40));
    let mut recorded = study();
    recorded.recorded = true;
    recorded.scenes.iter_mut().for_each(|scene| scene.images.clear());
    write_recording(to.path(), &recorded, (run.path(), &recorded)).unwrap();
    assert_eq!(fs::read_to_string(to.path().join("README.md")).unwrap(), readme);
    assert_eq!(fs::read(to.path().join("panel.png")).unwrap(), first);
}
