//! How cells end, and what is refused before any work.

use std::path::Path;

use crate::common::{Place, Watch, records, study};
use noisefloor_frame::FindingKind;
use noisefloor_questions::violations;
use noisefloor_study::record::Outcome;
use noisefloor_study::{Study, StudyError};

fn with_rows(rows: &str) -> Study {
    let start = crate::common::SMALL.split("[[method]]").next().unwrap();
    study(&format!("{start}\n[[method]]\nid = \"mc\"\n{rows}"))
}

fn row(id: &str) -> String {
    format!("[[method]]\nid = \"{id}\"\n")
}

#[test]
fn methods_that_cannot_run_are_skipped_or_fail_with_a_reason_and_the_study_goes_on() {
    let place = Place::new();
    let rows = ["needy", "fails", "panics", "shrinks", "blur"].map(row).concat();
    let mut study = with_rows(&rows);
    study.scenes[0].source = crate::common::study(
        &crate::common::SMALL.replace("height = 16", "height = 16, guides = \"no-flash\""),
    )
    .scenes[0]
        .source
        .clone();
    let summary = place.run(&study, &Watch::default()).unwrap();
    let told: Vec<(&str, &str, &[u32])> =
        summary.skipped.iter().map(|s| (s.label.as_str(), s.status.name(), s.spp.as_slice())).collect();
    let both: &[u32] = &[4, 16];
    assert_eq!(
        told,
        [
            ("needy", "skipped", both),
            ("fails", "failed", both),
            ("panics", "failed", both),
            ("shrinks", "failed", both)
        ]
    );
    let reason = |label: &str| &summary.skipped.iter().find(|s| s.label == label).unwrap().reason;
    assert!(reason("needy").contains("virtual flash image") && !reason("needy").contains("half"));
    assert!(reason("fails").contains("weight in 7 pixels"));
    assert!(reason("panics").contains("no reason"));
    assert!(reason("shrinks").contains("1×1×3") && reason("shrinks").contains("24×16×3"));
    assert_eq!(summary.cells.iter().filter(|c| c.label == "blur").count(), 2);
    assert!(
        summary.warnings.iter().any(|w| w.to_string().contains("panics failed on steps")),
        "{:?}",
        summary.warnings
    );
    // What was skipped stays so; what failed is tried again.
    let watch = Watch::default();
    place.run(&study, &watch).unwrap();
    assert_eq!(watch.cells(), 3 * 4);
}

#[test]
fn values_that_are_not_finite_are_counted_and_left_out() {
    let place = Place::new();
    let summary = place.run(&with_rows(&row("nan")), &Watch::default()).unwrap();
    let all = records(&place.out());
    for pair in all.chunks(2) {
        assert_eq!(pair[1].non_finite.output_values, 1);
        assert_eq!(pair[1].outcome, Outcome::Done);
        let [mc, nan] = [0, 1].map(|k| pair[k].metrics["mse"].unwrap());
        // One pixel of 384 is missing, whose squared error is not far from the others'.
        assert!((mc / nan - 1.0).abs() < 0.1, "{mc} {nan}");
    }
    let of_outputs: Vec<_> =
        summary.findings.iter().filter(|f| f.kind == FindingKind::NonFiniteOutput).collect();
    let told: f64 = of_outputs.iter().filter_map(|f| f.value).sum();
    assert_eq!(told, all.len() as f64 / 2.0, "every output of the row has one: {of_outputs:?}");
    let cells = summary.cells.iter().filter(|cell| cell.label == "nan").count();
    assert_eq!(of_outputs.len(), cells, "one record per row and level: {of_outputs:?}");
    assert!(of_outputs[0].subject.starts_with("nan on steps at "), "{of_outputs:?}");
    assert!(
        !summary.warnings.iter().any(|w| w.to_string().contains("not finite")),
        "said once: {:?}",
        summary.warnings
    );
    let builds = summary.warnings.iter().filter(|w| w.to_string().contains("debug build")).count();
    assert_eq!(builds, usize::from(cfg!(debug_assertions)));
}

