//! Ratios beside those that the source work reports.

use std::path::Path;

use noisefloor_harness::reanalyse;
use noisefloor_study::summary::{PaperResult, Source};
use noisefloor_study::{PaperRatio, Study, StudyError};

use crate::common::{Place, Watch, study};

/// Two scenes without edges, where a blur over 3×3 pixels leaves a ninth of the squared error, and more at the border.
fn text(replicates: u32, compare: &str) -> String {
    format!(
        r#"
name = "beside"
spp = [4, 16]
replicates = {replicates}
primary_metric = "mse"
timing = {{ warmup = 0, runs = 1 }}
[[scene]]
id = "one"
synthetic = {{ image = "constant", law = "gaussian", sd = 0.5, width = 64, height = 48, guides = "none" }}
[[scene]]
id = "two"
synthetic = {{ image = "constant", law = "gaussian", sd = 0.25, width = 64, height = 48, guides = "none" }}
[[method]]
id = "mc"
[[method]]
id = "blur"
[[method]]
id = "fails"
{compare}
"#
    )
}

/// The blur's squared error over the input's: mean over pixels of 1 over the size of the window inside the image.
fn truth() -> f64 {
    let along = |n: f64| ((n - 2.0) / 3.0 + 1.0) / n; // two border pixels of 1/2 each
    along(64.0) * along(48.0)
}

fn run(replicates: u32, compare: &str) -> (Place, Vec<PaperResult>) {
    let place = Place::new();
    let summary = place.run(&study(&text(replicates, compare)), &Watch::default()).unwrap();
    (place, summary.paper)
}

#[test]
fn the_ratio_of_two_rows_stands_beside_the_papers_on_every_scene_and_level() {
    let (place, found) = run(
        4,
        r#"
[[compare]]
what = "blur over plain"
row = "blur"
over = "mc"
paper = 0.5
source = "Fig. 7"
"#,
    );
    let shape: Vec<(&str, u32)> = found.iter().map(|r| (r.scene.as_str(), r.spp)).collect();
    assert_eq!(shape, [("one", 4), ("one", 16), ("two", 4), ("two", 16)]);
    for result in &found {
        let ours = result.ours.as_ref().unwrap();
        // 64·48·3 squared normal errors in 4 replicates below, about a ninth of them independent above.
        let sd = (2.0f64 / (64.0 * 48.0 * 3.0 * 4.0) * (1.0 + 9.0)).sqrt();
        assert!((ours.value / truth() - 1.0).abs() < 5.0 * sd, "{} against {}", ours.value, truth());
        assert_eq!((ours.source, ours.n), (Source::Replicates, 4));
        assert_eq!(result.verdict.name(), "larger gain than the paper's");
        assert_eq!((result.paper, result.source.as_str(), &result.reason), ([0.5, 0.5], "Fig. 7", &None));
        assert_eq!(result.metric, "mse", "the primary metric unless another is named");
    }
    assert_eq!(reanalyse(&place.out(), false).unwrap().paper, found);
}

#[test]
fn scenes_levels_ranges_and_single_numbers_are_the_studys_choice() {
    let (_place, found) = run(
        3,
        r#"
[[compare]]
what = "by scene"
row = "mc"
over = "blur"
metric = "rmse"
spp = [16]
paper_by_scene = { two = 0.5 }
[[compare]]
what = "range"
row = "blur"
over = "mc"
spp = [4]
scenes = ["one"]
paper = [0.05, 0.2]
[[compare]]
what = "absent"
row = "fails"
over = "mc"
spp = [4]
paper = 1
paper_by_scene = { one = [0.1, 0.2] }
"#,
    );
    let told: Vec<(&str, &str, u32, [f64; 2], &str)> =
        found.iter().map(|r| (r.what.as_str(), r.scene.as_str(), r.spp, r.paper, r.verdict.name())).collect();
    assert_eq!(
        told,
        [
            ("by scene", "two", 16, [0.5, 0.5], "opposite sign"),
            ("range", "one", 4, [0.05, 0.2], "agrees"),
            ("absent", "one", 4, [0.1, 0.2], "no number"),
            ("absent", "two", 4, [1.0, 1.0], "no number"),
        ]
    );
    let root = found[0].ours.as_ref().unwrap().value;
    assert!((root * root * truth() - 1.0).abs() < 0.2, "the root's ratio, the other way up: {root}");
    assert_eq!(found[2].reason.as_deref(), Some("`fails` did not run here"));
    assert!(found[2].ours.is_none());
}

