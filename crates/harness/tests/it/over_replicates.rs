//! What is measured over all replicates of a level, from frames to page.

use noisefloor_questions::document;
use noisefloor_stats::Verdict;
use noisefloor_study::exhibit::{Document, Part};
use noisefloor_study::summary::ClaimSummary;

use crate::common::{Place, Watch, study};

const STUDY: &str = r#"
name = "replicates"
spp = [4, 16]
replicates = 4
viewer_spp = [16]
timing = { warmup = 0, runs = 1 }
[[scene]]
id = "flats"
synthetic = { image = "flats", law = "LAW", width = 64, height = 48, guides = "none" }
[[method]]
id = "mc"
label = "input"
[[method]]
id = "judge"
set = { offset = 0.1 }
"#;

fn of<'a>(claims: &'a [ClaimSummary], question: &str) -> Vec<&'a ClaimSummary> {
    claims.iter().filter(|claim| claim.id.question == question).collect()
}

fn tables(shown: &Document) -> Vec<&str> {
    shown.tables().into_iter().map(|table| table.id.as_str()).collect()
}

#[test]
fn three_questions_reach_claims_tables_charts_and_the_viewer() {
    let place = Place::new();
    let law = study(&STUDY.replace("\"LAW\"", "\"gaussian\", sd = 0.3"));
    let summary = place.run(&law, &Watch::default()).unwrap();
    let coverage = of(&summary.claims, "reference_free");
    assert_eq!(coverage.len(), 2 * 3, "levels × confidences");
    assert!(coverage.iter().all(|c| c.verdict != Verdict::Refuted && c.id.label == "input"), "{coverage:?}");
    let uniform = of(&summary.claims, "pit");
    assert_eq!(uniform.len(), 2);
    assert!(uniform.iter().all(|c| c.verdict == Verdict::Shown), "{uniform:?}");

    let shown = document(&summary);
    for id in ["reference-free-flats", "reference-free-flats-classes", "bias-variance-flats", "pit-flats"] {
        assert!(tables(&shown).contains(&id), "{id}: {:?}", tables(&shown));
    }
    let bias = shown.tables().into_iter().find(|table| table.id == "bias-variance-flats").unwrap();
    let words: Vec<&str> = bias.rows.iter().map(|row| row.cells[7].text.as_str()).collect();
    assert_eq!(words.len(), 4, "levels × rows");
    assert_eq!((words[1], words[3]), ("biased", "biased"), "the row that adds 0.1");
    let charts: Vec<&str> = shown.charts().iter().map(|chart| chart.id.as_str()).collect();
    assert!(charts.contains(&"bias-flats") && charts.contains(&"pit-flats"), "{charts:?}");

    let diagnostics = &summary.scenes[0].diagnostics;
    let bias = "bias, mean over replicates";
    let of_input: Vec<&str> = diagnostics["input"][&16].keys().map(String::as_str).collect();
    assert_eq!(of_input, [bias, "share of intervals that miss"]);
    let path = place.out().join(&diagnostics["judge"][&16][bias]);
    let map = noisefloor_io::read_image(&path).unwrap();
    let mean = map.plane(0).iter().map(|v| f64::from(*v)).sum::<f64>() / map.pixels() as f64;
    // 0.3/√(16 samples · 4 replicates · 64·48·3 values) is below 0.0004.
    assert!((mean - 0.1).abs() < 0.002, "{mean}");
    assert!(!diagnostics["input"].contains_key(&4), "the viewer shows one level");
}

#[test]
fn skewed_samples_are_refuted_where_the_truth_is_known() {
    let place = Place::new();
    let law = study(&STUDY.replace("\"LAW\"", "\"exponential\""));
    let summary = place.run(&law, &Watch::default()).unwrap();
    let at_4 = of(&summary.claims, "pit").into_iter().find(|c| c.id.spp == Some(4)).unwrap();
    assert_eq!(at_4.verdict, Verdict::Refuted, "{at_4:?}");
    let shown = document(&summary);
    let statistics = shown.exhibits.iter().find(|exhibit| exhibit.id == "statistics").unwrap();
    let headed =
        |text: &str| statistics.parts.iter().any(|p| matches!(p, Part::Heading(h) if h.contains(text)));
    assert!(headed("without a reference") && headed("Uniformity"));
}

#[test]
fn a_level_is_measured_again_where_its_outputs_are_others() {
    let place = Place::new();
    let law = STUDY.replace("\"LAW\"", "\"gaussian\", sd = 0.3");
    let bias = |toml: &str| {
        let summary = place.run(&study(toml), &Watch::default()).unwrap();
        let found = summary.answers["bias_variance"].as_array().unwrap().clone();
        let of_row =
            |f: &&serde_json::Value| f["label"] == "judge" && f["class"] == "all" && f["relative"] == false;
        found.iter().find(of_row).unwrap()["bias"]["value"].as_f64().unwrap()
    };
    let first = bias(&law);
    assert!((first - 0.1).abs() < 0.01, "{first}");
    // The same label, frames and reference, another method.
    let other = bias(&law.replace("offset = 0.1", "offset = 0.3"));
    assert!((other - 0.3).abs() < 0.01, "{other}");
    assert_eq!(bias(&law), first, "and back");
}
