//! What the numbers must show where the truth is exact.

use noisefloor_harness::reanalyse;
use noisefloor_stats::Verdict;
use noisefloor_study::Study;
use noisefloor_study::summary::{Source, Summary};

use crate::common::{Place, Watch, records, study};

fn law(law: &str, spp: &str) -> Study {
    study(&format!(
        r#"
        name = "law"
        spp = {spp}
        replicates = 6
        timing = {{ warmup = 0, runs = 1 }}
        [[scene]]
        id = "flats"
        synthetic = {{ image = "flats", {law}, width = 64, height = 48, guides = "none" }}
        [[method]]
        id = "mc"
        [[method]]
        id = "blur"
        [[method]]
        id = "guarded(blur)"
        "#
    ))
}

fn run(study: &Study) -> (Place, Summary) {
    let place = Place::new();
    let summary = place.run(study, &Watch::default()).unwrap();
    (place, summary)
}

fn verdicts(summary: &Summary, question: &str) -> Vec<Verdict> {
    summary.claims.iter().filter(|c| c.id.question == question).map(|c| c.verdict).collect()
}

#[test]
fn intervals_of_normal_samples_cover_as_often_as_they_say() {
    let (_place, summary) = run(&law("law = \"gaussian\", sd = 0.5", "[2, 4, 16]"));
    let all: Vec<_> = summary.coverage.iter().filter(|c| c.class == "all").collect();
    assert_eq!(all.len(), 3 * 3);
    for row in all {
        // 64·48·3 independent pixel-channels in 6 replicates.
        let sd = (row.confidence * (1.0 - row.confidence) / (64.0 * 48.0 * 3.0 * 6.0)).sqrt();
        let off = (row.covered.value - row.confidence).abs();
        assert!(off < 5.0 * sd, "{} spp, {}: {}", row.spp, row.confidence, row.covered.value);
        assert_eq!((row.covered.value, row.constant, row.missed), (row.covered_uncorrected.value, 0.0, 0.0));
        assert_eq!((row.covered.source, row.covered.n, &row.mark), (Source::Replicates, 6, &None));
    }
}

#[test]
fn the_bound_of_a_guarded_method_holds_for_normal_samples() {
    let (_place, summary) = run(&law("law = \"gaussian\", sd = 0.5", "[2, 4, 16]"));
    let bounds: Vec<_> = summary.bounds.iter().filter(|b| b.class == "all").collect();
    assert_eq!(bounds.len(), 3);
    for bound in bounds {
        assert!(bound.proven && bound.violations.high.unwrap() <= bound.alpha, "{bound:?}");
    }
    assert_eq!(verdicts(&summary, "bounds"), [Verdict::Shown; 3]);
    for cell in summary.cells.iter().filter(|c| c.label == "guarded(blur)") {
        assert!(cell.enclosure_worst_ratio.unwrap() <= 1.0);
    }
    // What an unoptimised build says of its times is no warning about bounds.
    let about_numbers: Vec<_> =
        summary.warnings.iter().filter(|w| !w.to_string().contains("debug build")).collect();
    assert!(about_numbers.is_empty(), "{about_numbers:?}");
}

#[test]
fn a_guard_by_skewness_asks_the_study_for_the_third_moment() {
    let asking = |statistics: &str| {
        study(&format!(
            r#"
            name = "skewed"
            spp = [8]
            replicates = 2
            {statistics}
            timing = {{ warmup = 0, runs = 1 }}
            [[scene]]
            id = "flats"
            synthetic = {{ image = "flats", law = "exponential", width = 32, height = 24, guides = "none" }}
            [[method]]
            id = "mc"
            [[method]]
            id = "guarded(blur)"
            set = {{ guard_interval = "hall" }}
            "#
        ))
    };
    let (_place, without) = run(&asking(""));
    assert!(without.skipped[0].reason.contains("`statistics = [\"third-moment\"]`"), "{:?}", without.skipped);
    let (place, with) = run(&asking("statistics = [\"third-moment\"]"));
    assert!(with.skipped.is_empty(), "{:?}", with.skipped);
    let bounds: Vec<_> = with.bounds.iter().filter(|b| b.class == "all").collect();
    assert_eq!(bounds.len(), 1);
    assert!(bounds[0].claim.contains("`hall`") && !bounds[0].proven, "{:?}", bounds[0]);
    let guarded = records(&place.out()).into_iter().find(|r| r.label.starts_with("guarded")).unwrap();
    assert!(guarded.enclosures.is_empty(), "none is claimed");
    // The statistic costs the frames that have it a key of their own, and changes no sample.
    let errors = |summary: &Summary| -> Vec<_> {
        summary.cells.iter().filter(|c| c.label == "mc").map(|c| c.metrics["mse"].value).collect()
    };
    assert_eq!(errors(&with), errors(&without));
}

#[test]
fn rare_events_break_coverage_and_the_bound_and_are_counted_apart() {
    let (_place, summary) = run(&law("law = \"bernoulli\", q = 0.01", "[16]"));
    let wide = summary.coverage.iter().find(|c| c.class == "all" && c.confidence == 0.99).unwrap();
    // No event in 16 samples with probability 0.99^16 = 0.85: the interval is a point beside the truth.
    let missed = 0.99f64.powi(16);
    assert!(wide.covered.high.unwrap() < 0.5, "{:?}", wide.covered);
    assert!((wide.missed - missed).abs() < 0.01, "{} against {missed}", wide.missed);
    let bound = summary.bounds.iter().find(|b| b.class == "all").unwrap();
    assert_eq!(verdicts(&summary, "bounds"), [Verdict::Refuted], "{bound:?}");
    assert!(bound.missed > 0.5);
}