#[test]
fn one_replicate_has_an_interval_over_the_input_and_none_between_other_rows() {
    let compare = |row: &str, over: &str| {
        format!(
            "[[compare]]\nwhat = \"x\"\nrow = \"{row}\"\nover = \"{over}\"\nspp = [4]\nscene = [\"one\"]\npaper = 9.0\n"
        )
    };
    let (_place, found) = run(1, &[compare("blur", "mc"), compare("mc", "blur")].concat());
    let of = |k: usize| found[k].ours.as_ref().unwrap().source;
    assert_eq!((of(0), found[0].verdict.name()), (Source::WithinImage, "opposite sign"));
    assert_eq!((of(1), found[1].verdict.name()), (Source::None, "undecided"));
}

#[test]
fn comparisons_that_make_no_sense_are_refused_with_their_line() {
    let good = "what = \"x\"\nrow = \"blur\"\nover = \"mc\"\npaper = 0.5";
    let and = |more: &str| format!("{good}\n{more}");
    let but = |from: &str, to: &str| good.replace(from, to);
    let both = "scene = [\"one\", \"two\"]\npaper_by_scene = { two = 1.0 }";
    let table = [
        (but("\"blur\"", "\"blurr\""), "row", "`blurr`", "mc, blur, fails"),
        (but("\"mc\"", "\"me\""), "over", "`me`", "the label of a row"),
        (but("\"mc\"", "\"blur\""), "over", "`blur`", "another row"),
        (but("\"x\"", "\" \""), "what", "` `", "some text"),
        (and("metric = \"psnr\""), "metric", "`psnr`", "an error: mse, rmse"),
        (and("metric = \"mmse\""), "metric", "`mmse`", "an error: mse, rmse"),
        (and("spp = [16, 17]"), "spp", "17", "levels of the scenes"),
        (and("scene = [\"three\"]"), "scene", "`three`", "one, two"),
        (and("paper_by_scene = { three = 1.0 }"), "paper_by_scene", "`three`", "one, two"),
        (
            and("scene = [\"one\"]\npaper_by_scene = { two = 1.0 }"),
            "paper_by_scene",
            "`two`",
            "scenes that `scene` lists: one",
        ),
        (but("0.5", "0.0"), "paper", "0", "positive ratio"),
        (but("0.5", "[0.5, 0.4]"), "paper", "[0.5, 0.4]", "a range"),
        (but("0.5", "[0.5, inf]"), "paper", "[0.5, inf]", "a range"),
        (but("\npaper = 0.5", ""), "paper", "absent", "`paper_by_scene`"),
        (but("paper = 0.5", both), "paper", "absent", "a number for `one`"),
        (but("paper = 0.5", "scene = [\"one\"]"), "paper", "absent", "a number for `one`"),
    ];
    for (compare, field, value, allowed) in table {
        let text = text(2, &format!("[[compare]]\n{compare}"));
        let line = text.lines().position(|l| l == "[[compare]]").unwrap() + 1;
        let error = Study::from_toml(&text, Path::new("beside.toml")).unwrap_err();
        assert!(matches!(error, StudyError::Field { .. }), "{error}");
        let message = error.to_string();
        let start = format!("beside.toml, line {line}: compare[0].{field} is {value}; allowed: ");
        assert!(message.starts_with(&start) && message.contains(allowed), "{message}\nexpected {start}");
    }
    let unknown = text(2, &format!("[[compare]]\n{good}\nover_spp = 4"));
    assert!(matches!(Study::from_toml(&unknown, Path::new("beside.toml")), Err(StudyError::Syntax { .. })));
}

#[test]
fn a_study_without_comparisons_has_none_and_a_number_is_a_range_of_one() {
    let plain = study(&text(2, ""));
    assert!(plain.compare.is_empty());
    let one = study(&text(2, "[[compare]]\nwhat = \"x\"\nrow = \"blur\"\nover = \"mc\"\npaper = 2"));
    assert_eq!(one.compare[0].paper("two"), Some(PaperRatio { low: 2.0, high: 2.0 }));
    assert_eq!(one.compare[0].source, "");
}
