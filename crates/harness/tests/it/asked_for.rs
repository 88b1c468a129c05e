//! What a study may ask of its frames beside Student's t: other intervals, and tests of membership.

use std::path::Path;

use noisefloor_questions::document;
use noisefloor_stats::{Level, Needed, Verdict, interval_rejection, rate_standard_error, t_quantile};
use noisefloor_study::Study;
use noisefloor_study::summary::{ClaimSummary, Summary};

use crate::common::{Place, Watch, study};

/// Pixel-channels of a study, whose channels are independent, over four replicates.
const CHANNELS: u64 = 96 * 64 * 3 * 4;

fn run(law: &str, asked: &str) -> Summary {
    run_at(&Place::new(), law, asked)
}

fn run_at(place: &Place, law: &str, asked: &str) -> Summary {
    let toml = format!(
        r#"
name = "asked"
spp = [4]
replicates = 4
coverage = [0.95]
timing = {{ warmup = 0, runs = 1 }}
{asked}
[[scene]]
id = "flats"
synthetic = {{ image = "flats", law = {law}, width = 96, height = 64, guides = "none" }}
[[method]]
id = "mc"
"#
    );
    place.run(&study(&toml), &Watch::default()).unwrap()
}

fn claim<'a>(summary: &'a Summary, what: &str) -> &'a ClaimSummary {
    let found = summary.claims.iter().find(|claim| claim.id.what == what);
    found.unwrap_or_else(|| panic!("{what}: {:?}", summary.claims.iter().map(|c| &c.id).collect::<Vec<_>>()))
}

fn near(found: f64, expected: f64, trials: u64) -> bool {
    (found - expected).abs() < 5.0 * rate_standard_error(expected, trials)
}

#[test]
fn families_that_a_study_lists_are_measured_and_judged_by_what_they_promise() {
    let asked = r#"statistics = ["third-moment"]
intervals = ["normal", "hall", "pooled-t", "upper-t", "asymmetric-t"]"#;
    let summary = run("\"exponential\"", asked);
    // Exponential samples, four of them, at 95 %: coverage by 4·10⁵ draws each.
    for (what, expected) in [("normal at 95 %", 0.785), ("hall at 95 %", 0.915), ("upper-t at 95 %", 0.837)] {
        let claim = claim(&summary, what);
        assert!((claim.effect.value - expected).abs() < 0.005, "{what}: {:?}", claim.effect);
        assert_eq!(claim.verdict, Verdict::Refuted, "{what}");
    }
    // Too wide for 95 %, and without a theorem that would make it a promise of at least that.
    let pooled = claim(&summary, "pooled-t at 95 %");
    assert!(pooled.effect.value > 0.98 && pooled.verdict == Verdict::Refuted, "{pooled:?}");
    let shown = document(&summary);
    let table = shown.tables().into_iter().find(|table| table.id == "intervals-flats").unwrap();
    let number = |family: &str, column: usize| {
        let row = table.rows.iter().find(|row| row.cells[0].text == family).unwrap();
        row.cells[column].number.map(|number| number.value)
    };
    let (t, wide) =
        (t_quantile(Level::TWO_SIDED_95, 3), |tail: f64| t_quantile(Level::upper(1.0 - tail).unwrap(), 3));
    let expected = (wide(0.045) + wide(0.005)) / (2.0 * t);
    let width = number("t with unequal tails", 7).unwrap();
    assert!((width / expected - 1.0).abs() < 1e-6, "{width} {expected}");
    assert_eq!(number("upper limit by t", 7), None, "a limit has no width");
    // What a limit on the upper side misses lies above it, and a lower one would not miss at all.
    assert!(number("upper limit by t", 4).unwrap() > 0.15 && number("upper limit by t", 5) == Some(0.0));
    assert!(shown.charts().iter().any(|chart| chart.id == "intervals-flats"));
}

#[test]
fn what_is_asked_for_later_is_measured_then() {
    let (place, law) = (Place::new(), "\"gaussian\", sd = 0.3");
    let asked = |summary: &Summary, question: &str| {
        summary.claims.iter().filter(|claim| claim.id.question == question).count()
    };
    let first = run_at(&place, law, "");
    assert_eq!((asked(&first, "intervals"), asked(&first, "membership")), (0, 0));
    let later = run_at(&place, law, "intervals = [\"normal\"]\nmembership = true");
    // Of the three tests of membership two have a known rate.
    assert_eq!((asked(&later, "intervals"), asked(&later, "membership")), (1, 2));
    let both = run_at(&place, law, "intervals = [\"normal\", \"pooled-t\"]");
    assert_eq!((asked(&both, "intervals"), asked(&both, "membership")), (2, 0));
}

#[test]
fn equal_pixels_are_told_apart_as_often_as_the_closed_form_says_on_normal_samples_and_more_on_skewed_ones() {
    let law = "\"gaussian\", sd = 0.3";
    let normal = run(law, "membership = true");
    // Two disjoint pairs of four replicates.
    let exact = interval_rejection(4, 0.0, 1.0, Level::TWO_SIDED_95);
    let what = "mean in the interval (moon2013flash) at 95 %";
    let found = claim(&normal, what);
    assert!(near(found.effect.value, exact, CHANNELS / 2), "{found:?} {exact}");
    assert_eq!(found.effect.n, 2, "no replicate is in two pairs");
    assert_eq!(found.replicates_per_value, 2);
    if let Needed::Replicates(count) = found.needed {
        assert!(count > 4 && count % 2 == 0, "as many as make whole pairs, more than there are: {count}");
    }
    let shown = document(&normal);
    let table = shown.tables().into_iter().find(|table| table.id == "membership-flats").unwrap();
    let power = |row: usize| table.rows[row].cells[4].number.unwrap().value;
    for (row, shift) in [2.0, 4.0, 8.0].into_iter().enumerate() {
        let expected = interval_rejection(4, shift, 1.0, Level::TWO_SIDED_95);
        assert!(near(power(row + 1), expected, CHANNELS / 2), "{shift}: {} {expected}", power(row + 1));
    }
    let skewed = run("\"exponential\"", "membership = true");
    assert!(claim(&skewed, what).effect.value > 1.3 * exact, "{:?}", claim(&skewed, what).effect);
    let silent = run(law, "");
    assert!(silent.claims.iter().all(|claim| claim.id.question != "membership"), "nobody asked");
}

#[test]
fn families_without_a_meaning_or_without_their_statistics_are_refused_with_the_way_out() {
    let told = |families: &str| {
        let toml = format!(
            "name = \"asking\"\nspp = [4]\nintervals = [{families}]\n\
             [[scene]]\nid = \"cornell\"\n[[method]]\nid = \"mc\"\n"
        );
        Study::from_toml(&toml, Path::new("asking.toml")).unwrap_err().to_string()
    };
    for (families, words) in [
        ("\"bootstrap\"", "t is measured always"),
        ("\"t\"", "t is measured always"),
        ("\"normal\", \"normal\"", "each family once"),
        ("\"hall\"", "statistics = [\"third-moment\", …]"),
        ("\"rare-event-t\"", "which it is made of"),
    ] {
        let told = told(families);
        assert!(told.contains(words) && told.contains("asking.toml, line 3"), "{told}");
    }
}