#[test]
fn plain_monte_carlo_falls_like_one_over_n_and_needs_itself_once() {
    let (_place, summary) = run(&law("law = \"exponential\"", "[4, 16, 64]"));
    let slope = |label: &str, metric: &str| {
        summary.slopes.iter().find(|s| s.label == label && s.metric == metric).unwrap()
    };
    for (metric, expected) in [("mse", -1.0), ("rmse", -0.5), ("relmse", -1.0)] {
        let found = slope("mc", metric);
        assert!((found.slope.value - expected).abs() < 0.05, "{metric}: {:?}", found.slope);
        assert_eq!(found.verdict.name(), "consistent", "{}", found.sentence);
    }
    for cell in summary.cells.iter().filter(|c| c.label == "mc") {
        assert!((cell.equal_error["mse"].value - 1.0).abs() < 0.1, "{:?}", cell.equal_error["mse"]);
        assert_eq!(cell.ratio_to_mc["mse"].value, 1.0);
    }
    // Blurring across the edges between flats leaves a bias that no sample takes away.
    let blur = slope("blur", "mse");
    assert!(blur.slope.value > -0.9, "{:?}", blur.slope);
    let at_four = summary.cells.iter().find(|c| c.label == "blur" && c.spp == 4).unwrap();
    assert!(at_four.equal_error["mse"].value > 1.5 && at_four.ratio_to_mc["mse"].high.unwrap() < 1.0);
    let compared = summary.comparisons.iter().find(|c| c.metric == "mse" && c.spp == 4).unwrap();
    assert_eq!(compared.ranking.last().unwrap(), "mc");
    assert!(!compared.best_group.contains(&"mc".to_owned()));
}

#[test]
fn one_sample_per_pixel_has_errors_and_no_intervals() {
    let (place, summary) = run(&law("law = \"gaussian\", sd = 0.5", "[1]"));
    assert!(summary.coverage.is_empty() && summary.bounds.is_empty());
    let labels: Vec<&str> = summary.cells.iter().map(|c| c.label.as_str()).collect();
    assert_eq!(labels, ["mc", "blur"]);
    assert!(summary.skipped[0].reason.contains("variance of the colour mean"), "{:?}", summary.skipped);
    assert_eq!(records(&place.out()).len(), 18);
}

#[test]
fn dependent_samples_void_coverage_and_bounds_and_the_summary_says_so() {
    let place = Place::new();
    let study = study(
        r#"
        name = "dependent"
        spp = [4, 8]
        replicates = 2
        width = 16
        height = 12
        depth = 2
        sampling = "low-discrepancy"
        timing = { warmup = 0, runs = 1 }
        reference = { spp = 64 }
        [[scene]]
        id = "cornell"
        [[method]]
        id = "mc"
        [[method]]
        id = "guarded(blur)"
        "#,
    );
    let summary = place.run(&study, &Watch::default()).unwrap();
    assert!(summary.coverage.is_empty() && summary.bounds.is_empty());
    assert!(summary.cells.iter().all(|cell| cell.equal_error.is_empty()));
    assert!(
        summary
            .warnings
            .iter()
            .any(|w| w.to_string().contains("left out") && w.to_string().contains("low-discrepancy"))
    );
    // The certain half compares the output with its own input: it is checked all the same.
    assert!(summary.cells.iter().any(|c| c.enclosure_worst_ratio.is_some_and(|r| r <= 1.0)));
}

#[test]
fn a_short_reference_is_marked() {
    let place = Place::new();
    let study = study(
        r#"
        name = "short"
        spp = [2, 8]
        replicates = 2
        width = 16
        height = 12
        depth = 2
        timing = { warmup = 0, runs = 1 }
        reference = { spp = 64 }
        [[scene]]
        id = "cornell"
        [[method]]
        id = "mc"
        "#,
    );
    let summary = place.run(&study, &Watch::default()).unwrap();
    let reference = &summary.scenes[0].reference;
    assert_eq!(
        (reference.spp, reference.parts, reference.ratio_to_top, reference.long_enough),
        (64, 8, 8.0, false)
    );
    assert!(
        summary.warnings.iter().any(|w| w.to_string().contains("only 8 times")),
        "{:?}",
        summary.warnings
    );
    let marks: Vec<(u32, bool)> =
        summary.coverage.iter().filter(|c| c.class == "all").map(|c| (c.spp, c.mark.is_some())).collect();
    assert!(marks.iter().all(|(spp, marked)| *marked == (*spp == 8)), "{marks:?}");
    assert!(reference.floor["mse"] > 0.0 && reference.bias["relmse"] > 0.0);
    assert!(summary.cells.iter().all(|cell| cell.reference_bias["relmse"] != 0.0));
    // The kept reference has its parts: metrics that are computed again are the run's own.
    let again = reanalyse(&place.out(), true).unwrap();
    assert_eq!((again.cells, again.scenes), (summary.cells, summary.scenes));
    let kept = records(&place.out());
    assert!(kept.iter().all(|record| record.reference["mse"].parts.len() == 8), "one influence per part");
    assert!(kept.iter().all(|record| !record.class_reference.is_empty()));
}