#[test]
fn a_violated_enclosure_is_the_first_warning() {
    let place = Place::new();
    let rows = "[[method]]\nid = \"blur\"\nset = { boast = true }\n";
    let summary = place.run(&with_rows(rows), &Watch::default()).unwrap();
    assert_eq!(violations(&summary).len(), 2);
    assert!(summary.warnings[0].to_string().contains("claims never to leave"), "{:?}", summary.warnings);
    assert!(records(&place.out())[1].enclosures.iter().all(|e| !e.held && e.worst_ratio > 1.0));
    let honest =
        place.run_to(&place.root.path().join("honest"), &crate::common::small(), &Watch::default()).unwrap();
    assert_eq!(violations(&honest), Vec::<String>::new());
}

#[test]
fn unknown_names_are_told_before_any_work_with_the_nearest() {
    let place = Place::new();
    let error = place.run(&with_rows(&row("blurr")), &Watch::default()).unwrap_err().to_string();
    assert!(error.contains("`blurr`") && error.contains("blur") && error.contains("line "), "{error}");
    let error = with_rows("[[method]]\nid = \"blur\"\nset = { radios = 2 }\n");
    let error = place.run(&error, &Watch::default()).unwrap_err().to_string();
    assert!(error.contains("radios") && error.contains("radius (0 to 20 px)"), "{error}");
    let error = with_rows("[[method]]\nid = \"blur\"\nset = { radius = 21 }\n");
    let error = place.run(&error, &Watch::default()).unwrap_err().to_string();
    assert!(error.contains("21") && error.contains("0 to 20 px"), "{error}");
    assert!(!place.out().exists());
}

#[test]
fn mistakes_in_a_study_file_are_told_with_file_and_line() {
    let table = [
        ("spp = [4, 16]", "spp = [16, 4]", 3, "ascending"),
        ("spp = [4, 16]", "spp = []", 3, "at least one"),
        ("spp = [4, 16]", "spp = [4, -16]", 3, "spp"),
        ("replicates = 2", "replicas = 2", 4, "unknown field `replicas`"),
        ("replicates = 2", "replicates = 0", 4, "1 to 10000"),
        ("replicates = 2", "replicates = \"two\"", 4, "a number, or a table"),
        ("replicates = 2", "replicates = 2\nmetrics = [\"mse\", \"flip\"]", 5, "ssim"),
        ("replicates = 2", "replicates = 2\nprimary_metric = \"flip\"", 5, "relmse"),
        ("replicates = 2", "replicates = 2\nprimary_metric = \"energy\"", 5, "psnr, ssim"),
        ("replicates = 2", "replicates = 2\ncoverage = [95]", 5, "between 0 and 1"),
        ("replicates = 2", "replicates = 2\nfilter = \"gauss\"", 5, "point"),
        ("replicates = 2", "replicates = 2\nfigures = [\"pie\"]", 5, "coverage, intervals, bounds"),
        ("replicates = 2", "replicates = 2\nreference = { spp = 100 }", 5, "multiple of 8"),
        ("id = \"steps\"", "id = \"st/eps\"", 6, "letters"),
        ("law = \"gaussian\", sd = 0.5", "law = \"gaussian\", sd = -1", 8, "`sd` is -1"),
        ("id = \"blur\"", "id = \"mc\"", 11, "differ from each other"),
    ];
    for (from, to, line, part) in table {
        let text = crate::common::SMALL.replace(from, to);
        let error = Study::from_toml(&text, Path::new("bad.toml")).unwrap_err().to_string();
        assert!(error.contains(&format!("bad.toml, line {line}")) && error.contains(part), "{to}: {error}");
    }
    let text = crate::common::SMALL.replace("id = \"steps\"", "id = \"cornel\"");
    let text: String = text.lines().filter(|l| !l.starts_with("synthetic")).collect::<Vec<_>>().join("\n");
    let error = Study::from_toml(&text, Path::new("bad.toml")).unwrap_err();
    assert!(matches!(error, StudyError::Scene { .. }) && error.to_string().contains("cornell"), "{error}");
}
